#include "systems/sketch/gesture_predictor.h"

#include "tests/support/expect_error.h"
#include "tests/support/gesture_runs.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

TEST(GesturePredictor, RecognisesEachStrokeOfADrawing) {
  const GesturePredictor predictor(
      GestureRecogniser({{}, {.threshold = 0.5}}, std::make_shared<testing::HalvesNetwork>()));
  render::Drawing drawing{.width = 20, .height = 20};
  drawing.strokes = {{0, {{0, 5}, {10, 5}, {8, 3}, {10, 5}, {8, 7}}}, {0, {{3, 3}}}, {0, {{0, 0}, {10, 0}}}};
  const auto results = predictor.Predict(std::vector<systems::Input>{drawing});
  ASSERT_EQ(results.size(), 1u);
  const Json& strokes = results[0].record.at("strokes");
  ASSERT_EQ(strokes.size(), 3u);
  EXPECT_EQ(strokes[0].at("gesture"), "right_arrow");
  EXPECT_TRUE(strokes[1].is_null()) << "a point";
  EXPECT_EQ(strokes[2].at("gesture"), "none");
  EXPECT_EQ(results[0].files.at(0).suffix, ".json");
  ASSERT_EQ(results[0].pictures.size(), 2u);
  EXPECT_EQ(results[0].pictures[1].caption.substr(0, 7), "2: none");
  drawing.strokes = {{0, {{3, 3}}}};
  EXPECT_EQ(predictor.Predict(std::vector<systems::Input>{drawing})[0].pictures.size(), 1u) << "a sheet needs one";
  testing::ExpectError([&] { predictor.Predict(std::vector<systems::Input>{geometry::PolygonMesh{}}); }, "a mesh");
}

}  // namespace
}  // namespace daumier::sketch
