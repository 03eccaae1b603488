#include "fitting/code_directions.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::testing {
namespace {

/// Codes of N(0, I); "size" is 2 c_0 + noise, "open" whether c_1 + c_2 > 0, "none" constant.
fitting::LabelledCodes SomeLabelledCodes() {
  Rng rng(9);
  fitting::LabelledCodes faces;
  faces.codes.resize(1500, 4);
  faces.labels.resize(1500, 3);
  faces.names = {"size", "open", "none"};
  for (Eigen::Index i = 0; i < faces.codes.rows(); ++i) {
    for (double& number : faces.codes.row(i)) number = rng.Normal();
    faces.labels.row(i) << 2 * faces.codes(i, 0) + 0.2 * rng.Normal(),
        faces.codes(i, 1) + faces.codes(i, 2) > 0 ? 1 : 0, 3;
  }
  for (Eigen::Index i = 0; i < 100; ++i) faces.labels(i, 0) = std::nan("");
  return faces;
}

TEST(CodeDirections, AStepRaisesTheLabelByADeviation) {
  const fitting::CodeDirection direction = fitting::DirectionOf(SomeLabelledCodes(), "size");
  EXPECT_NEAR(direction.step[0], 1, 0.05);  // The label's deviation is 2, its slope 2.
  EXPECT_LT(direction.step.tail(3).norm(), 0.1);
  EXPECT_GT(direction.accuracy, 0.97);
}

TEST(CodeDirections, BinaryLabelsHaveTheDifferenceOfMeans) {
  const fitting::CodeDirection direction = fitting::DirectionOf(SomeLabelledCodes(), "open");
  const Eigen::VectorXd unit = direction.step.normalized();
  EXPECT_NEAR(unit[1], std::sqrt(0.5), 0.05);
  EXPECT_NEAR(unit[2], std::sqrt(0.5), 0.05);
  EXPECT_GT(direction.accuracy, 0.97);
  EXPECT_NEAR(double(direction.num_low), 600, 60);
}

/// Codes of unequal kinds: the means differ along c_0, of which c_1 hides a part; the plane between them is across both.
TEST(CodeDirections, ASupportVectorMachineFindsThePlaneThatMeansMiss) {
  Rng rng(5);
  fitting::LabelledCodes faces;
  faces.codes.resize(1500, 3);
  faces.labels.resize(1500, 1);
  faces.names = {"label"};
  for (Eigen::Index i = 0; i < faces.codes.rows(); ++i) {
    const double side = rng.Uniform(0, 1) < 0.5 ? 1 : -1, hidden = 2 * rng.Normal();
    faces.codes.row(i) << 0.5 * side + hidden, hidden + 0.1 * rng.Normal(), rng.Normal();
    faces.labels(i, 0) = side > 0 ? 1 : 0;
  }
  const fitting::CodeDirection means = fitting::DirectionOf(faces, "label"),
                               svm = fitting::DirectionOf(faces, "label", fitting::DirectionMethod::kSvm);
  EXPECT_LT(means.accuracy, 0.75);
  EXPECT_GT(svm.accuracy, 0.97);
  const Eigen::VectorXd unit = svm.step.normalized();
  EXPECT_NEAR(unit[0], std::sqrt(0.5), 0.05);
  EXPECT_NEAR(unit[1], -std::sqrt(0.5), 0.05);
  EXPECT_NEAR(fitting::AccuracyOn(faces, "label", svm).value(), svm.accuracy, 0.02);
}

TEST(CodeDirections, BothMethodsAgreeOnRoundCodes) {
  const fitting::LabelledCodes faces = SomeLabelledCodes();
  for (const char* label : {"size", "open"}) {
    const Eigen::VectorXd means = fitting::DirectionOf(faces, label).step,
                          svm = fitting::DirectionOf(faces, label, fitting::DirectionMethod::kSvm).step;
    EXPECT_LT((means - svm).norm(), 0.15 * means.norm()) << label;
  }
}

TEST(CodeDirections, AccuracyOfFacesOfOneSideIsAbsent) {
  fitting::LabelledCodes faces = SomeLabelledCodes();
  const fitting::CodeDirection direction = fitting::DirectionOf(faces, "open");
  EXPECT_GT(fitting::AccuracyOn(faces, "open", direction).value(), 0.97);
  EXPECT_FALSE(fitting::AccuracyOn(faces, "none", direction).has_value());
  faces.codes *= -1;  // The other side of the plane through about the origin.
  EXPECT_LT(fitting::AccuracyOn(faces, "open", direction).value(), 0.03);
}

TEST(CodeDirections, KeptLabelsDoNotChange) {
  const Eigen::Vector3d step(1, 1, 0), other(1, 0, 0);
  const Eigen::VectorXd kept = fitting::Keeping(step, {other});
  EXPECT_NEAR(kept.dot(other), 0, 1e-12);
  EXPECT_NEAR(kept.dot(step), step.squaredNorm(), 1e-12);  // As long along its own direction.
  EXPECT_EQ(fitting::Keeping(step, {}), step);
  ExpectError([&] { fitting::Keeping(other, {other}); }, "leave nothing");
}

TEST(CodeDirections, RefusesLabelsThatAreNotThere) {
  const fitting::LabelledCodes faces = SomeLabelledCodes();
  ExpectError([&] { fitting::DirectionOf(faces, "sise"); }, "did you mean 'size'");
  ExpectError([&] { fitting::DirectionOf(faces, "none"); }, "expected 4 or more");
}

}  // namespace
}  // namespace daumier::testing
