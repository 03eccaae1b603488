#include "faces/face_points.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::faces {
namespace {

using LandmarksOfPoint = std::pair<FacePoint, std::vector<size_t>>;

const std::vector<LandmarksOfPoint>& LandmarksOfPoints() {
  using enum FacePoint;
  static const std::vector<LandmarksOfPoint> kLandmarks = {
      {kEyeRightOuter, {36}},
      {kEyeRightInner, {39}},
      {kEyeRightTop, {37, 38}},
      {kEyeRightBottom, {40, 41}},
      {kEyeLeftInner, {42}},
      {kEyeLeftOuter, {45}},
      {kEyeLeftTop, {43, 44}},
      {kEyeLeftBottom, {46, 47}},
      {kBrowRightOuter, {17}},
      {kBrowRightInner, {21}},
      {kBrowLeftInner, {22}},
      {kBrowLeftOuter, {26}},
      {kNoseBottom, {33}},
      {kMouthRight, {48}},
      {kMouthLeft, {54}},
      {kLipTop, {51}},
      {kLipBottom, {57}},
      {kInnerTop, {62}},
      {kInnerBottom, {66}},
      {kEyeRightCentre, {36, 37, 38, 39, 40, 41}},
      {kEyeLeftCentre, {42, 43, 44, 45, 46, 47}},
  };
  return kLandmarks;
}

/// The path of a curve; empty if there is none.
std::vector<int> CurvePath(const Annotation& annotation, std::string_view name) {
  for (const FeatureCurve& curve : annotation.curves) {
    if (curve.name == name) return curve.vertices;
  }
  return {};
}

/// The vertex with the greatest sign * x of the neutral face.
int Outermost(const std::vector<int>& path, const geometry::Points& neutral, double sign) {
  return *std::max_element(path.begin(), path.end(),
                           [&](int a, int b) { return sign * neutral(a, 0) < sign * neutral(b, 0); });
}

}  // namespace

FacePointVertices FindFacePoints(const FaceTemplate& face_template) {
  const Annotation& annotation = face_template.annotation;
  const geometry::Points& neutral = face_template.neutral;
  const auto landmark = [&](size_t i) {
    const int vertex = annotation.landmarks[i];
    DAUMIER_CHECK(vertex >= 0 && vertex < face_template.num_vertices(),
                  "the template has no landmark {}, which points of drawings need; annotate all 68", i);
    return vertex;
  };
  FacePointVertices result;
  const auto of = [&](FacePoint point) -> std::vector<int>& { return result.of_points[size_t(point)]; };
  for (const auto& [point, landmarks] : LandmarksOfPoints()) {
    for (const size_t i : landmarks) of(point).push_back(landmark(i));
  }
  const std::vector<int> right_wing = CurvePath(annotation, "nose_wing_right"),
                         left_wing = CurvePath(annotation, "nose_wing_left");
  of(FacePoint::kNoseWingRight) = {right_wing.empty() ? landmark(31) : Outermost(right_wing, neutral, -1)};
  of(FacePoint::kNoseWingLeft) = {left_wing.empty() ? landmark(35) : Outermost(left_wing, neutral, 1)};

  std::vector<int> jaw = CurvePath(annotation, "jaw");
  if (jaw.empty()) {
    for (size_t i = 3; i <= 13; ++i) jaw.push_back(landmark(i));
  }
  if (neutral(jaw.front(), 0) > neutral(jaw.back(), 0)) std::reverse(jaw.begin(), jaw.end());
  const double middle_x = neutral(landmark(kChinLandmark), 0);
  const auto middle = std::min_element(jaw.begin(), jaw.end(), [&](int a, int b) {
    return std::abs(neutral(a, 0) - middle_x) < std::abs(neutral(b, 0) - middle_x);
  });
  of(FacePoint::kChin) = {*middle};
  result.contours[0] = {landmark(0), landmark(1), landmark(2)};
  result.contours[0].insert(result.contours[0].end(), jaw.begin(), middle + 1);
  result.contours[1] = {landmark(16), landmark(15), landmark(14)};
  result.contours[1].insert(result.contours[1].end(), jaw.rbegin(), std::make_reverse_iterator(middle));
  return result;
}

std::optional<int> ContourOf(FacePoint point) {
  if (point == FacePoint::kContourRight) return 0;
  if (point == FacePoint::kContourLeft) return 1;
  return std::nullopt;
}

PolylinePlace NearestOnPolyline(const std::vector<int>& polyline, const Eigen::MatrixX2d& projected,
                                const Eigen::Vector2d& near) {
  DAUMIER_CHECK(!polyline.empty(), "a contour without vertices has no nearest point");
  PolylinePlace best{polyline.front(), polyline.front(), 0};
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i + 1 < polyline.size(); ++i) {
    const Eigen::Vector2d from = projected.row(polyline[i]), step = projected.row(polyline[i + 1]).transpose() - from;
    const double share = std::clamp((near - from).dot(step) / std::max(step.squaredNorm(), 1e-12), 0.0, 1.0);
    const double distance = (from + share * step - near).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = {polyline[i], polyline[i + 1], share};
  }
  return best;
}

Eigen::Vector2d ProjectedFacePoint(const FacePointVertices& vertices, FacePoint point,
                                   const Eigen::MatrixX2d& projected, const Eigen::Vector2d& near) {
  if (const std::optional<int> contour = ContourOf(point)) {
    const PolylinePlace place = NearestOnPolyline(vertices.contours[size_t(*contour)], projected, near);
    return (1 - place.share) * projected.row(place.from) + place.share * projected.row(place.to);
  }
  const std::vector<int>& of_point = vertices.of_points[size_t(point)];
  DAUMIER_CHECK(!of_point.empty(), "the point {} has no vertices", kFacePointNames[size_t(point)]);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const int vertex : of_point) sum += projected.row(vertex);
  return sum / double(of_point.size());
}

}  // namespace daumier::faces
