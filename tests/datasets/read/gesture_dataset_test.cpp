#include "datasets/read/gesture_dataset.h"

#include "datasets/build/gestures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(GestureDataset, ReturnsPicturesAndGesturesOfItsStrokes) {
  const testing::TempDir folder;
  BuildGestures({.num_hands = 3, .per_gesture = 1, .none = 2}, folder / "gestures");
  const GestureDatabase database(folder / "gestures");
  const GestureDataset dataset(database, {0, 12, 13, 35}, {.side = 32});
  ASSERT_EQ(dataset.size(), 4);
  const std::vector<int> samples = {3, 1};
  const SampleBatch batch = dataset.Get(samples);
  EXPECT_EQ(batch.arrays.at("pictures").shape, (std::vector<int64_t>{2, 1, 32, 32}));
  std::vector<float> expected(32 * 32);
  RasteriseGesture(database.stroke(12).points, {.side = 32}, expected);
  const float* const row = batch.arrays.at("pictures").row(1);
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), row));
  EXPECT_EQ(batch.indices.at("gestures").values,
            (std::vector<int64_t>{int64_t(Gesture::kNone), int64_t(database.stroke(12).gesture)}));
  testing::ExpectError([&] { dataset.Get(std::vector<int>{4}); }, "sample 4 of a dataset of 4");
  testing::ExpectError([&] { GestureDataset(database, {36}, {}); }, "stroke 36 of a database of 36");
}

}  // namespace
}  // namespace daumier::datasets
