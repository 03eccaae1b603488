#include "eval/sketch_comparison.h"

#include "tests/eval/sketch_run_fixture.h"
#include "tests/support/expect_error.h"

namespace daumier::eval {
namespace {

using SketchComparisonTest = SketchRunFixture;

TEST_F(SketchComparisonTest, ShowsARunAColumnAndAFaceARow) {
  const std::vector<ComparedSketch> faces = {{"median", 3}, {"first", 0}};
  const ComparedRun run{"network", *folder_ / "run"};
  const render::Image one = SketchComparison({run}, faces), two = SketchComparison({run, run}, faces);
  EXPECT_EQ(one.height, two.height);
  EXPECT_GT(two.width, one.width);
  EXPECT_EQ(SketchComparison({run}, faces), one);
}

TEST_F(SketchComparisonTest, AugmentedSketchesAreOthers) {
  const std::vector<ComparedSketch> faces = {{"first", 0}};
  EXPECT_NE(SketchComparison({{"network", *folder_ / "run", {.strength = 1.5}}}, faces),
            SketchComparison({{"network", *folder_ / "run"}}, faces));
}

TEST_F(SketchComparisonTest, NetworksThatReadShapeGetItGivenOrRecovered) {
  WriteRun(*folder_ / "shape",
           {.shape_input = "late", .resolution = 32, .width = 8, .hidden = 16, .branch = 16, .shape_hidden = 8});
  const std::vector<ComparedSketch> faces = {{"first", 0}};
  EXPECT_NE(SketchComparison({{"network", *folder_ / "shape"}}, faces),
            SketchComparison({{"network", *folder_ / "shape", {.recover_with = (*folder_ / "run").string()}}}, faces));
}

TEST_F(SketchComparisonTest, RefusesNothingAndWhatIsNoRun) {
  testing::ExpectError([] { SketchComparison({}, {{"first", 0}}); }, "needs a run");
  testing::ExpectError([&] { SketchComparison({{"network", *folder_ / "absent"}}, {{"first", 0}}); }, "absent");
}

TEST(ChooseFaces, TakesTheMedianTheWorstFivePercentAndTheFirst) {
  const std::vector<ComparedSketch> chosen = ChooseFaces({10, 11, 12, 13, 14}, {5, 1, 4, 2, 3});
  ASSERT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen[0].face, 14);
  EXPECT_EQ(chosen[1].face, 10);
  EXPECT_EQ(chosen[2].face, 10);
  EXPECT_EQ(ChooseFaces({7}, {1})[0].face, 7);
  testing::ExpectError([] { ChooseFaces({}, {}); }, "0 faces");
  testing::ExpectError([] { ChooseFaces({1, 2}, {1}); }, "2 faces have 1 errors");
}

}  // namespace
}  // namespace daumier::eval
