#include "systems/sketch/curve_follower.h"

#include "core/error.h"
#include "geometry/coordinates.h"
#include "geometry/normals.h"
#include "geometry/operators.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace daumier::sketch {

namespace {

/// Of a curve, on the canvas: each stretch of kIndependent counts as one point with this deviation.
constexpr double kLineDeviation = 2, kIndependent = 8;
/// Of a repair: solutions with relaxed pins, passes before each, and passes behind the last.
constexpr int kRepairRounds = 3, kRepairPasses = 20, kLastPasses = 1000;

}  // namespace

CurveFollower::CurveFollower(std::shared_ptr<const SketchPredictor> predictor, Inference inference, Agreement agreement)
    : predictor_(std::move(predictor)),
      inference_(inference),
      agreement_(agreement),
      repair_(predictor_->run().face_template.triangles, predictor_->run().face_template.num_vertices()) {
  const faces::FaceTemplate& face_template = predictor_->run().face_template;
  const fitting::ProjectedCurves& curves = predictor_->curves();
  DAUMIER_CHECK(!curves.camera.perspective, "the camera of the sketches is in perspective");
  std::vector<int> pins;
  for (const int vertex : curves.vertices) {
    const auto known = std::ranges::find(pins, vertex);
    pin_of_point_.push_back(int(known - pins.begin()));
    if (known == pins.end()) pins.push_back(vertex);
  }
  const faces::FaceGaussian& gaussian = predictor_->run().models.gaussian;
  DAUMIER_CHECK(gaussian.size() > 0, "{}: the run has no normal distribution of faces",
                predictor_->run().directory.string());
  curve_effects_.resize(gaussian.size(), 2 * std::ssize(pins));
  const Eigen::Matrix<double, 2, 3> pixels_from_cm = curves.camera.scale * curves.camera.camera_from_world.topRows<2>();
  for (Eigen::Index pin = 0; pin < std::ssize(pins); ++pin)
    curve_effects_.middleCols<2>(2 * pin) =
        gaussian.rows.middleCols<3>(3 * Eigen::Index(pins[size_t(pin)])).cast<double>() * pixels_from_cm.transpose();
  for (size_t c = 0; c + 1 < curves.offsets.size(); ++c) {
    const auto first = size_t(curves.offsets[c]), last = size_t(curves.offsets[c + 1]);
    Eigen::MatrixXd effects(gaussian.size(), 2 * Eigen::Index(last - first));
    for (size_t i = first; i < last; ++i)
      effects.middleCols<2>(2 * Eigen::Index(i - first)) =
          curve_effects_.middleCols<2>(2 * Eigen::Index(pin_of_point_[i]));
    curve_normals_.emplace_back(effects * effects.transpose());
  }
  deformation_ = std::make_unique<geometry::PinnedDeformation>(
      geometry::UniformLaplacian(face_template.triangles, face_template.num_vertices()), std::move(pins));
}

SessionLines CurveFollower::CurvesOf(const geometry::Points& face) const {
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> single = face.cast<float>();
  const std::vector<float> projected =
      fitting::Project(predictor_->curves(), std::span(single.data(), size_t(single.size())));
  return LinesOf(predictor_->run().face_template, predictor_->run().feature_curves, predictor_->curves().offsets,
                 projected);
}

void CurveFollower::MoveUntouched(const geometry::Points& face, SessionLines& lines) const {
  const SessionLines own = CurvesOf(face);
  for (size_t c = 0; c < lines.curves.size(); ++c)
    if (lines.curves[c].drawn == 0) lines.curves[c].points = own.curves[c].points;
}

FollowUpStart CurveFollower::Begin(const geometry::Points& face, Untouched untouched) const {
  const int num_vertices = predictor_->run().face_template.num_vertices();
  DAUMIER_CHECK(face.rows() == num_vertices, "a face of {} vertices, expected {}", face.rows(), num_vertices);
  const geometry::Triangles& triangles = predictor_->run().face_template.triangles;
  FollowUpStart start{face, untouched, geometry::AreaNormals({face, triangles})};
  if (inference_ == Inference::kNetwork) start.network = NetworkOf(StrokesOf(CurvesOf(face)));
  return start;
}

geometry::Points CurveFollower::Follow(const FollowUpStart& start, const SessionLines& lines) const {
  return Pulled(start, Inferred(start, lines), lines);
}

geometry::Points CurveFollower::Inferred(const FollowUpStart& start, const SessionLines& lines) const {
  if (inference_ == Inference::kNetwork) return start.vertices + (NetworkOf(StrokesOf(lines)) - start.network);
  if (inference_ == Inference::kNone) return start.vertices;
  geometry::Points face = start.vertices + ChangeOfFaces(start, lines);
  if (!lines.wrinkles.empty()) face += ChangeOfWrinkles(lines);
  return face;
}

geometry::Points CurveFollower::ChangeOfWrinkles(const SessionLines& lines) const {
  SessionLines without = lines;
  without.wrinkles.clear();
  const Eigen::RowVector3d axis = predictor_->curves().camera.camera_from_world.row(2);
  const geometry::Points change = NetworkOf(StrokesOf(lines)) - NetworkOf(StrokesOf(without));
  return change * axis.transpose() * axis;
}

geometry::Points CurveFollower::ChangeOfFaces(const FollowUpStart& start, const SessionLines& lines) const {
  const faces::FaceGaussian& gaussian = predictor_->run().models.gaussian;
  const geometry::Points seen =
      render::Project(predictor_->curves().camera, start.vertices(deformation_->pins(), Eigen::all));
  Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(gaussian.size(), gaussian.size());
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(gaussian.size());
  size_t point = 0;
  for (size_t c = 0; c < lines.curves.size(); ++c) {
    const SessionCurve& curve = lines.curves[c];
    const size_t first = point;
    point += curve.points.size();
    if (curve.drawn == 0 && start.untouched == Untouched::kFollow) continue;
    const double num_independent = std::max(1.0, datasets::LengthOf(curve.points) / kIndependent);
    const double weight = num_independent / double(curve.points.size()) / (kLineDeviation * kLineDeviation);
    normal += weight * curve_normals_[c];
    for (size_t i = 0; i < curve.points.size(); ++i) {
      const int pin = pin_of_point_[first + i];
      const Eigen::Vector2d moved = curve.points[i] - seen.row(pin).head<2>().transpose();
      rhs += weight * (curve_effects_.middleCols<2>(2 * Eigen::Index(pin)) * moved);
    }
  }
  if (rhs.isZero(0)) return geometry::Points::Zero(start.vertices.rows(), 3);
  const Eigen::VectorXf weights = normal.selfadjointView<Eigen::Lower>().llt().solve(rhs).cast<float>();
  const Eigen::VectorXf change = gaussian.rows.transpose() * weights;
  return geometry::PointsFrom(std::span(change.data(), size_t(change.size())));
}

geometry::Points CurveFollower::NetworkOf(const std::vector<render::Stroke>& on_canvas) const {
  return geometry::PointsFrom(predictor_->FromStrokes({on_canvas}).front().vertices);
}

geometry::Points CurveFollower::Pulled(const FollowUpStart& start, const geometry::Points& face,
                                       const SessionLines& lines) const {
  geometry::Points displacement = deformation_->Solve(MovesOfPins(face, lines, start.untouched));
  if (agreement_ == Agreement::kRelaxed) Repair(start, face, displacement);
  return face + displacement;
}

void CurveFollower::Repair(const FollowUpStart& start, const geometry::Points& face,
                           geometry::Points& displacement) const {
  geometry::SurfaceDefects defects = repair_.Find(face, start.normals, displacement);
  for (int round = 0; round < kRepairRounds && !defects.empty(); ++round) {
    repair_.Relax(face, start.normals, std::move(defects), kRepairPasses, displacement);
    displacement = deformation_->Solve(displacement(deformation_->pins(), Eigen::all));
    defects = repair_.Find(face, start.normals, displacement);
  }
  repair_.Relax(face, start.normals, std::move(defects), kLastPasses, displacement);
}

geometry::Points CurveFollower::MovesOfPins(const geometry::Points& face, const SessionLines& lines,
                                            Untouched untouched) const {
  const render::Camera& camera = predictor_->curves().camera;
  const std::vector<int>& pins = deformation_->pins();
  const geometry::Points projected = render::Project(camera, face(pins, Eigen::all));
  geometry::Points moves = geometry::Points::Zero(Eigen::Index(pins.size()), 3);
  std::vector<int> drawn(pins.size(), -1);  // Of a vertex of several curves the last one drawn counts.
  size_t point = 0;
  for (const SessionCurve& curve : lines.curves) {
    for (const Eigen::Vector2d& target : curve.points) {
      const int pin = pin_of_point_[point++];
      if (curve.drawn <= drawn[size_t(pin)]) continue;
      drawn[size_t(pin)] = curve.drawn;
      if (untouched == Untouched::kFollow && curve.drawn == 0) continue;
      Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
      in_camera.head<2>() = (target - projected.row(pin).head<2>().transpose()) / camera.scale;
      moves.row(pin) = (camera.camera_from_world.transpose() * in_camera).transpose();
    }
  }
  return moves;
}

}  // namespace daumier::sketch
