#include "systems/sketch/train/gesture_evaluation.h"

#include "core/files.h"
#include "systems/sketch/system.h"
#include "tests/support/expect_error.h"
#include "tests/support/gesture_run.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class GestureEvaluationTest : public testing::GestureRunTest {};

TEST_F(GestureEvaluationTest, MeasuresStrokesOfUnseenHands) {
  FolderCache databases;
  const reports::Evaluation evaluation = EvaluateGestures(folder() / "run", {}, databases, {});
  EXPECT_EQ(evaluation.metrics.at("num_gestures"), 20) << "of one hand";
  EXPECT_EQ(evaluation.metrics.at("num_none"), 20);
  int64_t num_counted = 0;
  for (const auto& [truth, row] : evaluation.metrics.at("confusion").items())
    for (const auto& [found, count] : row.items()) num_counted += count.get<int64_t>();
  EXPECT_EQ(num_counted, 40);
  EXPECT_NEAR(evaluation.table.rows[0].error().mean, 1 - evaluation.metrics.at("accuracy").get<double>(), 1e-12);
  EXPECT_GE(evaluation.metrics.at("at_accepted").at("accepted"), 0.97);
  EXPECT_LE(evaluation.metrics.at("at_accepted").at("rejected"), 1);
  EXPECT_GT(evaluation.metrics.at("milliseconds"), 0);
  EXPECT_EQ(GestureSystem().read_metrics(evaluation.metrics).rows.size(), 1u);
  reports::WriteEvaluation(folder() / "report", evaluation);
  testing::ExpectError([&] { EvaluateGestures(folder() / "run", {.data = {.gestures = "/nowhere"}}, databases, {}); },
                       "nowhere");
}

TEST_F(GestureEvaluationTest, IndependentStrokesNeedNoData) {
  FolderCache databases;
  const GestureEvalOptions options{.strokes = "independent", .per_gesture = 2, .none = 3};
  const Json metrics = EvaluateGestures(folder() / "run", options, databases, {}).metrics;
  EXPECT_EQ(metrics.at("num_gestures"), 20);
  EXPECT_EQ(metrics.at("num_none"), 3);
  EXPECT_EQ(metrics.at("confusion"),
            EvaluateGestures(folder() / "run", options, databases, {}).metrics.at("confusion"));
  EXPECT_EQ(databases.size(), 0u);
}

TEST_F(GestureEvaluationTest, StrokesOfADrawingCountAsNoneUnlessStraightOrClosed) {
  WriteFileAtomically(folder() / "drawing.ndjson",
                      "{\"drawing\": [[[0, 100], [0, 3]], [[0, 90, 90, 0, 0], [0, 0, 90, 90, 2]], [[5], [5]],"
                      " [[0, 40, 80, 120], [0, 90, 0, 90]]]}\n");
  FolderCache databases;
  GestureEvalOptions options{.per_gesture = 1, .none = 1};
  options.drawings = (folder() / "drawing.ndjson").string();
  const Json drawings = EvaluateGestures(folder() / "run", options, databases, {}).metrics.at("drawings");
  EXPECT_EQ(drawings.at("nearly_straight"), 1);
  EXPECT_EQ(drawings.at("nearly_closed"), 1);
  EXPECT_EQ(drawings.at("points"), 1);
  EXPECT_EQ(drawings.at("num_none"), 1);
}

}  // namespace
}  // namespace daumier::sketch
