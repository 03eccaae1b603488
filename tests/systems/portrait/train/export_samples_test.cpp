#include "systems/portrait/train/export_samples.h"

#include "core/config.h"
#include "core/files.h"
#include "datasets/read/portrait_database.h"
#include "systems/portrait/landmark_crop.h"
#include "systems/portrait/train/landmark_export.h"
#include "systems/portrait/train/portrait_export.h"
#include "systems/portrait/train/portrait_samples.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

/// The portrait that gives these numbers; -1 if none does.
int PortraitOf(const torch::Tensor& crop, const std::vector<std::vector<float>>& numbers) {
  for (size_t i = 0; i < numbers.size(); ++i) {
    const torch::Tensor other = torch::tensor(numbers[i]).view(crop.sizes());
    if (torch::equal(crop, other)) return int(i);
  }
  return -1;
}

TEST(ExportSamples, OfAPortraitNetworkAreItsCropsOfTheRunsPortraits) {
  const PortraitRunFolder run = ReadPortraitRunFolder(testing::SmallPortraitRun());
  const PortraitNetwork network(run.options.network, run.model.expression_weights);
  exporting::ExportedFunction function = PortraitFunction(network);
  EXPECT_EQ(function.inputs[0].sample_text, "random numbers");
  SamplePortraitCrops(run, function);
  EXPECT_EQ(function.inputs[0].sample_text, "crops of portraits");
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  std::vector<std::vector<float>> numbers;
  for (int i = 0; i < portraits.size(); ++i)
    numbers.push_back(NetworkPicture(WarpPicture(portraits.picture(i), PlainCrop(portraits, i, run.options.pictures)),
                                     run.options.network.resolution));
  Rng rng(2);
  const torch::Tensor crops = function.inputs[0].sample(12, rng);
  EXPECT_EQ(crops.sizes(), (std::vector<int64_t>{12, 3, 32, 32}));
  std::set<int> shown;
  for (int64_t b = 0; b < 12; ++b) shown.insert(PortraitOf(crops[b], numbers));
  EXPECT_FALSE(shown.contains(-1));
  EXPECT_GT(shown.size(), 3U);
}

TEST(ExportSamples, OfALandmarkNetworkShowTheBoxOfTheLandmarks) {
  LandmarkRunFolder run;
  run.directory = testing::SmallPortraitFolder() / "nowhere";
  run.network_options = {.resolution = 64, .width = 16, .point_width = 16};
  run.config = {{"data", {{"portraits", (testing::SmallPortraitFolder() / "portraits").string()}}}};
  run.manifest.details = {{"data", {{"portraits", DataHash(testing::SmallPortraitFolder() / "portraits")}}}};
  exporting::ExportedFunction function = MakeLandmarkFunction(ToJson(run.network_options)).function;
  SampleLandmarkCrops(run, function);
  const datasets::PortraitDatabase portraits(testing::SmallPortraitFolder() / "portraits");
  std::vector<std::vector<float>> numbers;
  for (int i = 0; i < portraits.size(); ++i)
    numbers.push_back(SampleCrop(PicturePyramid(portraits.picture(i)), FrameOfBox(BoxOf(portraits.landmarks(i)), 64)));
  Rng rng(2);
  const torch::Tensor crops = function.inputs[0].sample(5, rng);
  EXPECT_EQ(crops.sizes(), (std::vector<int64_t>{5, 3, 64, 64}));
  for (int64_t b = 0; b < 5; ++b) EXPECT_GE(PortraitOf(crops[b], numbers), 0);
}

TEST(ExportSamples, WithoutThePortraitsTheSamplesStayRandom) {
  LandmarkRunFolder run;
  run.directory = testing::SmallPortraitFolder() / "nowhere";
  run.network_options = {.resolution = 64, .width = 16, .point_width = 16};
  run.config = {{"data", {{"portraits", "/no/such/portraits"}}}};
  run.manifest.details = {{"data", {{"portraits", "abc"}}}};
  exporting::ExportedFunction function = MakeLandmarkFunction(ToJson(run.network_options)).function;
  SampleLandmarkCrops(run, function);
  EXPECT_EQ(function.inputs[0].sample_text, "random squares and noise");
  Rng rng(2);
  EXPECT_EQ(function.inputs[0].sample(2, rng).sizes(), (std::vector<int64_t>{2, 3, 64, 64}));
}

}  // namespace
}  // namespace daumier::portrait
