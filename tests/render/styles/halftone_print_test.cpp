#include "render/styles/drawn_media.h"

#include "render/styles/dot_screen.h"
#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::BallHead;
using daumier::testing::MeanOfPlane;

TEST(DotScreen, CoversAboutTheTone) {
  const DotScreen screen(8, 0.4f);
  for (const float tone : {0.0f, 0.1f, 0.3f, 0.5f, 0.8f, 1.0f}) {
    double sum = 0;
    for (int i = 0; i < 6400; ++i) sum += screen.Coverage(static_cast<float>(i % 80), static_cast<float>(i / 80), tone);
    EXPECT_NEAR(sum / 6400, tone, 0.08) << tone;
  }
}

TEST(HalftonePrint, HasThreeKindsOfScreens) {
  const PictureLayers layers = MakePictureLayers(BallHead());
  MediumInput input{MakeColourPlanes(64, 64, {0.7f, 0.5f, 0.4f}), Plane(64, 64)};
  for (Plane& plane : input.colours) std::fill(plane.values.begin() + 32 * 64, plane.values.end(), 0.2f);
  StyleChoice choice;
  choice.screen = 16;
  choice.screens = ScreenKind::kBlack;
  const ColourPlanes black = HalftonePrint(input, layers, choice);
  std::set<float> greens;
  for (const float value : black[1].values) greens.insert(value);
  EXPECT_NEAR(*greens.begin(), choice.line_colour[1], 1e-4) << "ink";
  EXPECT_NEAR(*greens.rbegin(), choice.paper[1], 1e-4) << "paper";
  choice.screens = ScreenKind::kShadows;
  const ColourPlanes shadows = HalftonePrint(input, layers, choice);
  EXPECT_EQ(shadows[0].at(1, 1), 0.7f) << "not covered";
  EXPECT_LT(MeanOfPlane(shadows[0]), MeanOfPlane(input.colours[0]) - 0.005);
  choice.screens = ScreenKind::kProcess;
  const ColourPlanes process = HalftonePrint(input, layers, choice);
  EXPECT_GT(MeanOfPlane(process[0]), MeanOfPlane(process[2])) << "orange";
}

}  // namespace
}  // namespace daumier::render
