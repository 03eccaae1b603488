#include "systems/deform/train/comparison.h"

#include "tests/systems/deform/train/run_fixture.h"
#include "tests/support/expect_error.h"

namespace daumier::deform {
namespace {

class DeformComparisonTest : public DeformRunFixture {};

TEST_F(DeformComparisonTest, HasARowAFaceAndAColumnARun) {
  const std::filesystem::path run = *folder_ / "run";
  const render::Image one = DeformComparison({{"a", run}}, {{"first", 0}}),
                      two = DeformComparison({{"a", run}, {"b", run}}, {{"first", 0}}),
                      tall = DeformComparison({{"a", run}}, {{"first", 0}, {"next", 1}});
  EXPECT_GT(two.width, one.width);
  EXPECT_EQ(two.height, one.height);
  EXPECT_GT(tall.height, one.height);
}

TEST_F(DeformComparisonTest, RefusesNothingAndRunsOfOtherFaces) {
  testing::ExpectError([] { DeformComparison({}, {{"first", 0}}); }, "no run to compare");
  WriteRun(*folder_ / "other");
  Manifest manifest = ReadManifest(*folder_ / "other", "run");
  manifest.details["data"]["faces"] = "somebody else's";
  WriteManifest(*folder_ / "other", manifest);
  testing::ExpectError(
      [&] {
        DeformComparison({{"a", *folder_ / "run"}, {"b", *folder_ / "other"}}, {{"first", 0}});
      },
      "was trained on other faces than");
}

}  // namespace
}  // namespace daumier::deform
