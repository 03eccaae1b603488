#include "datasets/gestures/test_gestures.h"

#include "core/error.h"
#include "datasets/gestures/other_plans.h"
#include "datasets/gestures/pen_device.h"
#include "datasets/gestures/test_plans.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

PenPlan PlanTestGesture(Gesture gesture, Rng& rng) {
  const int index = static_cast<int>(gesture);
  switch (gesture) {
    case Gesture::kLine:
      return PlanTestLine(rng);
    case Gesture::kRegion:
      return PlanTestRegion(rng);
    case Gesture::kLeftArrow:
      return PlanTestArrow(180 + Deviate(8, rng), rng);
    case Gesture::kRightArrow:
      return PlanTestArrow(Deviate(8, rng), rng);
    case Gesture::kUpRoll1:
    case Gesture::kUpRoll2:
    case Gesture::kUpRoll3:
      return PlanTestRoll(index - static_cast<int>(Gesture::kUpRoll1) + 1, rng.Uniform(20, 66), rng);
    case Gesture::kDownRoll1:
    case Gesture::kDownRoll2:
    case Gesture::kDownRoll3:
      return PlanTestRoll(index - static_cast<int>(Gesture::kDownRoll1) + 1, -rng.Uniform(20, 66), rng);
    case Gesture::kNone: {
      const int kind = Happens(0.25, rng) ? 0 : static_cast<int>(rng.Below(kNumOtherStrokes));
      return PlanOtherStroke(static_cast<OtherStroke>(kind), rng);
    }
  }
  throw Error("there is no such gesture");
}

}  // namespace

Polyline DrawTestGesture(Gesture gesture, Rng& rng) {
  const PenPlan plan = PlanTestGesture(gesture, rng);
  const PenDevice device = DrawPenDevice(rng);
  WriterHand hand = DrawWriterHand(rng);
  // Where few positions arrive, a person soon draws more slowly.
  if (device.kind == PenDeviceKind::kSlowMachine) hand.tempo_s = std::max(hand.tempo_s, 0.14);
  if (gesture == Gesture::kLine) hand.aim_noise *= 0.3;  // Errors of aim along a line would bend it.
  Polyline movement = MovePen(plan, hand, rng);
  const Eigen::Vector2d middle{rng.Uniform(350, 900), rng.Uniform(350, 900)};
  for (Eigen::Vector2d& point : movement) point += middle;
  return SamplePen(movement, device, rng);
}

}  // namespace daumier::datasets
