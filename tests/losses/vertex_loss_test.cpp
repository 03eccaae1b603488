#include "losses/vertex_loss.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

namespace daumier::losses {
namespace {

/// A random bilinear face in float64: Ku = 4, Kv = 3, V = 9, B = 5.
struct Problem {
  torch::Tensor core, u, v, target, weights;
};

Problem MakeProblem(int64_t num_vertices = 9) {
  torch::manual_seed(3);
  const auto type = torch::kFloat64;
  return {torch::randn({12, 3 * num_vertices}, type), torch::randn({5, 4}, type), torch::randn({5, 3}, type),
          torch::randn({5, 3 * num_vertices}, type), torch::rand({num_vertices}, type)};
}

/// u (x) v.
torch::Tensor Products(const torch::Tensor& u, const torch::Tensor& v) {
  return (u.unsqueeze(2) * v.unsqueeze(1)).flatten(1);
}

double Value(const torch::Tensor& loss) {
  return loss.item<double>();
}

double Gram(const Problem& p) {
  const GramVertexLoss loss(p.core, p.weights);
  return Value(loss(Products(p.u, p.v), loss.Moments(p.target)));
}

double Direct(const Problem& p) {
  return Value(VertexLoss(p.core, Products(p.u, p.v), p.target, p.weights));
}

TEST(VertexLoss, OfTwoVerticesWorkedOutByHand) {
  // One identity and one expression weight: the face is u v = 6 times the core, (6 0 0) and (0 12 0). The target is
  // (6 0 1) and (3 12 4): squared distances 1 and 25, weights 2 and 0.5, so E = (2 * 1 + 0.5 * 25) / 2.
  const auto type = torch::kFloat64;
  const Problem p{torch::tensor({{1., 0., 0., 0., 2., 0.}}, type), torch::tensor({{2.}}, type),
                  torch::tensor({{3.}}, type), torch::tensor({{6., 0., 1., 3., 12., 4.}}, type),
                  torch::tensor({2., 0.5}, type)};
  EXPECT_DOUBLE_EQ(Direct(p), 7.25);
  EXPECT_NEAR(Gram(p), 7.25, 1e-12);
}

TEST(VertexLoss, CoreRowOfProductKLIsKTimesKvPlusL) {
  auto p = MakeProblem();
  torch::Tensor face = torch::zeros_like(p.target);
  for (int64_t k = 0; k < 4; ++k) {
    for (int64_t l = 0; l < 3; ++l)
      face += p.u.select(1, k).unsqueeze(1) * p.v.select(1, l).unsqueeze(1) * p.core[k * 3 + l];
  }
  p.target = face;
  EXPECT_NEAR(Direct(p), 0, 1e-24);
}

TEST(VertexLoss, BothFormsAgreeInFloat64) {
  const auto p = MakeProblem();
  EXPECT_NEAR(Gram(p), Direct(p), 1e-6 * Direct(p));
}

TEST(VertexLoss, BothFormsAgreeWhenTheModelCanMakeEveryFace) {
  const auto p = MakeProblem(3);  // 9 coordinates, 12 products: G is singular.
  EXPECT_NEAR(Gram(p), Direct(p), 1e-6 * Direct(p));
}

TEST(VertexLoss, GramFormIsTheExpandedSum) {
  const auto p = MakeProblem();
  const auto weights = p.weights.repeat_interleave(3);
  const auto q = Products(p.u, p.v);
  const auto gram = torch::mm(p.core * weights, p.core.t());
  const auto linear = torch::mm(p.target * weights, p.core.t());
  const auto constant = (p.target.square() * weights).sum(1);
  const auto sums = (torch::mm(q, gram) * q).sum(1) - 2 * (linear * q).sum(1) + constant;
  EXPECT_NEAR(Gram(p), Value(sums.mean()) / 9, 1e-9);
}

TEST(VertexLoss, GramFormKeepsSmallErrorsOfFarAwayHeadsInFloat32) {
  torch::manual_seed(4);
  const int64_t num_vertices = 500;
  Problem p = MakeProblem(num_vertices);
  p.core[0] += 100;  // The head is 100 cm away from the origin.
  p.u.select(1, 0).fill_(1);
  p.v.select(1, 0).fill_(1);
  p.target = torch::mm(Products(p.u, p.v), p.core) + 0.1 * torch::randn_like(p.target);
  const double exact = Direct(p);
  for (auto* tensor : {&p.core, &p.u, &p.v, &p.target, &p.weights}) *tensor = tensor->to(torch::kFloat32);
  EXPECT_NEAR(Gram(p), exact, 1e-3 * exact);
}

TEST(VertexLoss, GradientsEqualCentralDifferences) {
  const auto p = MakeProblem();
  const GramVertexLoss gram(p.core, p.weights);
  const auto moments = gram.Moments(p.target);
  using testing::MaxGradientError;
  EXPECT_LT(
      MaxGradientError([&](const auto& u) { return VertexLoss(p.core, Products(u, p.v), p.target, p.weights); }, p.u),
      1e-7);
  EXPECT_LT(
      MaxGradientError([&](const auto& v) { return VertexLoss(p.core, Products(p.u, v), p.target, p.weights); }, p.v),
      1e-7);
  EXPECT_LT(MaxGradientError([&](const auto& u) { return gram(Products(u, p.v), moments); }, p.u), 1e-7);
  EXPECT_LT(MaxGradientError([&](const auto& v) { return gram(Products(p.u, v), moments); }, p.v), 1e-7);
}

TEST(VertexLoss, IsZeroIffFacesAgreeWhereWeightsArePositive) {
  auto p = MakeProblem();
  p.weights[2] = 0;
  p.target = torch::mm(Products(p.u, p.v), p.core);
  p.target.slice(1, 6, 9) += 5;  // All of vertex 2, which has no weight.
  EXPECT_EQ(Direct(p), 0);
  EXPECT_NEAR(Gram(p), 0, 1e-20);
  p.target[4][0] += 1e-3;
  EXPECT_NEAR(Direct(p), 1e-6 * p.weights[0].item<double>() / (9 * 5), 1e-12);
  EXPECT_NEAR(Gram(p), Direct(p), 1e-12);
}

TEST(VertexLoss, RefusesShapesThatDisagree) {
  const auto p = MakeProblem();
  using testing::ExpectError;
  const auto q = Products(p.u, p.v);
  ExpectError([&] { VertexLoss(p.core, q.slice(1, 0, 8), p.target, p.weights); },
              "q has shape (5, 8), expected (*, 12)");
  ExpectError([&] { VertexLoss(p.core, q, p.target.slice(1, 3), p.weights); }, "target has shape (5, 24)");
  ExpectError([&] { VertexLoss(p.core, q, p.target, p.weights.slice(0, 1)); }, "weights has shape (8)");
  ExpectError([&] { GramVertexLoss(p.core.slice(1, 1), p.weights); }, "core has 26 columns");
  const GramVertexLoss gram(p.core, p.weights);
  ExpectError([&] { gram.Moments(p.target.slice(1, 3)); }, "target has shape (5, 24)");
  ExpectError([&] { gram(q.slice(0, 1), gram.Moments(p.target)); }, "moments.linear has shape");
}

}  // namespace
}  // namespace daumier::losses
