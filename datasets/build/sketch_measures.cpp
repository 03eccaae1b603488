#include "datasets/build/sketch_measures.h"

#include "render/visibility.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Point = SketchFacts::Point;

/// A point of a curve is hidden by what lies in front of it by more than this.
constexpr double kCurveDepthToleranceMm = 2;

double Degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

Point PixelOf(const geometry::Points& pixels, int vertex) {
  return {static_cast<float>(pixels(vertex, 0)), static_cast<float>(pixels(vertex, 1))};
}

/// The frontal silhouette whose middle lies lowest: the jaw.
const faces::FeatureCurve* FindJaw(const faces::FaceTemplate& face) {
  const faces::FeatureCurve* jaw = nullptr;
  const auto height = [&](const faces::FeatureCurve& curve) {
    return face.neutral(curve.vertices[curve.vertices.size() / 2], 1);
  };
  for (const faces::FeatureCurve& curve : face.annotation.curves) {
    if (curve.view != faces::View::kFrontal || curve.kind != "silhouette" || curve.vertices.size() < 3) continue;
    if (!jaw || height(curve) < height(*jaw)) jaw = &curve;
  }
  return jaw;
}

std::vector<int> SkullVertices(const faces::FaceTemplate& face) {
  const faces::FeatureCurve* jaw = FindJaw(face);
  std::vector<bool> is_ear(size_t(face.num_vertices()), false);
  if (const auto ears = face.annotation.regions.find("ears"); jaw && ears != face.annotation.regions.end())
    for (const int vertex : ears->second) is_ear[size_t(vertex)] = true;
  std::vector<int> skull;
  const auto at = [&](int vertex) { return Eigen::Vector3d(face.neutral.row(vertex).transpose()); };
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY(), end = Eigen::Vector3d::Constant(-1e9);
  if (jaw) {
    const Eigen::Vector3d first = at(jaw->vertices.front()), last = at(jaw->vertices.back());
    const Eigen::Vector3d chin = at(jaw->vertices[jaw->vertices.size() / 2]);
    end = (first + last) / 2;
    normal = (first - last).cross(end - chin).normalized();
    if (normal.y() < 0) normal = -normal;
  }
  for (int vertex = 0; vertex < face.num_vertices(); ++vertex) {
    const Eigen::Vector3d p = at(vertex);
    const bool is_behind = p.z() < end.z();
    const bool is_above = is_behind ? p.y() >= end.y() : normal.dot(p - end) >= -1e-6;
    if (is_above && !is_ear[size_t(vertex)]) skull.push_back(vertex);
  }
  return skull;
}

/// Radii that are missing (below 0) become the mean of their neighbours at both sides of the circle.
void CloseGaps(std::vector<double>& radii) {
  const size_t count = radii.size();
  std::vector<double> closed = radii;
  for (size_t i = 0; i < count; ++i) {
    if (radii[i] >= 0) continue;
    size_t before = 1, after = 1;
    while (before < count && radii[(i + count - before) % count] < 0) ++before;
    while (after < count && radii[(i + after) % count] < 0) ++after;
    const double low = radii[(i + count - before) % count], high = radii[(i + after) % count];
    closed[i] = (low * double(after) + high * double(before)) / double(before + after);
  }
  radii = closed;
}

}  // namespace

HeadAngles HeadAnglesOf(const render::Camera& camera) {
  const Eigen::Vector3d forward = camera.camera_from_world.col(2), up = camera.camera_from_world.col(1);
  return {Degrees(std::atan2(forward.x(), -forward.z())), Degrees(std::asin(std::clamp(-forward.y(), -1.0, 1.0))),
          Degrees(std::atan2(up.x(), -up.y()))};
}

SketchMeasures::SketchMeasures(const faces::FaceTemplate& face_template, std::vector<int> curve_vertices)
    : curve_vertices_(std::move(curve_vertices)),
      skull_(SkullVertices(face_template)),
      landmarks_(face_template.annotation.landmarks),
      hairline_(face_template.annotation.hairline_vertex),
      triangles_(face_template.triangles),
      mm_per_cm_(faces::MillimetresPerCm(face_template)) {
  if (const auto nose = face_template.annotation.regions.find("nose"); nose != face_template.annotation.regions.end())
    nose_ = nose->second;
  const auto pair = [&](size_t upper, size_t lower) { return std::pair(landmarks_[upper], landmarks_[lower]); };
  openings_ = {{{}, {}, {pair(37, 41), pair(38, 40)}},
               {{}, {}, {pair(43, 47), pair(44, 46)}},
               {{}, {}, {pair(61, 67), pair(62, 66), pair(63, 65)}}};
}

std::vector<Point> SketchMeasures::Outline(const geometry::Points& pixels) const {
  Eigen::AlignedBox2d box;
  for (const int vertex : skull_) box.extend(Eigen::Vector2d(pixels(vertex, 0), pixels(vertex, 1)));
  const Eigen::Vector2d middle = box.center();
  constexpr int kBins = SketchFacts::kOutline;
  std::vector<double> radii(kBins, -1);
  for (const int vertex : skull_) {
    const Eigen::Vector2d arm = Eigen::Vector2d(pixels(vertex, 0), pixels(vertex, 1)) - middle;
    const double turn = std::atan2(arm.x(), -arm.y()) / (2 * std::numbers::pi);  // 0 at the top, clockwise.
    const auto bin = static_cast<size_t>((std::lround(turn * kBins) + kBins) % kBins);
    radii[bin] = std::max(radii[bin], arm.norm());
  }
  CloseGaps(radii);
  std::vector<Point> outline;
  for (int i = 0; i < kBins; ++i) {
    const double angle = 2 * std::numbers::pi * i / kBins;
    outline.push_back({static_cast<float>(middle.x() + radii[size_t(i)] * std::sin(angle)),
                       static_cast<float>(middle.y() - radii[size_t(i)] * std::cos(angle))});
  }
  return outline;
}

std::vector<Point> SketchMeasures::NoseContour(const geometry::Points& pixels) const {
  const auto landmark = [&](int i) {
    const int vertex = landmarks_[size_t(i)];
    return Eigen::Vector2d(pixels(vertex, 0), pixels(vertex, 1));
  };
  const Eigen::Vector2d top = landmark(27), base = landmark(33), tip = landmark(30);
  const Eigen::Vector2d eyes = (landmark(36) + landmark(45)) / 2;
  const double side = tip.x() < eyes.x() ? -1 : 1;
  constexpr int kRows = SketchFacts::kNoseContour;
  std::vector<double> reach(kRows);
  // Never inside the line from the bridge over the tip to the base.
  for (int row = 0; row < kRows; ++row) {
    const double y = top.y() + (base.y() - top.y()) * row / (kRows - 1);
    const bool is_above_tip = y < tip.y();
    const Eigen::Vector2d& from = is_above_tip ? top : tip;
    const Eigen::Vector2d& to = is_above_tip ? tip : base;
    const double share = to.y() == from.y() ? 0 : std::clamp((y - from.y()) / (to.y() - from.y()), 0.0, 1.0);
    reach[size_t(row)] = side * (from.x() + share * (to.x() - from.x()));
  }
  for (const int vertex : nose_) {
    const double share = (pixels(vertex, 1) - top.y()) / (base.y() - top.y());
    if (!(share >= 0 && share <= 1)) continue;
    const auto row = static_cast<size_t>(std::lround(share * (kRows - 1)));
    reach[row] = std::max(reach[row], side * pixels(vertex, 0));
  }
  std::vector<Point> contour;
  for (int row = 0; row < kRows; ++row) {
    contour.push_back({static_cast<float>(side * reach[size_t(row)]),
                       static_cast<float>(top.y() + (base.y() - top.y()) * row / (kRows - 1))});
  }
  return contour;
}

SketchFacts SketchMeasures::Measure(const geometry::Points& face, const render::Camera& camera,
                                    CurveVisibility visibility) const {
  const geometry::Points pixels = render::Project(camera, face);
  SketchFacts facts{};
  for (const int vertex : landmarks_) facts.landmarks.push_back(PixelOf(pixels, vertex));
  facts.hairline = PixelOf(pixels, hairline_);
  facts.outline = Outline(pixels);
  facts.nose_contour = NoseContour(pixels);
  const HeadAngles angles = HeadAnglesOf(camera);
  facts.yaw = static_cast<float>(angles.yaw);
  facts.pitch = static_cast<float>(angles.pitch);
  facts.roll = static_cast<float>(angles.roll);
  for (size_t i = 0; i < facts.gaps_mm.size(); ++i)
    facts.gaps_mm[i] = static_cast<float>(mm_per_cm_ * faces::MeanGap(openings_[i], face));
  facts.visible.assign(curve_vertices_.size(), 1);
  if (visibility == CurveVisibility::kSeen) {
    const render::Visibility seen(camera, {face, triangles_}, kCurveDepthToleranceMm / mm_per_cm_);
    for (size_t i = 0; i < curve_vertices_.size(); ++i)
      facts.visible[i] = seen.Sees(pixels.row(curve_vertices_[i])) ? 1 : 0;
  }
  return facts;
}

}  // namespace daumier::datasets
