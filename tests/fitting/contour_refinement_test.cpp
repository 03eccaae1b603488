#include "fitting/contour_refinement.h"

#include "tests/fitting/projected_face.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

class ContourRefinerTest : public ::testing::Test {
 protected:
  static Eigen::VectorXf AsVector(const PredictedFace& face) {
    return Eigen::Map<const Eigen::VectorXf>(face.vertices.data(), Eigen::Index(face.vertices.size()));
  }
  /// A prediction near identity 3, expression 2.
  Eigen::VectorXf u() const {
    return 0.8f * projected_.model.identity_factors.row(3) + 0.2f * projected_.model.identity_factors.row(7);
  }
  Eigen::VectorXf v() const { return projected_.model.expression_factors.row(2); }
  Eigen::VectorXf Predicted() const { return faces::Reconstruct(projected_.model, u(), v()); }
  PredictedFace Predict(const Eigen::VectorXf& face) const {
    return {u(), v(), {face.data(), face.data() + face.size()}};
  }
  std::vector<render::Stroke> TrueStrokes() const {
    return CurveStrokes(projected_.curves.offsets, projected_.Points(projected_.Face(3, 2)));
  }

  ProjectedFace projected_;
};

TEST_F(ContourRefinerTest, StrokesOfAFacePullANearFaceTowardsIt) {
  const ContourRefiner refiner(projected_.model, projected_.curves, {.trust = 1, .snapping = {.snaps = 4}});
  const PredictedFace refined = refiner.Refine(Predict(Predicted()), TrueStrokes());
  const Eigen::VectorXf truth = projected_.Face(3, 2);
  EXPECT_LT(MeanDistance(AsVector(refined), truth), 0.6 * MeanDistance(Predicted(), truth));
  EXPECT_LT((faces::Reconstruct(projected_.model, refined.u, refined.v) - AsVector(refined)).cwiseAbs().maxCoeff(),
            1e-4);
}

TEST_F(ContourRefinerTest, TheMoreThePredictionIsTrustedTheLessItMoves) {
  double last = 0;
  for (const double trust : {0.01, 0.1, 1.0}) {
    const ContourRefiner refiner(projected_.model, projected_.curves, {.trust = trust});
    const double moved = MeanDistance(AsVector(refiner.Refine(Predict(Predicted()), TrueStrokes())), Predicted());
    EXPECT_GT(moved, last) << trust;
    last = moved;
  }
}

TEST_F(ContourRefinerTest, WithoutAStrokeWithinReachThePredictionComesBack) {
  const ContourRefiner refiner(projected_.model, projected_.curves);
  const Eigen::VectorXf predicted = Predicted();
  for (const auto& strokes : std::vector<std::vector<render::Stroke>>{{}, {{0, {{2, 2}, {250, 2}}}}}) {
    const PredictedFace refined = refiner.Refine(Predict(predicted), strokes);
    EXPECT_EQ(refined.u, u());
    EXPECT_EQ(refined.v, v());
    EXPECT_EQ(AsVector(refined), predicted);
  }
}

TEST_F(ContourRefinerTest, AResidualStays) {
  // The network's face is shifted by 2 cm from that of its u and v, and so are the strokes: nothing else changes.
  const ContourRefiner refiner(projected_.model, projected_.curves);
  const PredictedFace plain = refiner.Refine(Predict(Predicted()), TrueStrokes());
  const auto shifted = [](Eigen::VectorXf face) {
    for (Eigen::Index i = 0; i < face.size(); i += 3) face[i] += 2;
    return face;
  };
  const auto strokes = CurveStrokes(projected_.curves.offsets, projected_.Points(shifted(projected_.Face(3, 2))));
  const PredictedFace moved = refiner.Refine(Predict(shifted(Predicted())), strokes);
  EXPECT_LT((moved.u - plain.u).norm(), 1e-3 * plain.u.norm());
  EXPECT_LT(MeanDistance(AsVector(moved), shifted(AsVector(plain))), 1e-3);
}

TEST_F(ContourRefinerTest, GivesTheSameResultAgain) {
  const ContourRefiner refiner(projected_.model, projected_.curves);
  const PredictedFace once = refiner.Refine(Predict(Predicted()), TrueStrokes());
  EXPECT_EQ(once.vertices, refiner.Refine(Predict(Predicted()), TrueStrokes()).vertices);
}

TEST_F(ContourRefinerTest, RefusesAFaceOfAnotherSize) {
  const ContourRefiner refiner(projected_.model, projected_.curves);
  PredictedFace face = Predict(Predicted());
  face.vertices.resize(9);
  testing::ExpectError([&] { refiner.Refine(face, {}); }, "a face of 9 coordinates");
  face = Predict(Predicted());
  face.u = face.u.head(2).eval();
  testing::ExpectError([&] { refiner.Refine(face, {}); }, "u and v have 2");
}

TEST(ContourRefinementOptions, AreParsed) {
  const auto options = ParseOptions<ContourRefinementOptions>(Json{{"trust", 0.25}, {"snapping", {{"snaps", 1}}}});
  EXPECT_EQ(options.trust, 0.25);
  EXPECT_EQ(options.snapping.snaps, 1);
}

}  // namespace
}  // namespace daumier::fitting
