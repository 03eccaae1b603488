#include "fitting/labelled_solver.h"

#include "tests/fitting/labelled_face.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

namespace daumier::fitting {
namespace {

SeenFace AllSeen(const LabelledFace& face) {
  SeenFace seen;
  seen.points = face.points;
  seen.mean = face.gaussian.mean.cast<double>();
  seen.modes = face.gaussian.rows.cast<double>();
  seen.camera = face.camera;
  return seen;
}

ModePrior StandardPrior(const SeenFace& seen) {
  return {Eigen::VectorXd::Zero(seen.num_modes()), Eigen::VectorXd::Ones(seen.num_modes())};
}

TEST(TurnOfAHead, IsThatOfTheTurnedCamera) {
  const Eigen::Vector3d point(1, 2, 3);
  const render::Camera front = render::FrontalCamera({0, 0, 0}, 5, 100),
                       turned = render::TurnedCamera({0, 0, 0}, 5, 100, 20, 10);
  const Eigen::Vector3d moved = TurnOf(20 * std::numbers::pi / 180, 10 * std::numbers::pi / 180) * point;
  geometry::Points a(1, 3), b(1, 3);
  a.row(0) = moved.transpose();
  b.row(0) = point.transpose();
  EXPECT_TRUE(render::Project(front, a).isApprox(render::Project(turned, b), 1e-9));
}

/// Where the frame is fixed but for its shift, the scale of deviations is fixed and their distribution is normal, the
/// problem is a ridge regression.
TEST(LabelledSolver, IsARidgeRegressionWhereOnlyWeightsAndShiftAreFree) {
  const LabelledFace face;
  const SeenFace seen = AllSeen(face);
  LabelledDrawing drawing = face.PointsOf(face.Face(8));
  drawing.point(faces::FacePoint::kContourLeft).confidence = 0;
  drawing.point(faces::FacePoint::kContourRight).confidence = 0;
  drawing.point(faces::FacePoint::kLipTop).confidence = 0.25;
  LabelledFitOptions options;
  options.degrees_of_freedom = 1e3;
  options.scale_strength = 1e6;
  options.turn_deviation = 0.01;
  options.frame.scale_deviation = 1e-3;
  options.frame.turn_deviation = 0.1;
  options.point_rounds = 20;
  options.stroke_rounds = 0;
  ModePrior prior = StandardPrior(seen);
  prior.mean[1] = 0.5;
  prior.deviation[2] = 0.1;
  const auto solved = SolveFace(seen, drawing, prior, options);
  ASSERT_TRUE(solved.has_value());

  // In the plane of the sheet: x = scale * world x + ..., y the other way.
  const double deviation = options.point_deviation * EyeDistance(face.points, face.OnSheet(face.gaussian.mean));
  const Eigen::MatrixX2d on_sheet = face.OnSheet(face.gaussian.mean);
  const Eigen::Index num_modes = seen.num_modes();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(num_modes + 2, num_modes + 2);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(num_modes + 2);
  for (int i = 0; i < faces::kNumLandmarkPoints; ++i) {
    const LabelledPoint& point = drawing.points[size_t(i)];
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(num_modes + 2);
      double residual = point.position[axis];
      const auto& vertices = face.points.of_points[size_t(i)];
      for (const int vertex : vertices) {
        const double sign = axis == 0 ? 1 : -1;
        row.head(num_modes) += sign * face.camera.scale * seen.modes.col(3 * vertex + axis) / double(vertices.size());
        residual -= on_sheet(vertex, axis) / double(vertices.size());
      }
      row[num_modes + axis] = 1;
      normal += point.confidence / (deviation * deviation) * row * row.transpose();
      right += point.confidence / (deviation * deviation) * residual * row;
    }
  }
  normal.diagonal().head(num_modes) += prior.deviation.array().square().inverse().matrix();
  right.head(num_modes) += prior.mean.cwiseQuotient(prior.deviation.cwiseAbs2());
  const Eigen::VectorXd expected = normal.ldlt().solve(right);
  for (Eigen::Index k = 0; k < num_modes; ++k) EXPECT_NEAR(solved->weights[k], expected[k], 0.03) << k;
  EXPECT_NEAR(solved->residual_scale, 1, 0.01);
}

TEST(LabelledSolver, MeasuresHowFarADrawingIsFromFaces) {
  const LabelledFace face;
  const SeenFace seen = AllSeen(face);
  const auto scale = [&](double noise) {
    LabelledDrawing drawing = face.PointsOf(face.Face(8));
    Rng rng(2);
    const double eyes = EyeDistance(face.points, face.OnSheet(face.gaussian.mean));
    for (auto& point : drawing.points) point.position += noise * eyes * Eigen::Vector2d(rng.Normal(), rng.Normal());
    return SolveFace(seen, drawing, StandardPrior(seen), {.scale_strength = 0}).value().residual_scale;
  };
  EXPECT_LT(scale(0), 0.3);
  EXPECT_NEAR(scale(0.03), 1, 0.4);
  EXPECT_GT(scale(0.2), 3);
}

TEST(LabelledSolver, RefusesAPriorOfAnotherSize) {
  const LabelledFace face;
  const SeenFace seen = AllSeen(face);
  testing::ExpectError(
      [&] {
        SolveFace(seen, {}, {Eigen::VectorXd::Zero(3), Eigen::VectorXd::Ones(3)});
      },
      "a prior of 3 and 3 numbers");
  EXPECT_FALSE(SolveFace(seen, {}, StandardPrior(seen)).has_value());
}

}  // namespace
}  // namespace daumier::fitting
