#include "systems/sketch/parser_predictor.h"

#include "core/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_parser_network.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

ParserPredictor IdealParserPredictor() {
  return ParserPredictor(
      {ParserNetworkOptions(), std::make_shared<testing::IdealParserNetwork>(ParserNetworkOptions())});
}

render::Drawing Square() {
  return {300, 300, {{0, {{100, 100}, {200, 100}, {200, 200}, {100, 200}, {100, 100}}}}};
}

TEST(ParserPredictor, ResultsHoldPointsStatesAndAPicture) {
  const std::vector<systems::Input> inputs = {Square()};
  const auto results = IdealParserPredictor().Predict(inputs);
  ASSERT_EQ(results.size(), 1u);
  const systems::FaceResult& result = results[0];
  EXPECT_EQ(result.face_template, nullptr);
  EXPECT_NEAR(result.record["points"]["chin"]["at"][0], 150.0, 1.5);
  EXPECT_NEAR(result.record["points"]["chin"]["at"][1], 200.0, 1.5);
  EXPECT_GT(result.record["mouth"]["closed"], 0.99);
  EXPECT_GT(result.record["view"]["front"], 0.99);
  ASSERT_EQ(result.pictures.size(), 1u);
  ASSERT_EQ(result.files.size(), 1u);
  EXPECT_EQ(Json::parse(result.files[0].text), result.record);
}

TEST(ParserPredictor, AMeshIsRefused) {
  const std::vector<systems::Input> inputs = {geometry::PolygonMesh{}};
  testing::ExpectError([&] { IdealParserPredictor().Predict(inputs); }, "a mesh is no input");
}

}  // namespace
}  // namespace daumier::sketch
