#include "datasets/read/gesture_database.h"

#include "core/files.h"
#include "datasets/build/gestures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

using testing::ExpectError;
using testing::TempDir;

const GesturesOptions kFewStrokes{.num_hands = 10, .per_gesture = 1, .none = 3, .seed = 4};

TEST(GestureDatabase, HasTheStrokesOfEachHand) {
  const TempDir folder;
  BuildGestures(kFewStrokes, folder / "gestures");
  const GestureDatabase database(folder / "gestures");
  ASSERT_EQ(database.num_strokes(), 130);
  EXPECT_EQ(database.num_hands(), 10);
  const auto expected = StrokesOfHand(kFewStrokes.hand, {1, 3}, 4, 7);
  for (int i = 0; i < 13; ++i) {
    const LabelledStroke stroke = database.stroke(7 * 13 + i), &truth = expected[size_t(i)];
    EXPECT_EQ(stroke.gesture, truth.gesture);
    EXPECT_EQ(stroke.other, truth.other);
    EXPECT_EQ(database.hand(7 * 13 + i), 7);
    ASSERT_EQ(stroke.points.size(), truth.points.size());
    for (size_t p = 0; p < stroke.points.size(); ++p) EXPECT_LT((stroke.points[p] - truth.points[p]).norm(), 1e-3);
  }
  ExpectError([&] { (void)database.stroke(130); }, "stroke 130 of a database of 130");
}

TEST(GestureDatabase, RefusesDamagedFiles) {
  const TempDir folder;
  BuildGestures(kFewStrokes, folder / "gestures");
  const auto shard = folder / "gestures" / GestureShardName(0);
  WriteGestureShard(shard, StrokesOfHand({}, {1, 0}, 1, 0));
  ExpectError([&] { GestureDatabase(folder / "gestures"); }, "hands-00000");
  ExpectError([&] { GestureDatabase(folder / "gestures", Checksums::kSkip); }, "130 strokes, and 10 in its shards");
  auto strokes = StrokesOfHand({}, {1, 0}, 1, 0);
  strokes[2].hand = 99;
  WriteGestureShard(shard, strokes);
  ExpectError([&] { GestureDatabase(folder / "gestures", Checksums::kSkip); }, "its numbers are no strokes");
  ExpectError([&] { GestureDatabase(folder / "absent"); }, "absent");
}

TEST(SplitByHand, NoHandIsInTwoSubsets) {
  const TempDir folder;
  BuildGestures(kFewStrokes, folder / "gestures");
  const GestureDatabase database(folder / "gestures");
  const GestureSplit split = SplitByHand(database, 0.2, 0.3, 1);
  EXPECT_EQ(split.train.size(), 5u * 13);
  EXPECT_EQ(split.validation.size(), 2u * 13);
  EXPECT_EQ(split.test.size(), 3u * 13);
  std::set<int> hands;
  for (const auto* subset : {&split.train, &split.validation, &split.test}) {
    std::set<int> of_subset;
    for (const int index : *subset) of_subset.insert(database.hand(index));
    const size_t before = hands.size();
    hands.insert(of_subset.begin(), of_subset.end());
    EXPECT_EQ(hands.size(), before + of_subset.size());
  }
  EXPECT_EQ(hands.size(), 10u);
  EXPECT_EQ(SplitByHand(database, 0.2, 0.3, 1).test, split.test);
  EXPECT_NE(SplitByHand(database, 0.2, 0.3, 2).test, split.test);
  ExpectError([&] { SplitByHand(database, 0.5, 0.5, 1); }, "10 hands are too few");
}

}  // namespace
}  // namespace daumier::datasets
