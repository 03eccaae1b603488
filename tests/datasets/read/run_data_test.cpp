#include "datasets/read/run_data.h"

#include "tests/systems/deform/train/run_fixture.h"
#include "tests/support/expect_error.h"

namespace daumier::datasets {
namespace {

class RunDataTest : public DeformRunFixture {
 protected:
  const std::filesystem::path run_ = *folder_ / "run";
  Manifest manifest_ = ReadManifest(run_, "run");
  Json config_ = LoadConfig(run_ / "resolved.toml");
};

TEST_F(RunDataTest, RefusesFacesThatTheRunWasNotTrainedOn) {
  CheckSameData(run_, manifest_, config_, "faces");
  testing::BuildSyntheticFaces(*folder_ / "others", 2);
  config_["data"]["faces"] = (*folder_ / "others").string();
  testing::ExpectError([&] { CheckSameData(run_, manifest_, config_, "faces"); }, "holds other faces than");
}

TEST_F(RunDataTest, SplitIsThatOfTheTrainingOrAnError) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  const Split split = SplitOfRun(run_, manifest_, config_, faces);
  EXPECT_EQ(SplitToJson(faces, split), manifest_.details.at("split"));
  config_["split"]["test"] = 0.5;
  testing::ExpectError([&] { SplitOfRun(run_, manifest_, config_, faces); }, "was split otherwise");
}

TEST_F(RunDataTest, ASplitHasThreeSides) {
  const Split split{{1}, {2}, {3}};
  EXPECT_EQ(SideOf(split, "train"), std::vector<int>{1});
  EXPECT_EQ(SideOf(split, "validation"), std::vector<int>{2});
  EXPECT_EQ(SideOf(split, "test"), std::vector<int>{3});
  EXPECT_THROW(SideOf(split, "left"), UsageError);
}

}  // namespace
}  // namespace daumier::datasets
