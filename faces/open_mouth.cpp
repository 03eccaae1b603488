#include "faces/open_mouth.h"

#include "core/error.h"
#include "geometry/operators.h"
#include "geometry/path.h"
#include "geometry/poisson.h"
#include "geometry/topology.h"

#include <algorithm>
#include <limits>
#include <map>

namespace daumier::faces {
namespace {

constexpr int kRightCorner = 60, kUpperMiddle = 62, kLeftCorner = 64, kLowerMiddle = 66;

/// The height of a path at x, between its vertices linearly; of its ends beyond them.
class PathHeight {
 public:
  PathHeight(const geometry::Points& points, const std::vector<int>& path) {
    for (const int v : path) heights_.emplace(points(v, 0), points(v, 1));
  }

  double at(double x) const {
    const auto right = heights_.lower_bound(x);
    if (right == heights_.begin()) return right->second;
    const auto left = std::prev(right);
    if (right == heights_.end()) return left->second;
    const double share = (x - left->first) / (right->first - left->first);
    return (1 - share) * left->second + share * right->second;
  }

 private:
  std::map<double, double> heights_;
};

}  // namespace

LipContours FindLipContours(const FaceTemplate& face_template) {
  const auto& landmarks = face_template.annotation.landmarks;
  const auto neighbours = geometry::VertexNeighbours(face_template.triangles, face_template.num_vertices());
  const auto trace = [&](std::initializer_list<int> way) {
    std::vector<int> waypoints;
    for (const int landmark : way) waypoints.push_back(landmarks[landmark]);
    return geometry::TracePath(face_template.neutral, neighbours, waypoints, geometry::PathEnds::kOpen);
  };
  LipContours contours{trace({kRightCorner, 61, kUpperMiddle, 63, kLeftCorner}),
                       trace({kRightCorner, 67, kLowerMiddle, 65, kLeftCorner})};
  const int middle = landmarks[kLowerMiddle];
  DAUMIER_CHECK(std::find(contours.upper.begin(), contours.upper.end(), middle) == contours.upper.end(),
                "the lips of {} share vertex {}: landmark {} lies on the upper one", face_template.source, middle,
                kLowerMiddle);
  return contours;
}

geometry::Points OpenMouth(const FaceTemplate& face_template, double gap_cm) {
  DAUMIER_CHECK(gap_cm >= 0, "lips that are {} cm apart", gap_cm);
  const geometry::Points& neutral = face_template.neutral;
  const auto& landmarks = face_template.annotation.landmarks;
  const LipContours lips = FindLipContours(face_template);
  const double right = neutral(landmarks[kRightCorner], 0), left = neutral(landmarks[kLeftCorner], 0),
               middle = neutral(landmarks[kLowerMiddle], 0);
  DAUMIER_CHECK(right < middle && middle < left, "the middle of the lower lip of {} is not between its corners",
                face_template.source);

  std::map<int, double> down;  // Where a vertex is held, cm below its place.
  const PathHeight upper(neutral, lips.upper);
  double farthest = 0;
  for (const int v : lips.lower) {
    const double x = neutral(v, 0), corner = x < middle ? right : left;
    const double t = std::min(1.0, (x - middle) / (corner - middle));
    down[v] = std::max(0.0, gap_cm * (1 - t * t) - (upper.at(x) - neutral(v, 1)));
    farthest = std::max(farthest, down[v]);
  }
  for (const int v : lips.upper) down[v] = 0;
  if (farthest == 0) return neutral;

  std::vector<int> contours = lips.upper;
  contours.insert(contours.end(), lips.lower.begin(), lips.lower.end());
  const geometry::Points contour_points = neutral(contours, Eigen::all);
  for (int v = 0; v < neutral.rows(); ++v) {
    const double distance = (contour_points.rowwise() - neutral.row(v)).rowwise().norm().minCoeff();
    if (distance > left - right) down[v] = 0;
  }

  std::vector<int> held;
  Eigen::MatrixXd values(down.size(), 1);
  for (const auto& [v, value] : down) {
    values(Eigen::Index(held.size()), 0) = value;
    held.push_back(v);
  }
  const Eigen::MatrixXd field = geometry::SolvePoisson(geometry::CotangentLaplacian({neutral, face_template.triangles}),
                                                       held, Eigen::MatrixXd::Zero(neutral.rows(), 1), values);
  geometry::Points open = neutral;
  open.col(1) -= field.col(0);
  return open;
}

}  // namespace daumier::faces
