#include "systems/sketch/train/comparison.h"

#include "tests/systems/sketch/train/run_fixture.h"
#include "tests/support/expect_error.h"

namespace daumier::sketch {
namespace {

using SketchComparisonTest = SketchRunFixture;

TEST_F(SketchComparisonTest, ShowsARunAColumnAndAFaceARow) {
  const std::vector<reports::ChosenFace> faces = {{"median", 3}, {"first", 0}};
  const ComparedRun run{"network", *folder_ / "run"};
  const render::Image one = SketchComparison({run}, faces), two = SketchComparison({run, run}, faces);
  EXPECT_EQ(one.height, two.height);
  EXPECT_GT(two.width, one.width);
  EXPECT_EQ(SketchComparison({run}, faces), one);
}

TEST_F(SketchComparisonTest, AugmentedSketchesAreOthers) {
  const std::vector<reports::ChosenFace> faces = {{"first", 0}};
  EXPECT_NE(SketchComparison({{"network", *folder_ / "run", {.strength = 1.5}}}, faces),
            SketchComparison({{"network", *folder_ / "run"}}, faces));
}

TEST_F(SketchComparisonTest, NetworksThatReadShapeGetItGivenOrRecovered) {
  WriteRun(*folder_ / "shape",
           {.shape_input = "late", .resolution = 32, .width = 8, .hidden = 16, .branch = 16, .shape_hidden = 8});
  const std::vector<reports::ChosenFace> faces = {{"first", 0}};
  EXPECT_NE(SketchComparison({{"network", *folder_ / "shape"}}, faces),
            SketchComparison({{"network", *folder_ / "shape", {.recover_with = (*folder_ / "run").string()}}}, faces));
}

TEST_F(SketchComparisonTest, RefusesNothingAndWhatIsNoRun) {
  testing::ExpectError([] { SketchComparison({}, {{"first", 0}}); }, "needs a run");
  testing::ExpectError([&] { SketchComparison({{"network", *folder_ / "absent"}}, {{"first", 0}}); }, "absent");
}

}  // namespace
}  // namespace daumier::sketch
