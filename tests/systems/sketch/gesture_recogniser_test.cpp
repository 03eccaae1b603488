#include "systems/sketch/gesture_recogniser.h"

#include "core/median_time.h"
#include "datasets/gestures/gesture_strokes.h"
#include "datasets/gestures/stroke_form.h"
#include "render/quickdraw.h"
#include "systems/sketch/gesture_predictor.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/gesture_runs.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::sketch {
namespace {

using datasets::Gesture;
using datasets::Polyline;
using testing::ExpectError;

GestureRecogniser Halves(double threshold) {
  return {{{}, {.threshold = threshold}}, std::make_shared<testing::HalvesNetwork>()};
}

const Polyline kHeavyRight = {{0, 5}, {10, 5}, {8, 3}, {10, 5}, {8, 7}};

TEST(DecideGesture, IsTheSoftmaxOfAllElevenAndTheLikeliestOfTen) {
  std::vector<float> scores(size_t{kNumGestureClasses}, 0);
  scores[size_t(Gesture::kUpRoll2)] = float(std::log(4));
  scores[size_t(Gesture::kNone)] = float(std::log(7));
  const RecognisedGesture found = DecideGesture(scores, {.threshold = 0.2});
  EXPECT_NEAR(found.probability, 0.2, 1e-6) << "4 of 9 + 4 + 7";
  EXPECT_EQ(found.likeliest, Gesture::kUpRoll2);
  EXPECT_EQ(DecideGesture(scores, {.threshold = 0.19}).gesture, Gesture::kUpRoll2);
  EXPECT_EQ(DecideGesture(scores, {.threshold = 0.21}).gesture, Gesture::kNone);
  ExpectError([] { DecideGesture(std::vector<float>(10), {}); }, "10 scores of a gesture, expected 11");
}

TEST(GestureRecogniser, ReadsThePictureOfTheStroke) {
  EXPECT_EQ(Halves(0.5).Recognise(kHeavyRight).gesture, Gesture::kRightArrow);
  Polyline mirrored;
  for (const auto& point : kHeavyRight) mirrored.emplace_back(-point.x(), point.y());
  EXPECT_EQ(Halves(0.5).Recognise(mirrored).gesture, Gesture::kLeftArrow);
  const RecognisedGesture even = Halves(0.5).Recognise({{0, 0}, {10, 0}});
  EXPECT_EQ(even.gesture, Gesture::kNone);
  EXPECT_LT(even.probability, 0.5);
}

TEST(GestureRecogniser, RefusesBadStrokes) {
  const GestureRecogniser recogniser = Halves(0.5);
  ExpectError([&] { recogniser.Recognise({}); }, "a gesture of 0 points");
  ExpectError([&] { recogniser.Recognise({{3, 4}}); }, "a gesture of 1 points");
  ExpectError([&] { recogniser.Recognise({{3, 4}, {std::numeric_limits<double>::quiet_NaN(), 4}}); }, "finite");
  ExpectError(
      [&] {
        recogniser.Recognise({{3, 4}, {std::numeric_limits<double>::infinity(), 4}});
      },
      "expected finite numbers");
}

TEST(GestureRecogniser, ATapIsNone) {
  EXPECT_EQ(Halves(0).Recognise({{3, 4}, {3, 4}}).gesture, Gesture::kNone);
  EXPECT_EQ(Halves(0).Recognise({{3, 4}, {5, 4}, {8, 3}}).gesture, Gesture::kNone);
  EXPECT_NE(Halves(0).Recognise(kHeavyRight).gesture, Gesture::kNone);
}

TEST(GestureRecogniser, MayBeUsedFromSeveralThreads) {
  const GestureRecogniser recogniser = Halves(0.5);
  testing::ExpectTheSameFromThreads(20, [&] { return recogniser.Recognise(kHeavyRight).probability; });
}

/// Of the shipped weights, with strokes of hands that they were not trained on (another seed).
class ShippedGestures : public ::testing::Test {
 protected:
  static GestureRecogniser Open() { return OpenGestureRecogniser(testing::SourceRoot() / "weights/gestures"); }
};

TEST_F(ShippedGestures, RecogniseGeneratedStrokesAndRejectOthers) {
  const GestureRecogniser recogniser = Open();
  int num_gestures = 0, num_right = 0, num_none = 0, num_rejected = 0;
  for (int hand = 0; hand < 10; ++hand) {
    for (const auto& stroke : datasets::StrokesOfHand({}, {.per_gesture = 2, .none = 17}, 777, hand)) {
      const RecognisedGesture found = recogniser.Recognise(stroke.points);
      if (stroke.gesture == Gesture::kNone)
        ++num_none, num_rejected += found.gesture == Gesture::kNone;
      else
        ++num_gestures, num_right += found.likeliest == stroke.gesture;
    }
  }
  EXPECT_GE(num_right, 0.93 * num_gestures);
  EXPECT_GE(num_rejected, 0.9 * num_none);
}

TEST_F(ShippedGestures, RejectMostLinesOfDrawingsByPeople) {
  const auto data = testing::SharedData();
  if (!data) GTEST_SKIP() << "there is no shared/data/sketches";
  const std::filesystem::path file = *data / "sketches/quickdraw_face.ndjson";
  const GestureRecogniser recogniser = Open();
  int num_lines = 0, num_rejected = 0;
  for (const render::Drawing& drawing : render::ReadQuickDraw(file)) {
    for (const render::Stroke& stroke : drawing.strokes) {
      const Polyline line = PolylineOf(stroke);
      if (datasets::BoxOf(line).sizes().maxCoeff() < GestureRecogniser::kLeastExtent) continue;
      const datasets::StrokeForm form = datasets::FormOf(line);
      if (form.is_nearly_straight() || form.is_nearly_closed()) continue;
      ++num_lines;
      num_rejected += recogniser.Recognise(line).gesture == Gesture::kNone;
    }
  }
  EXPECT_GE(num_lines, 20);
  EXPECT_GE(num_rejected, 0.7 * num_lines);
}

TEST_F(ShippedGestures, GiveTheSameFromThreads) {
  const GestureRecogniser recogniser = Open();
  testing::ExpectTheSameFromThreads(10, [&] { return recogniser.Recognise(kHeavyRight).probability; });
}

TEST_F(ShippedGestures, TakeFewMilliseconds) {
  const GestureRecogniser recogniser = Open();
  recogniser.Recognise(kHeavyRight);
  const double milliseconds = MedianMs([&] { recogniser.Recognise(kHeavyRight); });
  std::printf("%.2f ms a stroke\n", milliseconds);
  EXPECT_LT(milliseconds, 40) << "4 on a machine that does nothing else";
}

}  // namespace
}  // namespace daumier::sketch
