#include "fitting/code_landmarks.h"

#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <limits>

namespace daumier::testing {
namespace {

fitting::ScaledView SomeView() {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(-0.15, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return {11, turn, {160, 130}};
}

Eigen::VectorXd SomeCode() {
  Eigen::VectorXd code(FieldModel::kFields);
  code << 0.8, -0.6, 0.2, 0.9, 0.5, 0.5;
  return code;
}

/// Landmarks of the template's own vertices, but for the contour.
std::vector<fitting::PicturedPoint> InnerPoints(const FieldModel& model, const Eigen::VectorXd& code,
                                                const fitting::ScaledView& view) {
  const auto& landmarks = model.face_template().annotation.landmarks;
  const std::vector<int> vertices(landmarks.begin() + 17, landmarks.end());
  const fitting::PicturePoints pixels = view.Project(model.Vertices(code)(vertices, Eigen::all));
  std::vector<fitting::PicturedPoint> points;
  for (size_t i = 0; i < vertices.size(); ++i)
    points.push_back({vertices[i], pixels.row(Eigen::Index(i)).transpose(), -1});
  return points;
}

TEST(ScaledView, IsFoundFromItsOwnPoints) {
  const FieldModel model;
  const geometry::Points& points = model.face_template().neutral;
  const fitting::ScaledView view = SomeView();
  const fitting::ScaledView found =
      fitting::FindScaledView(points, view.Project(points), Eigen::VectorXd::Ones(points.rows()));
  EXPECT_NEAR(found.scale, view.scale, 1e-4);
  EXPECT_LT((found.rotation - view.rotation).norm(), 1e-5);
  EXPECT_LT((found.shift - view.shift).norm(), 1e-3);
  EXPECT_NEAR(found.rotation.determinant(), 1, 1e-9);
}

TEST(ScaledView, RefusesPointsInOnePlace) {
  ExpectError(
      [] {
        fitting::FindScaledView(geometry::Points::Ones(5, 3), fitting::PicturePoints::Ones(5, 2),
                                Eigen::VectorXd::Ones(5));
      },
      "in one place");
  ExpectError(
      [] {
        fitting::FindScaledView(geometry::Points::Random(5, 3), fitting::PicturePoints::Random(5, 2),
                                Eigen::VectorXd::Zero(5));
      },
      "four or more");
}

TEST(CodeLandmarks, PointsOfTheModelsFaceAreReached) {
  for (const double bend : {0.0, 0.2}) {
    const FieldModel model(bend);
    const fitting::ContourPaths contour(model.face_template());
    const auto points = InnerPoints(model, SomeCode(), SomeView());
    const fitting::CodeLandmarkFit fit =
        fitting::FitCodeToLandmarks(model, contour, points, {.deviation = 1e-3, .rounds = 40});
    EXPECT_LT(fit.distances_px.maxCoeff() / fit.eye_distance_px, 0.01) << bend;
    // Pictures do not show scale; what they show agrees with the true face in its own view.
    const fitting::CodeLandmarkFit pose = fitting::FitCodeToLandmarks(model, contour, points, {.adjusts_code = false});
    EXPECT_LT(5 * fit.distances_px.mean(), pose.distances_px.mean()) << bend;
    EXPECT_EQ(pose.code, Eigen::VectorXd::Zero(FieldModel::kFields));
  }
}

TEST(CodeLandmarks, ThePicturesPlaceScaleAndRollDoNotMatter) {
  const FieldModel model;
  const fitting::ContourPaths contour(model.face_template());
  auto points = InnerPoints(model, SomeCode(), SomeView());
  const fitting::CodeLandmarkFit fit = fitting::FitCodeToLandmarks(model, contour, points);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.4).toRotationMatrix();
  for (fitting::PicturedPoint& point : points) point.pixel = 2.5 * turn * point.pixel + Eigen::Vector2d(-40, 90);
  const fitting::CodeLandmarkFit moved = fitting::FitCodeToLandmarks(model, contour, points);
  EXPECT_LT((moved.code - fit.code).norm(), 0.02);
  EXPECT_NEAR(moved.view.scale / fit.view.scale, 2.5, 0.02);
}

TEST(CodeLandmarks, AnOutlierHardlyCounts) {
  const FieldModel model;
  const fitting::ContourPaths contour(model.face_template());
  auto points = InnerPoints(model, SomeCode(), SomeView());
  const fitting::CodeLandmarkFit clean = fitting::FitCodeToLandmarks(model, contour, points);
  points[13].pixel += Eigen::Vector2d(80, -60);
  const fitting::CodeLandmarkFit robust = fitting::FitCodeToLandmarks(model, contour, points);
  EXPECT_LT(robust.weights[13], 0.01);
  EXPECT_LT((robust.code - clean.code).norm(), 0.3);
}

TEST(CodeLandmarks, MissingPointsAreAllowed) {
  const FieldModel model;
  fitting::PicturePoints landmarks = fitting::PicturePoints::Constant(68, 2, std::numeric_limits<double>::quiet_NaN());
  const auto all = InnerPoints(model, SomeCode(), SomeView());
  for (int k = 17; k < 60; k += 2) landmarks.row(k) = all[size_t(k) - 17].pixel.transpose();
  const auto points = fitting::PicturedLandmarks(model.face_template(), landmarks);
  EXPECT_EQ(points.size(), 22u);
  const fitting::CodeLandmarkFit fit =
      fitting::FitCodeToLandmarks(model, fitting::ContourPaths(model.face_template()), points);
  EXPECT_LT(fit.distances_px.mean() / fit.eye_distance_px, 0.02);
  ExpectError(
      [&] {
        fitting::FitCodeToLandmarks(model, fitting::ContourPaths(model.face_template()),
                                    {points.begin(), points.begin() + 5});
      },
      "expected 6 or more");
}

}  // namespace
}  // namespace daumier::testing
