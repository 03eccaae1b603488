#include "fitting/labelled_fit.h"

#include "tests/fitting/labelled_face.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

using faces::FacePoint;
using faces::LineLabel;

const LabelledFace& TheFace() {
  static const LabelledFace face;
  return face;
}

LabelledFitter FitterOf(const LabelledFace& face, const LabelledFitOptions& options = {}) {
  return {face.face_template, face.camera, face.gaussian, options};
}

double MeanFaceDistance(const LabelledFace& face, const LabelledDrawing& drawing) {
  LabelledFit mean;
  mean.vertices.assign(face.gaussian.mean.data(), face.gaussian.mean.data() + face.gaussian.mean.size());
  mean.frame = FindFaceFrame(face.points, face.OnSheet(face.gaussian.mean), drawing).value();
  return MeanPointDistance(face, mean, drawing);
}

TEST(TurnedAs, UprightUndoesIt) {
  const LabelledFace& face = TheFace();
  LabelledFit fit;
  fit.yaw_degrees = 25;
  fit.pitch_degrees = -10;
  fit.pivot = {0.5, 1, -2};
  fit.vertices = TurnedAs(fit, face.gaussian.mean);
  const std::vector<float> upright = Upright(fit);
  double most = 0, moved = 0;
  for (size_t i = 0; i < upright.size(); ++i) {
    most = std::max(most, std::abs(double(upright[i]) - face.gaussian.mean[Eigen::Index(i)]));
    moved = std::max(moved, std::abs(double(fit.vertices[i]) - face.gaussian.mean[Eigen::Index(i)]));
  }
  EXPECT_LT(most, 1e-4);
  EXPECT_GT(moved, 0.1);
}

TEST(LabelledFit, ReachesThePointsOfAFaceOfItsGaussian) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  for (const uint64_t seed : {1, 2, 3}) {
    const LabelledDrawing drawing =
        face.PointsOf(face.Face(seed), {.scale = 0.8, .shift = {30, 20}, .turn_degrees = 6});
    const auto fit = fitter.Fit(drawing);
    ASSERT_TRUE(fit.has_value());
    EXPECT_LT(MeanPointDistance(face, *fit, drawing), 0.25 * MeanFaceDistance(face, drawing)) << seed;
    EXPECT_LT(fit->residual_scale, 1.1);
    EXPECT_EQ(fit->num_crossed_lips + fit->num_crossed_lids, 0);
  }
}

TEST(LabelledFit, OfTheMeanFaceIsTheMeanFace) {
  const LabelledFace& face = TheFace();
  const auto fit = FitterOf(face).Fit(face.PointsOf(face.gaussian.mean));
  EXPECT_LT(fit->coefficients.cwiseAbs().maxCoeff(), 0.05);
  EXPECT_NEAR(fit->frame.scale, 1, 0.01);
  EXPECT_NEAR(fit->yaw_degrees, 0, 0.3);
}

TEST(LabelledFit, MovesWithTheDrawing) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  const render::Placement move{0.9, {12, -7}, 4};
  const auto here = fitter.Fit(face.PointsOf(face.Face(5)));
  const auto there = fitter.Fit(face.PointsOf(face.Face(5), move));
  EXPECT_LT((here->coefficients - there->coefficients).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_NEAR(there->frame.scale / here->frame.scale, 0.9, 0.01);
  EXPECT_NEAR(there->frame.turn_degrees - here->frame.turn_degrees, 4, 0.5);
}

TEST(LabelledFit, IgnoresALandmarkThatIsFarOff) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  const LabelledDrawing truth = face.PointsOf(face.Face(5));
  LabelledDrawing drawing = truth;
  drawing.point(FacePoint::kNoseBottom).position += Eigen::Vector2d(60, -40);
  EXPECT_LT(MeanPointDistance(face, *fitter.Fit(drawing), truth), 1.5);
  drawing.point(FacePoint::kNoseBottom).confidence = 0;
  EXPECT_LT(MeanPointDistance(face, *fitter.Fit(drawing), truth), 1.0);
}

TEST(LabelledFit, StaysAtThePriorWhereADrawingIsWild) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  LabelledDrawing drawing = face.PointsOf(face.gaussian.mean);
  Rng rng(1);
  for (auto& point : drawing.points) point.position += 25 * Eigen::Vector2d(rng.Normal(), rng.Normal());
  const auto fit = fitter.Fit(drawing);
  EXPECT_GT(fit->residual_scale, 3);
  EXPECT_LT(fit->coefficients.cwiseAbs().maxCoeff(), 2.5);
  EXPECT_EQ(fit->num_flipped, 0);
}

TEST(LabelledFit, FollowsLinesAndIgnoresHair) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  const Eigen::VectorXf other = face.Face(9, 1.5);
  const LabelledDrawing truth = face.PointsOf(other);
  LabelledDrawing drawing;
  for (const auto point : {FacePoint::kEyeRightOuter, FacePoint::kEyeLeftOuter, FacePoint::kNoseBottom})
    drawing.point(point) = truth.point(point);
  const auto without = fitter.Fit(drawing);
  const auto lines = [&](LineLabel silhouette, LineLabel mouth) {
    return std::vector<LabelledStroke>{face.StrokeOf(other, "silhouette", silhouette),
                                       face.StrokeOf(other, "lower_mouth", mouth)};
  };
  drawing.strokes = lines(LineLabel::kHair, LineLabel::kOther);
  const auto hair = fitter.Fit(drawing);
  EXPECT_EQ(hair->num_matched, 0);
  EXPECT_LT((hair->coefficients - without->coefficients).norm(), 1e-3);
  drawing.strokes = lines(LineLabel::kSilhouette, LineLabel::kInnerMouth);
  const auto with = fitter.Fit(drawing);
  EXPECT_GT(with->num_matched, 10);
  EXPECT_LT(MeanPointDistance(face, *with, truth), 0.9 * MeanPointDistance(face, *without, truth));
}

TEST(LabelledFit, ClosesWhatIsDrawnClosedAndOpensWhatIsDrawnOpen) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  LabelledDrawing drawing = face.PointsOf(face.gaussian.mean);
  const auto gap = [&](const LabelledFit& fit, size_t opening) {
    const std::vector<float> upright = Upright(fit);
    geometry::Points points(Eigen::Index(upright.size() / 3), 3);
    for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = upright[size_t(i)];
    return GapsOf(FindOpeningPairs(face.face_template)[opening], points).maxCoeff();
  };
  const double open_mouth = gap(*fitter.Fit(drawing), 0), open_eye = gap(*fitter.Fit(drawing), 1);
  drawing.mouth = {0.9, 0.1, 0};
  drawing.eyes[0] = {0.2, 0.8};
  drawing.eyes[1] = {0.8, 0.2};
  const auto closed = fitter.Fit(drawing);
  EXPECT_LT(gap(*closed, 0), 0.1);
  EXPECT_GT(open_mouth, 0.5);
  EXPECT_LT(gap(*closed, 1), 0.1);
  EXPECT_GT(gap(*closed, 2), 0.7 * open_eye);
  drawing.mouth = {0.1, 0.2, 0.7};
  EXPECT_GT(gap(*fitter.Fit(drawing), 0), 0.8 * open_mouth);
}

TEST(LabelledFit, TurnsThreeQuarterViews) {
  const LabelledFace& face = TheFace();
  const Eigen::VectorXf turned = [&] {
    Eigen::VectorXf result = face.gaussian.mean;
    const Eigen::Matrix3f turn = TurnOf(30 * std::numbers::pi / 180, 0).cast<float>();
    for (Eigen::Index v = 0; v < result.size() / 3; ++v) result.segment<3>(3 * v) = turn * result.segment<3>(3 * v);
    return result;
  }();
  LabelledDrawing drawing = face.PointsOf(turned);
  drawing.view[size_t(faces::DrawnView::kThreeQuarterLeft)] = 1;
  const auto fit = FitterOf(face).Fit(drawing);
  EXPECT_NEAR(fit->yaw_degrees, 30, 6);
  const std::vector<float> upright = Upright(*fit);
  double sum = 0;
  for (size_t i = 0; i < upright.size(); ++i) sum += std::abs(upright[i] - face.gaussian.mean[Eigen::Index(i)]);
  EXPECT_LT(sum / double(upright.size()), 0.3);
}

TEST(LabelledFit, LeansOnAGivenPrior) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  LabelledDrawing drawing;
  drawing.point(FacePoint::kNoseBottom) = {{128, 128}, 1};
  FacePrior prior{Eigen::VectorXf::LinSpaced(face.gaussian.size(), -1, 1), 0.2};
  EXPECT_LT((fitter.Fit(drawing, prior)->coefficients - prior.mean).cwiseAbs().maxCoeff(), 0.05);
  prior.mean.conservativeResize(2);
  testing::ExpectError([&] { fitter.Fit(drawing, prior); }, "a prior mean of 2 coefficients");
  testing::ExpectError([&] { fitter.Fit(drawing, {{}, 0}); }, "a prior of deviation 0");
}

TEST(LabelledFit, IsAbsentWithoutPointsAndTheSameFromThreads) {
  const LabelledFace& face = TheFace();
  const LabelledFitter fitter = FitterOf(face);
  EXPECT_FALSE(fitter.Fit({}).has_value());
  const LabelledDrawing drawing = face.PointsOf(face.Face(2));
  testing::ExpectTheSameFromThreads(2, [&] { return fitter.Fit(drawing)->vertices; });
}

TEST(LabelledFit, RefusesWhatDoesNotBelongTogether) {
  const LabelledFace& face = TheFace();
  faces::FaceGaussian other = face.gaussian;
  other.rows.conservativeResize(Eigen::NoChange, 9);
  testing::ExpectError([&] { LabelledFitter(face.face_template, face.camera, other); }, "9 coordinates");
  testing::ExpectError(
      [&] { LabelledFitter(face.face_template, render::WithPerspective(face.camera, 50), face.gaussian); },
      "orthographic camera alone");
}

}  // namespace
}  // namespace daumier::fitting
