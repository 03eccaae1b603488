#include "render/styles/picture_lines.h"

#include "render/styles/dot_screen.h"
#include "render/styles/filled_shapes.h"
#include "render/styles/hatching.h"
#include "render/styles/ink_stamp.h"
#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace daumier::render {
namespace {

double MeanCoverage(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / double(plane.values.size());
}

TEST(StampInk, HasTheCoverageWorkedOutByHand) {
  Plane ink(5, 5);
  StampInk(ink, 2.5f, 2.5f, 0.75f);
  EXPECT_EQ(ink.at(2, 2), 1);
  EXPECT_NEAR(ink.at(2, 3), 0.25f, 1e-6) << "a pixel away: 0.75 + 0.5 - 1";
  EXPECT_EQ(ink.at(2, 4), 0);
  StampInk(ink, 2.5f, 2.5f, 0.5f);
  EXPECT_NEAR(ink.at(2, 3), 0.25f, 1e-6) << "stamps do not add up";
  StampInk(ink, -30, 90, 3);
  StampInk(ink, 0.5f, 0.5f, -0.6f);
  EXPECT_EQ(ink.at(0, 0), 0);
}

TEST(BorderLines, FollowTheOutlineOfABall) {
  for (const int supersampling : {1, 2}) {
    int num_outline = 0;
    for (const LinePoint& point : BorderLines(testing::BallHead(64, supersampling))) {
      if (point.strength < 1) continue;
      ++num_outline;
      EXPECT_NEAR(std::hypot(point.x - 32, point.y - 32), 24, 0.6) << "9 of 24 cm of 64 pixels";
    }
    EXPECT_GT(num_outline, 100 * supersampling);
  }
}

TEST(ValleyLines, RunAlongAFoldAndNotAlongARidge) {
  for (const float sign : {1.0f, -1.0f}) {
    // n.z falls towards the fold, column 20, as where two cheeks meet, or rises to it.
    PictureBuffers buffers = EmptyPictureBuffers(40, 40);
    for (size_t i = 0; i < buffers.size(); ++i) {
      const float away = std::abs(static_cast<float>(i % 40) + 0.5f - 20) / 5;
      const float tilt = sign > 0 ? std::max(0.0f, 0.7f - 0.5f * away) : std::min(0.7f, 0.5f * away);
      buffers.depth[i] = 100;
      buffers.classes[i] = static_cast<uint8_t>(PictureClass::kSkin);
      buffers.normal[3 * i] = tilt;
      buffers.normal[3 * i + 2] = std::sqrt(1 - tilt * tilt);
    }
    PictureLayers layers = MakePictureLayers(buffers);
    layers.scale = 1;
    int num_in_fold = 0;
    for (const LinePoint& point : ValleyLines(layers)) num_in_fold += std::abs(point.x - 20) < 1 ? 1 : 0;
    if (sign > 0) {
      EXPECT_GT(num_in_fold, 25);
    } else {
      EXPECT_EQ(num_in_fold, 0);
    }
  }
}

TEST(Hatch, CoversMoreWhereItIsDarker) {
  double last = -1;
  for (const float dark : {0.0f, 0.2f, 0.45f, 0.7f, 1.0f}) {
    Rng rng(5);
    const double coverage = MeanCoverage(Hatch(Plane(80, 80, dark), {}, rng));
    EXPECT_GT(coverage, last);
    last = coverage;
  }
  EXPECT_GT(last, 0.75);
  Rng rng(5);
  EXPECT_EQ(MeanCoverage(Hatch(Plane(20, 20, 0.02f), {}, rng)), 0);
}

TEST(DotScreen, CoversAboutTheTone) {
  const DotScreen screen(8, 0.4f);
  for (const float tone : {0.0f, 0.1f, 0.3f, 0.5f, 0.8f, 1.0f}) {
    double sum = 0;
    for (int i = 0; i < 6400; ++i) sum += screen.Coverage(static_cast<float>(i % 80), static_cast<float>(i / 80), tone);
    EXPECT_NEAR(sum / 6400, tone, 0.08) << tone;
  }
}

TEST(FilledShapes, HaveTheirAreas) {
  ColourPlanes colours = MakeColourPlanes(60, 60, {0, 0, 0});
  FillEllipse(colours, 30, 30, 20, 10, 0.7f, {{1, 1, 1}});
  EXPECT_NEAR(MeanCoverage(colours[0]) * 3600, 3.14159 * 200, 12);
  colours = MakeColourPlanes(60, 60, {0, 0, 0});
  FillBox(colours, 30, 30, 12, 7, 0.4f, 0, {{1, 0.5f, 1}});
  EXPECT_NEAR(MeanCoverage(colours[0]) * 3600, 4 * 84, 4);
  EXPECT_NEAR(MeanCoverage(colours[1]) * 3600, 2 * 84, 2);
  colours = MakeColourPlanes(4, 2, {0, 0, 0});
  FillBelow(colours, {1, 2.5f}, {{1, 1, 1}});
  EXPECT_EQ(colours[0].values, (std::vector<float>{0, 0, 1, 0, 1, 0.5f, 1, 1}));
  FillEllipse(colours, -500, 900, 3, 3, 0, {{1, 1, 1}});
}

}  // namespace
}  // namespace daumier::render
