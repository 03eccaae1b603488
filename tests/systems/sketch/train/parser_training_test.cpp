#include "systems/sketch/train/parser_training.h"

#include "core/files.h"
#include "core/run_manifest.h"
#include "systems/sketch/parser_run_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/parser_run.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class ParserTrainingTest : public testing::ParserRunTest {};

TEST_F(ParserTrainingTest, AFinishedRunResumesToItself) {
  const std::string before = ReadFile(BestWeights(folder() / "run"));
  EXPECT_EQ(Train("run", true).best_epoch, 1);
  EXPECT_EQ(ReadFile(BestWeights(folder() / "run")), before);
}

TEST_F(ParserTrainingTest, EqualTrainingsGiveEqualWeights) {
  Train("again", false);
  EXPECT_EQ(Sha256OfFile(BestWeights(folder() / "again")), Sha256OfFile(BestWeights(folder() / "run")));
}

TEST_F(ParserTrainingTest, TheRunHasItsSplitAndTheHashesOfItsData) {
  const ParserRunFolder run = ReadParserRunFolder(folder() / "run");
  EXPECT_EQ(run.network_options.resolution, 64);
  EXPECT_EQ(run.manifest.details.at("split").at("test").at("num_persons"), 1);
  EXPECT_EQ(run.manifest.details.at("data").at("faces"), DataHash(folder() / "faces"));
  EXPECT_TRUE(std::filesystem::is_regular_file(folder() / "run" / kBestGraph));
}

}  // namespace
}  // namespace daumier::sketch
