#include "systems/portrait/portrait_measures.h"

#include "fitting/portrait_fit.h"
#include "geometry/alignment.h"
#include "geometry/coordinates.h"
#include "systems/portrait/portrait_angles.h"
#include "systems/portrait/portrait_picture.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"

#include <Eigen/Geometry>
#include <cmath>

namespace daumier::portrait {
namespace {

std::vector<float> Landmarks() {
  std::vector<float> landmarks;
  for (int n = 0; n < 68; ++n) landmarks.insert(landmarks.end(), {float(n), float(n * n % 17)});
  return landmarks;
}

TEST(LandmarkError, IsTheMeanDistanceOverThatOfTheOuterCornersOfTheEyes) {
  const std::vector<float> truth = Landmarks();
  std::vector<float> predicted = truth;
  for (size_t n = 0; n < 68; ++n) predicted[2 * n] += 3;
  const double eyes = std::hypot(45.0 - 36, 45 * 45 % 17 - 36 * 36 % 17);
  EXPECT_NEAR(LandmarkError(predicted, truth), 3 / eyes, 1e-6);
  EXPECT_EQ(LandmarkError(truth, truth), 0);
  testing::ExpectError([] { LandmarkError(std::vector<float>(136), std::vector<float>(136)); }, "in one point");
}

TEST(ShapeMeasure, OfSimilarShapesIsZero) {
  const faces::FaceTemplate face_template = testing::SyntheticFace();
  const ShapeMeasure measure(face_template);
  geometry::Similarity similarity{1.3, Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()).toRotationMatrix(), {1, 2, 3}};
  EXPECT_LT(measure.SimilarityErrorMm(similarity.Apply(face_template.neutral), face_template.neutral), 1e-9);
}

TEST(ShapeMeasure, IsInMillimetresOfAFaceOf200) {
  // Noise of one axis that no similarity explains: its mean length in millimetres.
  const faces::FaceTemplate face_template = testing::SyntheticFace();
  const ShapeMeasure measure(face_template);
  geometry::Points moved = face_template.neutral;
  Rng rng(2);
  for (Eigen::Index v = 0; v < moved.rows(); ++v) moved(v, 2) += rng.Uniform() < 0.5 ? 0.1 : -0.1;
  EXPECT_NEAR(measure.SimilarityErrorMm(moved, face_template.neutral), 0.1 * faces::MillimetresPerCm(face_template),
              0.1);
}

TEST(ShapeMeasure, GapsCloseAndOpen) {
  const faces::FaceModel source = testing::SyntheticModel();
  const ShapeMeasure measure(source.face_template);
  const auto at = [&](int shape) {
    Eigen::VectorXf weights = Eigen::VectorXf::Zero(source.expression_shapes.cols());
    if (shape >= 0) weights[shape] = 1;
    const Eigen::VectorXf offset = faces::ExpressionOffset(source, weights);
    return measure.GapsMm(source.face_template.neutral + geometry::PointsFrom({offset.data(), size_t(offset.size())}));
  };
  const auto still = at(-1), jaw = at(0), blink = at(3);
  EXPECT_GT(jaw[2], still[2] + 5);
  EXPECT_LT(blink[1], still[1] - 1);  // The left eye is the second.
  EXPECT_NEAR(blink[0], still[0], 0.5);
}

TEST(CompareGaps, CountsClosedEyesWinksAndMouths) {
  const OpeningErrors open = CompareGaps({9, 9, 1}, {8, 10, 3});
  EXPECT_FALSE(open.closed_eyes || open.wink);
  EXPECT_NEAR(open.mouth, 2, 1e-6);
  const OpeningErrors wink = CompareGaps({2, 9, 0}, {0, 10, 0});
  EXPECT_NEAR(*wink.closed_eyes, 2, 1e-6);
  EXPECT_NEAR(*wink.wink, 3, 1e-6);
  const OpeningErrors closed = CompareGaps({2, 4, 0}, {0, 1, 0});
  EXPECT_NEAR(*closed.closed_eyes, 2.5, 1e-6);
  EXPECT_FALSE(closed.wink);
}

TEST(MovedAngles, UndoThemselvesAndRollWithThePicture) {
  const std::vector<float> angles = {0.1F, -0.4F, 0.2F};
  const Eigen::Vector2d from(20, -35), to(-4, 12);
  const auto there = MovedAngles(angles, from, to, 0.3), back = MovedAngles(there, to, from, -0.3);
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], angles[k], 1e-6);
  EXPECT_NEAR(MovedAngles(angles, {0, 0}, {0, 0}, 0.3)[2], 0.2 - 0.3, 1e-6);
}

TEST(MovedAngles, AreThoseOfAFaceFittedInTheCrop) {
  // The mean face beside the middle; its crop in the middle, turned. The pose that explains the crop's landmarks best.
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const fitting::LandmarkModel landmarks_of(model);
  const FacePainter painter(model);
  std::vector<float> x(faces::kNumCoefficients);
  const std::array<float, 6> pose = {0.1F, 0.3F, -0.1F, 3, 2, -40};
  std::copy(pose.begin(), pose.end(), x.begin() + faces::kPoseSlot.first);
  const std::vector<float> landmarks = painter.Paint(x).landmarks;
  PictureMap turn;
  turn.linear << std::cos(0.2), -std::sin(0.2), std::sin(0.2), std::cos(0.2);
  const PictureMap map = Compose(turn, CropOfLandmarks(landmarks, 0.56));
  const std::vector<float> in_crop = MapLandmarks(landmarks, map);
  const fitting::PicturePoints points =
      Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>>(in_crop.data(), 68, 2).cast<double>();
  const auto fit = fitting::FitPortrait(landmarks_of, points, Eigen::VectorXd::Ones(68),
                                        {.freedom = fitting::PortraitFreedom::kPose});
  const auto moved = MovedAngles(pose, OffsetOf(landmarks, 224), OffsetOf(in_crop, 224), map.rotation());
  fitting::PortraitPose expected = fitting::PortraitPose::Zero();
  for (int k = 0; k < 3; ++k) expected[k] = moved[size_t(k)];
  EXPECT_LT(fitting::AngleBetween(fit.pose(), expected), 1.0);
}

TEST(FacePainter, PaintsTheFaceWhereTheCameraSeesIt) {
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const FacePainter painter(model);
  std::vector<float> x(faces::kNumCoefficients);
  x[size_t(faces::kPoseSlot.first + 5)] = -40;
  const FacePicture face = painter.Paint(x);
  const auto coverage = [&](double px, double py) { return face.colours[4 * (size_t(py) * 224 + size_t(px)) + 3]; };
  EXPECT_EQ(coverage(face.landmarks[2 * 30], face.landmarks[2 * 30 + 1]), 1);
  EXPECT_EQ(coverage(2, 2), 0);
  // Without light of its own the shade is 0.709 of the albedo.
  const size_t chin = size_t(face.landmarks[2 * 8 + 1] - 3) * 224 + size_t(face.landmarks[2 * 8]);
  EXPECT_NEAR(face.colours[4 * chin], 0.709 * 0.75, 0.02);
  testing::ExpectError([&] { painter.Paint(std::vector<float>(12)); }, "12 coefficients");
}

TEST(PhotometricError, IsTheSumOverColoursWhereTheFaceShows) {
  FacePicture face{std::vector<float>(size_t(4 * 224 * 224)), {}};
  render::Image crop(224, 224, 3, 51);
  std::vector<float> shown(224 * 224, 0);
  for (const size_t i : {10U, 11U, 12U}) {
    face.colours[4 * i] = 0.5F;
    face.colours[4 * i + 3] = i == 12 ? 0.6F : 1;
    shown[i] = i == 11 ? 0 : 1;
  }
  EXPECT_NEAR(PhotometricError(face, crop, shown), 0.3 + 0.2 + 0.2, 1e-6);  // Of pixel 10 alone.
  EXPECT_TRUE(std::isnan(PhotometricError(face, crop, std::vector<float>(224 * 224))));
}

TEST(OverlayFace, LaysTheFaceOverThePicture) {
  FacePicture face{std::vector<float>(size_t(4 * 224 * 224)), {}};
  face.colours[0] = 1, face.colours[3] = 1;
  const render::Image over = OverlayFace(render::Image(224, 224, 3, 100), face);
  EXPECT_EQ(over.at(0, 0, 0), 255);
  EXPECT_EQ(over.at(0, 0, 1), 0);
  EXPECT_EQ(over.at(0, 1, 1), 100);
  const render::Image dots = DotsOver(over, std::vector<float>{50, 60, NAN, 3}, {9, 8, 7});
  EXPECT_EQ(dots.at(60, 50, 1), 8);
  EXPECT_EQ(dots.at(70, 50, 1), 100);
}

}  // namespace
}  // namespace daumier::portrait
