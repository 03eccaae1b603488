#include "systems/sketch/curve_follower.h"

#include "geometry/coordinates.h"
#include "tests/support/expect_error.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class CurveFollowerTest : public ::testing::Test {
 protected:
  CurveFollowerTest() {
    testing::WritePlainSketchRun(folder_.path());
    const SketchRunFolder run = ReadSketchRunFolder(folder_.path());
    face_ = run.face_template.neutral;
    predictor_ =
        std::make_shared<const SketchPredictor>(run, std::make_shared<testing::FixedNetwork>(run.models.bilinear),
                                                nullptr, PredictOptions{.framing = "keep", .refine = false});
  }

  const testing::TempDir folder_;
  geometry::Points face_;
  std::shared_ptr<const SketchPredictor> predictor_;
};

TEST_F(CurveFollowerTest, CurvesThatAreWhereTheyWereGiveTheStart) {
  for (const Inference inference : {Inference::kNone, Inference::kNetwork, Inference::kFaces}) {
    for (const Untouched untouched : {Untouched::kStay, Untouched::kFollow}) {
      const CurveFollower follower(predictor_, inference);
      const FollowUpStart start = follower.Begin(face_, untouched);
      EXPECT_EQ(start.vertices, face_);
      EXPECT_LT((follower.Follow(start, follower.CurvesOf(face_)) - face_).cwiseAbs().maxCoeff(), 1e-5);
    }
  }
}

TEST_F(CurveFollowerTest, AShiftOfAllCurvesIsAShiftOfTheFaceInThePlane) {
  const CurveFollower follower(predictor_, Inference::kNone);
  SessionLines lines = follower.CurvesOf(face_);
  const double scale = predictor_->curves().camera.scale;
  for (SessionCurve& curve : lines.curves)
    for (Eigen::Vector2d& point : curve.points) point += scale * Eigen::Vector2d(0.5, -0.25);  // y is down.
  const geometry::Points moved = follower.Follow(follower.Begin(face_, Untouched::kStay), lines);
  EXPECT_LT(((moved - face_).rowwise() - Eigen::RowVector3d(0.5, 0.25, 0)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(CurveFollowerTest, AFaceOfTheDistributionIsInferredFromItsCurves) {
  const faces::FaceGaussian& gaussian = predictor_->run().models.gaussian;
  const auto face_of = [&](double amount) {
    Eigen::VectorXf coefficients = Eigen::VectorXf::Zero(gaussian.size());
    coefficients[0] = float(amount);
    const Eigen::VectorXf face = faces::Reconstruct(gaussian, coefficients);
    return geometry::PointsFrom(std::span(face.data(), size_t(face.size())));
  };
  const geometry::Points mean = face_of(0), truth = face_of(1.5);
  const CurveFollower follower(predictor_), alone(predictor_, Inference::kNone);
  SessionLines lines = follower.CurvesOf(truth);
  for (SessionCurve& curve : lines.curves) curve.drawn = ++lines.num_drawn;
  const auto error = [&](const CurveFollower& of) {
    return (of.Follow(of.Begin(mean, Untouched::kStay), lines) - truth).rowwise().norm().mean();
  };
  EXPECT_LT(error(follower), 0.8 * error(alone));
  EXPECT_LT(error(follower), (mean - truth).rowwise().norm().mean());
}

TEST_F(CurveFollowerTest, UntouchedCurvesStayOrFollow) {
  const CurveFollower follower(predictor_, Inference::kNone);
  SessionLines lines = follower.CurvesOf(face_);
  for (Eigen::Vector2d& point : lines.curves[0].points) point += Eigen::Vector2d(4, 0);
  const SessionLines moved_lines = lines;  // Its `drawn` is 0.
  const geometry::Points stayed = follower.Follow(follower.Begin(face_, Untouched::kStay), lines);
  const geometry::Points followed = follower.Follow(follower.Begin(face_, Untouched::kFollow), lines);
  EXPECT_GT((stayed - face_).cwiseAbs().maxCoeff(), 0.1) << "its line is where it is";
  EXPECT_LT((followed - face_).cwiseAbs().maxCoeff(), 1e-9) << "no line says anything";
  follower.MoveUntouched(face_, lines);
  EXPECT_LT((lines.curves[0].points[0] - moved_lines.curves[0].points[0]).norm() - 4, 1e-3);
}

TEST_F(CurveFollowerTest, RefusesAFaceOfOtherVertices) {
  testing::ExpectError([&] { CurveFollower(predictor_).Begin(geometry::Points::Zero(3, 3), Untouched::kStay); },
                       "a face of 3 vertices");
}

}  // namespace
}  // namespace daumier::sketch
