#include "systems/sketch/train/parser_evaluation.h"

#include "core/error.h"
#include "systems/sketch/system.h"
#include "tests/support/expect_error.h"
#include "tests/support/parser_run.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class ParserEvaluationTest : public testing::ParserRunTest {};

TEST_F(ParserEvaluationTest, MeasuresDrawingsOfUnseenPersons) {
  FolderCache databases;
  const reports::Evaluation evaluation = EvaluateParser(folder() / "run", {}, databases, {});
  ASSERT_EQ(evaluation.table.rows.size(), 3u);
  EXPECT_TRUE(evaluation.table.rows[2].baseline);
  EXPECT_EQ(evaluation.metrics.at("num_persons"), 1);
  EXPECT_LE(evaluation.metrics.at("num_faces"), 8);
  for (const char* state : {"mouth", "eyes", "view", "labels"}) {
    const double accuracy = evaluation.metrics.at(state).at("balanced_accuracy");
    EXPECT_GE(accuracy, 0);
    EXPECT_LE(accuracy, 1);
  }
  EXPECT_TRUE(evaluation.sheet.has_value());
  EXPECT_EQ(ParserSystem().read_metrics(evaluation.metrics).rows.size(), 3u);
  reports::WriteEvaluation(folder() / "report", evaluation);
  testing::ExpectError([&] { EvaluateParser(folder() / "run", {.data = {.faces = "/nowhere"}}, databases, {}); },
                       "nowhere");
}

TEST_F(ParserEvaluationTest, IsTheSameEachTime) {
  FolderCache databases;
  const auto error = [&] {
    return EvaluateParser(folder() / "run", {.drawings = 4}, databases, {}).table.rows[0].error().mean;
  };
  EXPECT_EQ(error(), error());
}

}  // namespace
}  // namespace daumier::sketch
