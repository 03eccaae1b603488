#include "faces/controls/soft_region.h"

#include "core/error.h"
#include "faces/landmark_order.h"
#include "geometry/curvature.h"
#include "geometry/topology.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {
namespace {

constexpr int kRingsOfAnnotated = 6;

/// With first and second derivatives of 0 at both ends.
double Smoothstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 - 15 * t + 6 * t * t);
}

geometry::Vector3 MirroredVector(const geometry::Vector3& vector) {
  return {-vector.x(), vector.y(), vector.z()};
}

template <class T>
std::vector<T> AllMirrored(std::vector<T> items) {
  for (T& item : items) item = Mirrored(item);
  return items;
}

Ramp Mirrored(const Ramp& ramp) {
  Ramp mirrored{AllMirrored(ramp.from), MirroredVector(ramp.direction), ramp.width};
  std::reverse(mirrored.from.begin(), mirrored.from.end());
  return mirrored;
}

std::vector<geometry::Vector3> PositionsOf(const std::vector<Anchor>& anchors, const FaceTemplate& face_template) {
  std::vector<geometry::Vector3> positions;
  for (const Anchor& anchor : anchors) positions.push_back(PositionOf(anchor, face_template, face_template.neutral));
  return positions;
}

/// Points at most half a radius apart.
std::vector<geometry::Vector3> Sampled(const std::vector<geometry::Vector3>& path, const geometry::Vector3& radii) {
  std::vector<geometry::Vector3> points = {path.front()};
  for (size_t i = 1; i < path.size(); ++i) {
    const geometry::Vector3 step = path[i] - path[i - 1];
    const int count = std::max(1, static_cast<int>(std::ceil(2 * step.cwiseQuotient(radii).norm())));
    for (int k = 1; k <= count; ++k) points.emplace_back(path[i - 1] + step * (double(k) / count));
  }
  return points;
}

/// The point at the given x of a line whose points are in ascending order of x.
geometry::Vector3 AtX(const std::vector<geometry::Vector3>& line, double x) {
  if (x <= line.front().x()) return line.front();
  for (size_t i = 1; i < line.size(); ++i) {
    const double length = line[i].x() - line[i - 1].x();
    if (x < line[i].x() && length > 0) return line[i - 1] + (x - line[i - 1].x()) / length * (line[i] - line[i - 1]);
  }
  return line.back();
}

}  // namespace

Anchor Mirrored(const Anchor& anchor) {
  Anchor mirrored{anchor.landmarks, MirroredVector(anchor.offset)};
  for (int& landmark : mirrored.landmarks) {
    if (landmark != kHairlineAnchor) landmark = MirroredLandmark(landmark);
  }
  return mirrored;
}

double EyeSpan(const FaceTemplate& face_template) {
  const auto& landmarks = face_template.annotation.landmarks;
  return (face_template.neutral.row(landmarks[36]) - face_template.neutral.row(landmarks[45])).norm();
}

geometry::Vector3 PositionOf(const Anchor& anchor, const FaceTemplate& face_template, const geometry::Points& face) {
  const Annotation& annotation = face_template.annotation;
  geometry::Vector3 sum = geometry::Vector3::Zero();
  for (const int landmark : anchor.landmarks)
    sum += face.row(landmark == kHairlineAnchor ? annotation.hairline_vertex : annotation.landmarks[landmark]);
  return sum / double(anchor.landmarks.size()) + EyeSpan(face_template) * anchor.offset;
}

SoftRegion Mirrored(const SoftRegion& region) {
  SoftRegion mirrored{AllMirrored(region.path), region.radii, {}, region.annotated};
  for (const Ramp& ramp : region.ramps) mirrored.ramps.push_back(Mirrored(ramp));
  return mirrored;
}

Eigen::VectorXd WeightsOf(const SoftRegion& region, const FaceTemplate& face_template) {
  const int num_vertices = face_template.num_vertices();
  const geometry::Points& points = face_template.neutral;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(num_vertices);
  if (!region.path.empty()) {
    const geometry::Vector3 radii = EyeSpan(face_template) * region.radii;
    for (const geometry::Vector3& point : Sampled(PositionsOf(region.path, face_template), radii)) {
      for (int v = 0; v < num_vertices; ++v) {
        const double squared = (points.row(v).transpose() - point).cwiseQuotient(radii).squaredNorm();
        weights[v] *= 1 - std::exp2(-squared);
      }
    }
    weights = 1 - weights.array();
  } else if (!region.annotated.empty()) {
    weights.setZero();
    for (const int v : RegionFor(face_template.annotation, region.annotated, "a control of the face")) weights[v] = 1;
    weights =
        geometry::SmoothOverRings(weights, Eigen::VectorXd::Ones(num_vertices),
                                  geometry::VertexNeighbours(face_template.triangles, num_vertices), kRingsOfAnnotated);
  }
  for (const Ramp& ramp : region.ramps) {
    const std::vector<geometry::Vector3> line = PositionsOf(ramp.from, face_template);
    const double width = ramp.width * EyeSpan(face_template);
    for (int v = 0; v < num_vertices; ++v) {
      const geometry::Vector3 point = points.row(v);
      weights[v] *= Smoothstep((point - AtX(line, point.x())).dot(ramp.direction) / width);
    }
  }
  return weights;
}

}  // namespace daumier::faces
