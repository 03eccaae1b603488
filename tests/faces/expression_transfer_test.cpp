#include "faces/expression_transfer.h"

#include "faces/source.h"
#include "geometry/flips.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

double LargestError(const FaceModel& model, const Eigen::MatrixXf& offsets) {
  double largest = 0;
  for (size_t e = 0; e < model.expressions.size(); ++e) {
    const Eigen::VectorXf linear = ExpressionOffset(model, model.expressions[e].weights);
    largest = std::max<double>(largest, (offsets.col(Eigen::Index(e)) - linear).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(ExpressionTransfer, OnTheTemplateItIsTheLinearExpression) {
  const FaceModel model = testing::SyntheticModel();
  const ExpressionTransfer transfer(model, model.expressions);
  EXPECT_LT(LargestError(model, transfer.Offsets(model.face_template.neutral)), 2e-3) << "cm";
}

TEST(ExpressionTransfer, NeutralMovesNothingAndWhatIsStillStays) {
  const FaceModel model = testing::SyntheticModel();
  const geometry::Points face = 1.3 * model.face_template.neutral;
  const Eigen::MatrixXf offsets = ExpressionTransfer(model, model.expressions).Offsets(face);
  EXPECT_EQ(offsets.col(0).cwiseAbs().maxCoeff(), 0);
  int num_still = 0;
  for (int v = 0; v < face.rows(); ++v) {
    double farthest = 0;
    for (const Expression& expression : model.expressions) {
      farthest = std::max<double>(farthest, ExpressionOffset(model, expression.weights).segment<3>(3 * v).norm());
    }
    if (farthest > 1e-3) continue;
    ++num_still;
    EXPECT_EQ(offsets.middleRows(3 * v, 3).cwiseAbs().maxCoeff(), 0);
  }
  EXPECT_GT(num_still, 0);
}

TEST(ExpressionTransfer, ALargerFaceMovesAsMuchMore) {
  const FaceModel model = testing::SyntheticModel();
  const ExpressionTransfer transfer(model, model.expressions);
  const Eigen::MatrixXf plain = transfer.Offsets(model.face_template.neutral);
  const Eigen::MatrixXf twice = transfer.Offsets(2 * model.face_template.neutral);
  EXPECT_LT((twice - 2 * plain).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(ExpressionTransfer, ModesThatMoveEveryVertexAreAddedAsTheyAre) {
  FaceModel model = testing::SyntheticModel();
  model.expression_shapes.array() += 0.01f;
  const geometry::Points larger = 1.5 * model.face_template.neutral;
  const Eigen::MatrixXf offsets =
      ExpressionTransfer(model, {model.expressions[1], model.expressions[2]}).Offsets(larger);
  EXPECT_EQ(offsets.col(0), ExpressionOffset(model, model.expressions[1].weights));
  EXPECT_EQ(offsets.col(1), ExpressionOffset(model, model.expressions[2].weights));
}

TEST(ExpressionTransfer, NeutralAloneMovesNothing) {
  const FaceModel model = testing::SyntheticModel();
  EXPECT_TRUE(ExpressionTransfer(model, {model.expressions[0]}).Offsets(model.face_template.neutral).isZero());
}

TEST(ExpressionTransfer, OnlyWhatIsWantedIsMade) {
  FaceModel model = testing::SyntheticModel();
  const geometry::Points face = 1.1 * model.face_template.neutral;
  const auto expect = [&](const ExpressionTransfer& transfer) {
    const Eigen::MatrixXf all = transfer.Offsets(face);
    std::vector<bool> wanted(size_t(transfer.num_expressions()), false);
    wanted[1] = true;
    const Eigen::MatrixXf one = transfer.Offsets(face, wanted);
    EXPECT_EQ(one.col(1), all.col(1));
    for (Eigen::Index e = 0; e < one.cols(); ++e) {
      if (e != 1) {
        EXPECT_TRUE(one.col(e).isZero(0)) << e;
      }
    }
  };
  expect(ExpressionTransfer(model, model.expressions));
  model.expression_shapes.array() += 0.01f;
  expect(ExpressionTransfer(model, {model.expressions[1], model.expressions[2]}));
  const ExpressionTransfer transfer(model, model.expressions);
  testing::ExpectError([&] { transfer.Offsets(face, std::vector<bool>(99)); }, "99 of ");
}

TEST(ExpressionTransfer, ThreadsDoNotMatter) {
  const FaceModel model = testing::SyntheticModel();
  const ExpressionTransfer transfer(model, model.expressions);
  EXPECT_EQ(transfer.Offsets(model.face_template.neutral, 1), transfer.Offsets(model.face_template.neutral, 8));
}

TEST(ExpressionTransfer, RefusesAFaceOfAnotherTopology) {
  const FaceModel model = testing::SyntheticModel();
  const ExpressionTransfer transfer(model, model.expressions);
  testing::ExpectError([&] { transfer.Offsets(model.face_template.neutral.topRows(5)); }, "the face has 5 vertices");
}

TEST(ExpressionTransfer, IctExpressionsComeBackOnTheirOwnTemplate) {
  const auto data = testing::SharedData();
  if (!data || !std::filesystem::exists(*data / "ict-facekit.tar.xz"))
    GTEST_SKIP() << "no ict-facekit.tar.xz next to the checkout";
  const FaceModel model = LoadFaceModel({.name = "ict", .path = (*data / "ict-facekit.tar.xz").string()});
  const Eigen::MatrixXf offsets = ExpressionTransfer(model, model.expressions).Offsets(model.face_template.neutral, 8);
  EXPECT_LT(LargestError(model, offsets), 2e-3) << "cm";
}

TEST(ExpressionTransfer, AMixOnATargetIsTheSumOfItsOffsets) {
  const FaceModel model = testing::SyntheticModel();
  const ExpressionTransfer transfer(model, model.expressions);
  const geometry::Points face = 1.1 * model.face_template.neutral;
  const Eigen::MatrixXf offsets = transfer.Offsets(face);
  const ExpressionTransfer::Target target = transfer.On(face);
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(transfer.num_expressions());
  EXPECT_EQ(target.Face(weights), face);
  weights[1] = 0.7f, weights[3] = 0.4f, weights[5] = 1;
  const Eigen::VectorXf sum = offsets * weights;
  const geometry::Points mixed = target.Face(weights);
  for (Eigen::Index k = 0; k < face.size(); ++k) EXPECT_NEAR(mixed.data()[k], face.data()[k] + sum[k], 1e-5);
  testing::ExpectError([&] { target.Face(Eigen::VectorXf::Zero(2)); }, "2 weights of 8 expressions");
}

}  // namespace
}  // namespace daumier::faces
