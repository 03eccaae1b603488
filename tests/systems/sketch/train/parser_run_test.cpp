#include "systems/sketch/train/parser_run.h"

#include "tests/support/expect_error.h"
#include "tests/support/parser_run.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class LoadedParserRunTest : public testing::ParserRunTest {};

TEST_F(LoadedParserRunTest, HasTheNetworkReadyToPredict) {
  const ParserRun run = LoadParserRun(folder() / "run");
  EXPECT_FALSE(run.network->is_training());
  for (const torch::Tensor& parameter : run.network->parameters()) EXPECT_FALSE(parameter.requires_grad());
  testing::ExpectError([&] { LoadParserRun(folder() / "faces"); }, "faces");
}

}  // namespace
}  // namespace daumier::sketch
