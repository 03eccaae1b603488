#include "systems/deform/train/training.h"

#include "core/config.h"
#include "core/files.h"
#include "core/task.h"
#include "faces/face_database.h"
#include "systems/deform/options.h"
#include "core/manifest.h"
#include "systems/deform/train/run.h"
#include "tensor/tensor_file.h"
#include "tests/support/deform_networks.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_points.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

TrainingSummary RunDeform(const Json& config, const systems::RunPlace& place, const Task& task) {
  FolderCache databases;
  return TrainDeform(config, place, databases, task);
}

class DeformTrainingTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    testing::BuildSyntheticPoints(*folder_ / "faces", *folder_ / "points");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static Json Config(const std::string& kind) {
    return {{"system", "deform"},
            {"data", {{"faces", (*folder_ / "faces").string()}, {"points", (*folder_ / "points").string()}}},
            {"network", ToJson(testing::SmallDeformOptions(kind))},
            {"points", {{"num_points", 50}}},
            {"validation", {{"faces", 3}, {"newton_steps", 2}}},
            {"optimiser", {{"learning_rate", 3e-4}}},
            {"epochs", 4},
            {"batch", 8}};
  }
  fs::path Run(const std::string& name) const { return *folder_ / name; }

  static std::vector<double> TrainingErrors(const fs::path& run) {
    std::istringstream log(ReadFile(run / "metrics.jsonl"));
    std::vector<double> errors;
    for (std::string line; std::getline(log, line);) {
      const Json entry = Json::parse(line);
      if (entry.at("phase") == "train") errors.push_back(entry.at("training_error_mm").get<double>());
    }
    return errors;
  }

  static std::unique_ptr<testing::TempDir> folder_;
};

std::unique_ptr<testing::TempDir> DeformTrainingTest::folder_;

TEST_F(DeformTrainingTest, EveryKindLeavesARunThatIsReadBack) {
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    const TrainingSummary summary = RunDeform(Config(kind), {Run(kind), false}, {});
    const DeformRun run = LoadDeformRun(Run(kind));
    EXPECT_EQ(run.manifest.details.at("system"), "deform");
    EXPECT_EQ(run.manifest.counts.at("steps"), summary.steps);
    EXPECT_EQ(run.network->options().kind, kind);
    EXPECT_EQ(run.codes.size(0), run.manifest.counts.at("training_faces"));
    EXPECT_EQ(run.data_weight, 3e3);
    EXPECT_GT(run.network->frame().scale, 0);
    EXPECT_EQ(ReadFile(Run(kind) / "manifest.json").find(folder_->path().string()), std::string::npos);
  }
}

TEST_F(DeformTrainingTest, LearnsItsTrainingFaces) {
  Json config = Config("hypernetwork");
  config["epochs"] = 40;
  config["validate_every"] = 40;
  RunDeform(config, {Run("learns"), false}, {});
  const std::vector<double> errors = TrainingErrors(Run("learns"));
  EXPECT_LT(errors.back(), 0.7 * errors.front());
}

TEST_F(DeformTrainingTest, ResumedEqualsUninterruptedByteForByte) {
  const Json config = Config("hypernetwork");
  RunDeform(config, {Run("whole"), false}, {});
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(RunDeform(config, {Run("stopped"), false}, Task(stop.get_token())), Cancelled);
  RunDeform(config, {Run("stopped"), true}, {});
  for (const char* file : {"best/model.safetensors", "manifest.json"})
    EXPECT_EQ(ReadFile(Run("whole") / file), ReadFile(Run("stopped") / file)) << file;
}

// Two codes take a linear model to the rank of the data at most; more of them miss training faces less.
TEST_F(DeformTrainingTest, ALinearModelHasTheComponentsOfTrainingFaces) {
  const auto error_with = [&](int latent) {
    Json config = Config("linear");
    config["network"]["latent"] = latent;
    const fs::path folder = Run("linear" + std::to_string(latent));
    RunDeform(config, {folder, false}, {});
    const DeformRun run = LoadDeformRun(folder);
    const faces::FaceDatabase faces(*folder_ / "faces");
    const Json persons = run.manifest.details.at("split").at("train").at("persons");
    const auto first = faces.points(faces.index({persons.at(0).get<int>(), 0, 0}));
    const geometry::Points truth = run.network->frame().FromCm(first);
    const torch::Tensor rebuilt = run.network->DeformVertices(run.codes.slice(0, 0, 1))[0].to(torch::kFloat64);
    double sum = 0;
    for (Eigen::Index v = 0; v < truth.rows(); ++v)
      for (int k = 0; k < 3; ++k) sum += std::abs(rebuilt[v][k].item<double>() - truth(v, k));
    return sum;
  };
  EXPECT_LT(error_with(12), 0.5 * error_with(1));
}

TEST_F(DeformTrainingTest, RefusesWhatItCannotUse) {
  Json config = Config("hypernetwork");
  config["data"]["points"] = "";
  testing::ExpectError([&] { RunDeform(config, {Run("refused"), false}, {}); }, "data.points=FOLDER");
  config = Config("hypernetwork");
  config["network"]["kind"] = "hypernet";
  testing::ExpectError([&] { RunDeform(config, {Run("refused"), false}, {}); }, "hypernetwork");
  EXPECT_FALSE(fs::exists(Run("refused")));
}

TEST_F(DeformTrainingTest, EveryConfigOfADeformableModelIsParsed) {
  for (const char* name : {"paper", "cpu"}) {
    const Json config = LoadConfig(testing::SourceRoot() / "configs/deform" / (std::string(name) + ".toml"), {});
    EXPECT_EQ(ParseOptions<DeformTrainingOptions>(config, name).system, "deform");
  }
}

}  // namespace
}  // namespace daumier::deform
