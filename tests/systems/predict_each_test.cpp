#include "systems/predict_each.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::systems {
namespace {

/// A result whose record is the height of the picture; pictures of height 3 are refused.
FaceResult ResultOf(const Input& input) {
  const int height = PictureOf(input).height;
  if (height == 3) throw Error("it is too low");
  FaceResult result;
  result.record["height"] = height;
  return result;
}

Input PictureOfHeight(int height) {
  return render::Image(height, 8, 1);
}

TEST(PredictEach, ReturnsResultsInOrderAndReportsEach) {
  std::vector<int64_t> done;
  const Task task({}, [&](const TaskProgress& progress) {
    EXPECT_EQ(progress.unit, "pictures");
    EXPECT_EQ(progress.total, 2);
    done.push_back(progress.done);
  });
  const std::vector<Input> inputs = {PictureOfHeight(5), PictureOfHeight(7)};
  const std::vector<FaceResult> results = PredictEach(inputs, task, "pictures", ResultOf);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].record["height"], 5);
  EXPECT_EQ(results[1].record["height"], 7);
  EXPECT_EQ(done, (std::vector<int64_t>{1, 2}));
}

TEST(PredictEach, AnErrorNamesThePositionOfOneOfSeveralInputs) {
  const std::vector<Input> alone = {PictureOfHeight(3)};
  testing::ExpectError([&] { PredictEach(alone, {}, "pictures", ResultOf); }, "it is too low");
  try {
    PredictEach(alone, {}, "pictures", ResultOf);
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "it is too low");
  }
  const std::vector<Input> inputs = {PictureOfHeight(5), PictureOfHeight(3)};
  testing::ExpectError([&] { PredictEach(inputs, {}, "pictures", ResultOf); }, "input 2 of 2: it is too low");
  const std::vector<Input> mesh = {PictureOfHeight(5), geometry::PolygonMesh{}};
  testing::ExpectError([&] { PredictEach(mesh, {}, "pictures", ResultOf); }, "input 2 of 2: this is no picture");
}

TEST(PredictEach, StopsBetweenInputsAndLeavesCancellationUnchanged) {
  std::stop_source stop;
  const Task task(stop.get_token());
  const std::vector<Input> inputs = {PictureOfHeight(5), PictureOfHeight(7)};
  int num_predicted = 0;
  const auto predict = [&](const Input& input) {
    ++num_predicted;
    stop.request_stop();
    return ResultOf(input);
  };
  testing::ExpectError([&] { PredictEach(inputs, task, "pictures", predict); }, "stopped after 1 of 2 pictures");
  EXPECT_EQ(num_predicted, 1);
  const auto cancelled = [](const Input&) -> FaceResult { throw Cancelled("within"); };
  EXPECT_THROW(PredictEach(inputs, {}, "pictures", cancelled), Cancelled);
}

}  // namespace
}  // namespace daumier::systems
