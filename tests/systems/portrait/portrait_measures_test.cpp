#include "systems/portrait/portrait_measures.h"

#include "core/random.h"
#include "geometry/alignment.h"
#include "geometry/coordinates.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <Eigen/Geometry>
#include <cmath>

namespace daumier::portrait {
namespace {

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

}  // namespace
}  // namespace daumier::portrait
