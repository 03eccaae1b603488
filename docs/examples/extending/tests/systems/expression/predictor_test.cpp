#include "systems/expression/predictor.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::expression {
namespace {

/// Scores of "neutral" and "smile": 0 and the logarithm of the first coordinate.
class LogarithmNetwork : public runtime::NetworkRunner {
 public:
  NamedArrays Run(const NamedArrays& inputs) const override {
    return {{"scores", FloatArray({1, 2}, {0, std::log(inputs.at("vertices").values[0])})}};
  }
};

systems::FaceResult ResultOf(int num_vertices) {
  const ExpressionPredictor predictor({"neutral", "smile"}, 2, std::make_unique<LogarithmNetwork>());
  geometry::PolygonMesh mesh;
  mesh.vertices = geometry::Points::Constant(num_vertices, 3, 3);
  const std::vector<systems::Input> inputs = {mesh};
  return predictor.Predict(inputs).front();
}

TEST(ExpressionPredictor, ProbabilitiesWorkedOutByHand) {
  const systems::FaceResult result = ResultOf(2);
  EXPECT_EQ(result.record.at("expression"), "smile");
  EXPECT_NEAR(result.record.at("probabilities").at("neutral").get<double>(), 0.25, 1e-6);
  EXPECT_NEAR(result.record.at("probabilities").at("smile").get<double>(), 0.75, 1e-6);
  EXPECT_EQ(result.files.front().suffix, ".json");
}

TEST(ExpressionPredictor, RefusesOtherTopologiesAndOtherInputs) {
  testing::ExpectError([] { ResultOf(3); }, "the mesh has 3 vertices (expected 2, the run's topology)");
  const ExpressionPredictor predictor({"neutral", "smile"}, 2, std::make_unique<LogarithmNetwork>());
  const std::vector<systems::Input> drawing = {render::Drawing()};
  testing::ExpectError([&] { predictor.Predict(drawing); }, "this is no mesh");
}

}  // namespace
}  // namespace daumier::expression
