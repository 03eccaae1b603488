#include "fitting/face_frame.h"

#include "core/error.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::fitting {
namespace {

using Eigen::Vector2d;
using faces::FacePoint;

struct PointMatch {
  Vector2d on_sheet, drawn;
  double weight;
};

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool ShowsContoursAlone(const LabelledDrawing& drawing) {
  for (int i = 0; i < faces::kNumFacePoints; ++i) {
    if (drawing.points[size_t(i)].confidence > 0 && !faces::ContourOf(FacePoint(i))) return false;
  }
  return true;
}

/// The weighted least-squares similarity with its priors: a = 1, b = 0 of (a -b; b a).
render::Placement SolveFrame(const std::vector<PointMatch>& matches, double a_precision, double b_precision) {
  Eigen::Matrix4d normal = Eigen::Vector4d(a_precision, b_precision, 0, 0).asDiagonal();
  Eigen::Vector4d right(a_precision, 0, 0, 0);
  for (const PointMatch& match : matches) {
    Eigen::Matrix<double, 2, 4> by;
    by << match.on_sheet.x(), -match.on_sheet.y(), 1, 0, match.on_sheet.y(), match.on_sheet.x(), 0, 1;
    normal += match.weight * by.transpose() * by;
    right += match.weight * by.transpose() * match.drawn;
  }
  const Eigen::Vector4d solution = normal.ldlt().solve(right);
  return render::PlacementFrom(solution[0], solution[1], solution.tail<2>());
}

}  // namespace

double EyeDistance(const faces::FacePointVertices& vertices, const Eigen::MatrixX2d& projected) {
  const Vector2d zero = Vector2d::Zero();
  return (faces::ProjectedFacePoint(vertices, FacePoint::kEyeLeftOuter, projected, zero) -
          faces::ProjectedFacePoint(vertices, FacePoint::kEyeRightOuter, projected, zero))
      .norm();
}

std::optional<render::Placement> FindFaceFrame(const faces::FacePointVertices& vertices,
                                               const Eigen::MatrixX2d& projected, const LabelledDrawing& drawing,
                                               const FaceFrameOptions& options) {
  const double eyes = EyeDistance(vertices, projected);
  DAUMIER_CHECK(eyes > 0, "a face whose outer corners of the eyes coincide has no frame");
  const double b_deviation = options.turn_deviation * std::numbers::pi / 180, unit = options.point_deviation * eyes;
  std::optional<render::Placement> frame;
  // Contours have no place before a first frame, unless nothing else is shown.
  const bool contours_alone = ShowsContoursAlone(drawing);
  for (int round = 0; round <= options.rounds; ++round) {
    std::vector<PointMatch> matches;
    std::vector<double> distances;
    for (int i = 0; i < faces::kNumFacePoints; ++i) {
      const LabelledPoint& point = drawing.points[size_t(i)];
      if (point.confidence <= 0) continue;
      DAUMIER_CHECK(point.position.allFinite(), "the point {} of the drawing is not finite",
                    faces::kFacePointNames[size_t(i)]);
      if (!frame && !contours_alone && faces::ContourOf(FacePoint(i))) continue;
      const Vector2d near = render::ToSheet(frame.value_or(render::Placement()), point.position);
      matches.push_back(
          {faces::ProjectedFacePoint(vertices, FacePoint(i), projected, near), point.position, point.confidence});
      if (frame) distances.push_back((near - matches.back().on_sheet).norm());
    }
    if (matches.empty()) return std::nullopt;
    // Distances in units of the sheet, so that the scale of the canvas does not matter.
    const double scale = frame ? frame->scale : 1;
    const double least = frame ? 3 * std::max(unit, 1.4826 * MedianOf(distances)) : 1;
    for (size_t k = 0; k < matches.size(); ++k) {
      const double share = frame ? distances[k] / least : 0;
      matches[k].weight *= std::pow(1 + share * share, -2) / (unit * unit * scale * scale);
    }
    frame = SolveFrame(matches, std::pow(options.scale_deviation, -2), std::pow(b_deviation, -2));
    DAUMIER_CHECK(frame->scale > 1e-6, "points of the drawing coincide, so that they have no frame");
  }
  return frame;
}

}  // namespace daumier::fitting
