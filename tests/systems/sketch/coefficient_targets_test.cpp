#include "systems/sketch/coefficient_targets.h"

#include "datasets/build/interpolation.h"
#include "datasets/read/training_fit.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

/// Six synthetic persons in two families, twelve faces between them, and a model of all.
class CoefficientTargetsTest : public ::testing::Test {
 protected:
  CoefficientTargetsTest() : faces_(Build()) {
    for (int face = 0; face < faces_.num_faces(); ++face) split_.train.push_back(face);
    fitted_ = datasets::FitOnTraining(faces_, split_, {.num_identity = 6, .num_expression = 4});
  }

  std::filesystem::path Build() const {
    datasets::FacesOptions options = testing::SyntheticFacesOptions(6);
    options.num_interpolated = 12;
    options.family_size = 3;
    datasets::BuildFaces(testing::SyntheticModel(), options, folder_ / "faces");
    return folder_ / "faces";
  }

  Eigen::VectorXf Reconstruct(int face, const CoefficientTargets& targets) const {
    const faces::BilinearProjection target = targets.Of(face);
    return faces::Reconstruct(fitted_.model, target.u, target.v);
  }

  testing::TempDir folder_;
  faces::FaceDatabase faces_;
  datasets::Split split_;
  datasets::FittedBilinear fitted_;
};

TEST_F(CoefficientTargetsTest, FacesOfTheGridHaveTheFactorsOfTheFit) {
  const CoefficientTargets targets(faces_, fitted_.identities, fitted_.model);
  const faces::BilinearProjection target = targets.Of(faces_.index({.person = 2, .level = 1, .expression = 3}));
  EXPECT_EQ(target.u, fitted_.model.identity_factors.row(2 * 2 + 1).transpose());
  EXPECT_EQ(target.v, fitted_.model.expression_factors.row(3).transpose());
}

TEST_F(CoefficientTargetsTest, InterpolatedFacesAreTheMixOfTheFourFacesThatTheModelMakesOfTheirParents) {
  const CoefficientTargets targets(faces_, fitted_.identities, fitted_.model);
  for (int face = faces_.num_grid_faces(); face < faces_.num_faces(); ++face) {
    const auto [a, b, s, t] = datasets::ReadInterpolation(faces_, face);
    const auto of = [&](faces::FaceId id, int expression) {
      id.expression = expression;
      return Reconstruct(faces_.index(id), targets);
    };
    const Eigen::VectorXf expected = (1 - s) * ((1 - t) * of(a, a.expression) + t * of(a, b.expression)) +
                                     s * ((1 - t) * of(b, a.expression) + t * of(b, b.expression));
    EXPECT_LT((Reconstruct(face, targets) - expected).cwiseAbs().maxCoeff(), 1e-4f * expected.cwiseAbs().maxCoeff());
  }
}

TEST_F(CoefficientTargetsTest, FacesOfParentsThatWereNotFittedAreProjected) {
  // Without the first family: its identities are 0 to 5.
  const std::vector<int> second(fitted_.identities.begin() + 6, fitted_.identities.end());
  faces::BilinearModel model = fitted_.model;
  model.identity_factors = Eigen::MatrixXf(fitted_.model.identity_factors.bottomRows(6));
  const CoefficientTargets targets(faces_, second, model);
  const faces::BilinearProjector projector(model);
  int projected = 0;
  for (int face = faces_.num_grid_faces(); face < faces_.num_faces(); ++face) {
    const faces::BilinearProjection target = targets.Of(face), nearest = projector.Project(faces_.vertices(face));
    if (faces_.persons(face).front() >= 3) {
      EXPECT_NE(target.u, nearest.u);
      continue;
    }
    EXPECT_EQ(target.u, nearest.u);
    EXPECT_EQ(target.v, nearest.v);
    ++projected;
  }
  EXPECT_GT(projected, 0);
  EXPECT_LT(projected, 12);
}

TEST_F(CoefficientTargetsTest, RefusesAFaceOfTheGridThatWasNotFitted) {
  const CoefficientTargets targets(faces_, {fitted_.identities.begin() + 1, fitted_.identities.end()}, fitted_.model);
  testing::ExpectError([&] { targets.Of(0); }, "was not fitted");
}

}  // namespace
}  // namespace daumier::sketch
