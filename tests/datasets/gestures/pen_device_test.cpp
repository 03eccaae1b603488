#include "datasets/gestures/pen_device.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

/// Half a second along a parabola.
Polyline ParabolaByMillisecond() {
  Polyline path;
  for (int i = 0; i <= 500; ++i) path.emplace_back(20 + 0.4 * i, 200 - 0.0016 * (i - 250) * (i - 250));
  return path;
}

TEST(SamplePen, ATabletReportsPositionsAtItsRate) {
  Rng rng(1);
  const Polyline reported = SamplePen(ParabolaByMillisecond(), {.rate_hz = 100}, rng);
  EXPECT_NEAR(static_cast<double>(reported.size()), 51, 4);
  for (const Vector2d& point : reported) EXPECT_LT(DistanceTo(ParabolaByMillisecond(), point), 1e-9);
  EXPECT_EQ(reported.front(), ParabolaByMillisecond().front());
  EXPECT_EQ(reported.back(), ParabolaByMillisecond().back());
}

TEST(SamplePen, AMouseReportsWholePixelsNearTheWay) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const PenDevice mouse = {PenDeviceKind::kMouse, 80, 1, 0.3, 0, 0, 0};
    for (const Vector2d& point : SamplePen(ParabolaByMillisecond(), mouse, rng)) {
      EXPECT_EQ(point, point.array().round().matrix());
      EXPECT_LT(DistanceTo(ParabolaByMillisecond(), point), 12);
    }
  }
}

TEST(SamplePen, SlopDelaysTheSecondPosition) {
  Rng rng(2);
  const Polyline reported = SamplePen(ParabolaByMillisecond(), {.rate_hz = 60, .slop_px = 30}, rng);
  EXPECT_GT((reported[1] - reported[0]).norm(), 30);
}

TEST(SamplePen, LossKeepsBothEnds) {
  Rng rng(3);
  const Polyline reported = SamplePen(ParabolaByMillisecond(), {.rate_hz = 100, .loss = 0.8}, rng);
  EXPECT_LT(reported.size(), 25u);
  EXPECT_EQ(reported.back(), ParabolaByMillisecond().back());
}

TEST(SamplePen, ARestingPenIsReportedTwice) {
  Rng rng(4);
  EXPECT_EQ(SamplePen(Polyline(300, Vector2d(7, 8)), {}, rng), Polyline(2, Vector2d(7, 8)));
  EXPECT_EQ(SamplePen({{7, 8}}, {}, rng), Polyline(2, Vector2d(7, 8)));
  testing::ExpectError([&] { SamplePen({}, {}, rng); }, "a movement of the pen has no points");
}

TEST(DrawPenDevice, DrawsEveryKind) {
  std::set<PenDeviceKind> kinds;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed);
    const PenDevice device = DrawPenDevice(rng);
    kinds.insert(device.kind);
    EXPECT_GE(device.rate_hz, 40);
    EXPECT_EQ(device.kind == PenDeviceKind::kSlowMachine, device.loss > 0);
  }
  EXPECT_EQ(kinds.size(), 4u);
}

}  // namespace
}  // namespace daumier::datasets
