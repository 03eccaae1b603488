#include "models/siren_field.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::models {
namespace {

const runtime::SirenLayout kSmall{.width = 32, .hidden_layers = 2};

struct Problem {
  torch::Tensor parameters, points, slope;
};

Problem SomeProblem(int64_t num_sirens, bool own_points) {
  torch::manual_seed(7);
  const int64_t num_points = 307;
  return {torch::randn({num_sirens, kSmall.num_parameters()}) * 0.04,
          own_points ? torch::rand({num_sirens, num_points, 3}) * 2 - 1 : torch::rand({num_points, 3}) * 2 - 1,
          torch::randn({num_sirens, num_points, 3})};
}

TEST(SirenField, KernelAndOperatorsAgreeInValueAndGradient) {
  for (const int64_t num_sirens : {1, 5}) {
    for (const bool own_points : {false, true}) {
      const Problem p = SomeProblem(num_sirens, own_points);
      const torch::Tensor fast = p.parameters.clone().requires_grad_(), plain = p.parameters.clone().requires_grad_();
      const torch::Tensor by_kernel = SirenField(kSmall, fast, p.points),
                          by_operators = SirenFieldByOperations(kSmall, plain, p.points);
      EXPECT_LT((by_kernel - by_operators).abs().max().item<double>(), 2e-5);
      (by_kernel * p.slope).sum().backward();
      (by_operators * p.slope).sum().backward();
      const double size = plain.grad().abs().max().item<double>();
      EXPECT_GT(size, 1);
      EXPECT_LT((fast.grad() - plain.grad()).abs().max().item<double>(), 1e-4 * size);
    }
  }
}

TEST(SirenField, GradientOfOperatorsEqualsCentralDifferences) {
  Problem p = SomeProblem(2, true);
  for (torch::Tensor* tensor : {&p.parameters, &p.points, &p.slope}) *tensor = tensor->to(torch::kFloat64);
  p.parameters.requires_grad_();
  (SirenFieldByOperations(kSmall, p.parameters, p.points) * p.slope).sum().backward();
  const torch::Tensor gradient = p.parameters.grad().clone();
  const at::NoGradGuard no_grad;
  const double step = 1e-6;
  for (int64_t i = 0; i < gradient.size(1); i += 97) {
    const auto moved = [&](double by) {
      torch::Tensor parameters = p.parameters.clone();
      parameters[1][i] += by;
      return (SirenFieldByOperations(kSmall, parameters, p.points) * p.slope).sum().item<double>();
    };
    const double expected = (moved(step) - moved(-step)) / (2 * step);
    EXPECT_NEAR(gradient[1][i].item<double>(), expected, 1e-5 * (1 + std::abs(expected)));
  }
}

TEST(SirenField, HasNoGradientByItsPoints) {
  Problem p = SomeProblem(1, false);
  p.points.requires_grad_();
  testing::ExpectError([&] { SirenField(kSmall, p.parameters, p.points); }, "no gradient by its points");
}

TEST(SirenField, RefusesShapesThatDisagree) {
  const Problem p = SomeProblem(2, true);
  testing::ExpectError([&] { SirenField(kSmall, p.parameters.slice(1, 1), p.points); }, "parameters has shape");
  testing::ExpectError([&] { SirenField(kSmall, p.parameters, p.points.slice(0, 1)); }, "points has shape");
  testing::ExpectError([&] { SirenField(kSmall, p.parameters, p.points[0].slice(1, 1)); }, "points has shape");
}

}  // namespace
}  // namespace daumier::models
