#include "faces/eyeball.h"

#include "core/error.h"
#include "faces/hole_closure.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr double kRadius = 0.6, kIrisRadius = 0.215, kHeightRadius = 0.95;  // Shares of w and h.
constexpr double kSkinReach = 1.2, kClearance = 0.008, kBulge = 0.05, kFarthestAside = 0.12,
                 kFarthestUp = 0.035;  // Shares of w.
constexpr double kRounding = 0.05;     // Of a smooth maximum, as a share of w.
constexpr double kSharpness = 250;     // Of the smooth minimum of depths, per w.
constexpr double kSideSlope = 3;       // How fast skin around the ball stops to hold it back.
constexpr int kSegments = 32;
constexpr double kPupilShare = 0.42, kIrisShare = 0.88;

/// A ring of an eyeball: its radius in the plane of x and y on the front half as a share of the iris's (`of_iris`) or
/// of the ball's, or the same on the rear half.
struct EyeRing {
  double radius;
  bool of_iris, is_front;
  HeadMaterial inside;  ///< Of the triangles between it and the ring before.
};
constexpr std::array<EyeRing, 11> kEyeRings = {{{0.2, true, true, HeadMaterial::kPupil},
                                                {kPupilShare, true, true, HeadMaterial::kPupil},
                                                {0.65, true, true, HeadMaterial::kIris},
                                                {kIrisShare, true, true, HeadMaterial::kIris},
                                                {1.0, true, true, HeadMaterial::kLimbus},
                                                {0.5, false, true, HeadMaterial::kSclera},
                                                {0.68, false, true, HeadMaterial::kSclera},
                                                {0.84, false, true, HeadMaterial::kSclera},
                                                {0.95, false, true, HeadMaterial::kSclera},
                                                {1.0, false, true, HeadMaterial::kSclera},
                                                {0.71, false, false, HeadMaterial::kSclera}}};

/// Within half of `rounding` of max(a, b), and smooth.
double SmoothMax(double a, double b, double rounding) {
  return 0.5 * (a + b + std::hypot(a - b, rounding));
}

double MeanHeight(const geometry::Points& vertices, const std::vector<int>& of) {
  double sum = 0;
  for (const int v : of) sum += vertices(v, 1);
  return sum / double(of.size());
}

/// The centre of a sphere of a given radius behind points that it fits best: least squares of |p - c| - radius by the
/// method of Gauss and Newton.
geometry::Vector3 FitSphere(const geometry::Points& points, double radius) {
  constexpr int kSteps = 20;
  geometry::Vector3 centre = points.colwise().mean().transpose() - geometry::Vector3(0, 0, radius);
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
    geometry::Vector3 right = geometry::Vector3::Zero();
    for (const auto& row : points.rowwise()) {
      const geometry::Vector3 away = row.transpose() - centre, direction = away.normalized();
      normal += direction * direction.transpose();
      right += (away.norm() - radius) * direction;
    }
    centre += normal.ldlt().solve(right);
  }
  return centre;
}

EyeballMesh MakeEyeballTopology() {
  EyeballMesh mesh;
  const int num_rings = int(kEyeRings.size()), rear = NumEyeballVertices() - 1;
  const auto at = [](int ring, int i) { return 1 + ring * kSegments + i % kSegments; };
  const auto add = [&](int a, int b, int c, HeadMaterial material) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.materials.push_back(material);
  };
  for (int i = 0; i < kSegments; ++i) add(0, at(0, i), at(0, i + 1), kEyeRings[0].inside);
  for (int ring = 1; ring < num_rings; ++ring) {
    for (int i = 0; i < kSegments; ++i) {
      add(at(ring - 1, i), at(ring, i), at(ring, i + 1), kEyeRings[size_t(ring)].inside);
      add(at(ring - 1, i), at(ring, i + 1), at(ring - 1, i + 1), kEyeRings[size_t(ring)].inside);
    }
  }
  for (int i = 0; i < kSegments; ++i) add(at(num_rings - 1, i), rear, at(num_rings - 1, i + 1), HeadMaterial::kSclera);
  return mesh;
}

}  // namespace

double Eyeball::Front(double x, double y) const {
  const double q = (x * x) / (radii.x() * radii.x()) + (y * y) / (radii.y() * radii.y());
  const double of_iris = std::max(0.0, 1 - (x * x + y * y) / (iris_radius * iris_radius));
  return radii.z() * std::sqrt(std::max(0.0, 1 - q)) + bulge * of_iris * of_iris;
}

EyeballFit::EyeballFit(const geometry::TriangleMesh& mesh, const std::vector<int>& lids) {
  const geometry::Points& neutral = mesh.vertices;
  DAUMIER_CHECK(lids.size() >= 4, "an opening between lids has {} vertices, expected 4 or more", lids.size());
  std::vector<int> loop(lids);
  const auto by_x = [&](int a, int b) { return neutral(a, 0) < neutral(b, 0); };
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), by_x), loop.end());
  auto left = std::max_element(loop.begin(), loop.end(), by_x);
  // A corner has a vertex on both of its sides, so that both lids have some.
  left = std::clamp(left, loop.begin() + 2, loop.end() - 2);
  right_corner_ = loop.front();
  left_corner_ = *left;
  upper_.assign(loop.begin() + 1, left);
  lower_.assign(left + 1, loop.end());
  if (MeanHeight(neutral, upper_) < MeanHeight(neutral, lower_)) std::swap(upper_, lower_);
  const Opening opening = OpeningOf(neutral);
  DAUMIER_CHECK(opening.width > 0, "the corners of an opening between lids lie in one point");
  neutral_share_ = opening.height / opening.width;
  const geometry::Points rim = LoopPoints(neutral, lids);
  const Eigen::RowVector3d centre = rim.colwise().mean();
  const geometry::Vector3 best = FitSphere(rim, kRadius * opening.width);
  const auto share = [&](double offset, double most) { return std::clamp(offset / opening.width, -most, most); };
  aside_ = share(best.x() - opening.middle, kFarthestAside);
  up_ = share(best.y() - opening.lower - 0.5 * opening.height, kFarthestUp);
  const auto is_near = [&](const Eigen::RowVector3d& point) {
    return (point - centre).norm() <= kSkinReach * opening.width;
  };
  std::vector<bool> is_skin(size_t(neutral.rows()), false);
  for (const int v : lids) is_skin[size_t(v)] = true;
  for (int v = 0; v < neutral.rows(); ++v)
    if (is_skin[size_t(v)] || is_near(neutral.row(v))) skin_.push_back(v);
  for (const auto& t : mesh.triangles.rowwise())
    if (is_near((neutral.row(t[0]) + neutral.row(t[1]) + neutral.row(t[2])) / 3))
      skin_triangles_.push_back({t[0], t[1], t[2]});
}

EyeballFit::Opening EyeballFit::OpeningOf(const geometry::Points& vertices) const {
  const auto right = vertices.row(right_corner_), left = vertices.row(left_corner_);
  const double lower = MeanHeight(vertices, lower_);
  return {(left - right).norm(), MeanHeight(vertices, upper_) - lower, 0.5 * (right.x() + left.x()), lower};
}

Eyeball EyeballFit::Fit(const geometry::Points& vertices) const {
  const Opening opening = OpeningOf(vertices);
  const double w = opening.width, radius = kRadius * w;
  const double height = SmoothMax(opening.height, neutral_share_ * w, kRounding * w);
  Eyeball eyeball;
  eyeball.radii = {radius, SmoothMax(radius, kHeightRadius * height, kRounding * w), radius};
  eyeball.iris_radius = kIrisRadius * w;
  eyeball.bulge = kBulge * w;
  eyeball.centre = {opening.middle + aside_ * w, opening.lower + 0.5 * height + up_ * w, 0};

  // The depth of the centre at which the ball touches each point, of which the smooth minimum is not above the least.
  std::vector<double> depths;
  depths.reserve(skin_.size() + skin_triangles_.size());
  const auto add = [&](const Eigen::RowVector3d& point) {
    const double x = point.x() - eyeball.centre.x(), y = point.y() - eyeball.centre.y(),
                 outside = std::max(0.0, std::hypot(x / eyeball.radii.x(), y / eyeball.radii.y()) - 1);
    depths.push_back(point.z() - eyeball.Front(x, y) + kSideSlope * radius * outside);
  };
  for (const int v : skin_) add(vertices.row(v));
  for (const auto& [a, b, c] : skin_triangles_) add((vertices.row(a) + vertices.row(b) + vertices.row(c)) / 3);
  const double least = *std::min_element(depths.begin(), depths.end());
  double sum = 0;
  for (const double depth : depths) sum += std::exp(-kSharpness / w * (depth - least));
  eyeball.centre.z() = least - w / kSharpness * std::log(sum) - kClearance * w;
  return eyeball;
}

int NumEyeballVertices() {
  return 2 + int(kEyeRings.size()) * kSegments;
}

const EyeballMesh& EyeballTopology() {
  static const EyeballMesh mesh = MakeEyeballTopology();
  return mesh;
}

geometry::Points EyeballPoints(const Eyeball& eyeball) {
  geometry::Points points(NumEyeballVertices(), 3);
  const geometry::Vector3 &radii = eyeball.radii, &centre = eyeball.centre;
  const double iris = eyeball.iris_radius / radii.x();
  points.row(0) = (centre + geometry::Vector3(0, 0, eyeball.Front(0, 0))).transpose();
  points.row(points.rows() - 1) = (centre - geometry::Vector3(0, 0, radii.z())).transpose();
  for (size_t ring = 0; ring < kEyeRings.size(); ++ring) {
    const EyeRing& shape = kEyeRings[ring];
    const double radius = shape.of_iris ? shape.radius * iris : shape.radius;
    // Round in front, where the iris is; an ellipse of the ball's shape at its equator and behind it.
    const double round = shape.is_front ? std::clamp((1 - radius) / (1 - iris), 0.0, 1.0) : 0.0;
    const double squeeze = 1 + round * (radii.x() / radii.y() - 1);
    for (int i = 0; i < kSegments; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSegments;
      const double x = radii.x() * radius * std::cos(angle), y = radii.y() * squeeze * radius * std::sin(angle);
      const double z = shape.is_front ? eyeball.Front(x, y) : -eyeball.Front(x, y);
      points.row(1 + Eigen::Index(ring) * kSegments + i) = (centre + geometry::Vector3(x, y, z)).transpose();
    }
  }
  return points;
}

geometry::TextureCoordinates EyeballUv() {
  geometry::TextureCoordinates uv = geometry::TextureCoordinates::Constant(NumEyeballVertices(), 2, 0.5);
  for (int ring = 0; ring < int(kEyeRings.size()); ++ring) {
    const double radius = 0.5 * (ring + 1) / double(kEyeRings.size() + 1);
    for (int i = 0; i < kSegments; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSegments;
      uv.row(1 + ring * kSegments + i) << 0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle);
    }
  }
  return uv;
}

}  // namespace daumier::faces
