#include "render/ruling.h"

#include "core/random.h"
#include "render/draw.h"
#include "render/strokes.h"
#include "tests/render/pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

/// Black lines on white, 400 x 400, some along the rows.
Image RuledDrawing() {
  return RasteriseStrokes({{0, {{60, 90}, {70, 170}, {128, 220}, {186, 170}, {196, 90}}},
                           {0, {{90, 110}, {166, 110}}},
                           {0, {{105, 180}, {128, 185}, {151, 180}}}},
                          400, {.width = 2.5});
}

struct PageStyle {
  double distance = 0.0;  ///< Pixels between lines; 0: none.
  Rgb colour = {110, 150, 210};
  bool squares = false;
  double degrees = 0.0;
  bool margin = false;
  double noise = 0.0;
};

/// The drawing over a printed page: lines of 1.2 pixels, antialiased; ink covers them.
Image OnPage(const Image& drawing, const PageStyle& style) {
  Image page(drawing.height, drawing.width, 3);
  const double sine = std::sin(style.degrees * std::numbers::pi / 180),
               cosine = std::cos(style.degrees * std::numbers::pi / 180);
  const auto cover = [](double distance) { return std::clamp(1.1 - std::abs(distance), 0.0, 1.0); };
  const auto of_many = [&](double place) {
    return style.distance == 0.0 ? 0.0 : cover(std::remainder(place, style.distance));
  };
  Rng rng(5);
  for (int row = 0; row < page.height; ++row) {
    for (int column = 0; column < page.width; ++column) {
      const double u = cosine * column + sine * row, v = cosine * row - sine * column;
      const double line = std::max(of_many(v), style.squares ? of_many(u) : 0.0),
                   red = style.margin ? cover(u - 40.3) : 0.0;
      const double ink = 1.0 - drawing.at(row, column) / 255.0, grain = style.noise * rng.Normal();
      for (int channel = 0; channel < 3; ++channel) {
        double value = 248.0 * (1.0 - line) + style.colour[channel] * line;
        value = value * (1.0 - red) + (channel == 0 ? 225.0 : 80.0) * red;
        value = value * (1.0 - ink) + 30.0 * ink + grain;
        page.at(row, column, channel) = static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
      }
    }
  }
  return page;
}

/// Shares of the paper that is dark, and of the ink that is not, after the page's lines are removed.
struct Mistakes {
  double left = 0.0, lost = 0.0;
};

Mistakes MistakesOn(const PageStyle& style) {
  const Image drawing = RuledDrawing(), clean = WithoutRuling(OnPage(drawing, style));
  double num_paper = 0, num_ink = 0;
  Mistakes mistakes;
  for (int row = 0; row < clean.height; ++row) {
    for (int column = 0; column < clean.width; ++column) {
      const int darkest = std::min({clean.at(row, column, 0), clean.at(row, column, 1), clean.at(row, column, 2)});
      if (drawing.at(row, column) == 255) {
        num_paper += 1;
        mistakes.left += darkest < 195;
      } else if (drawing.at(row, column) == 0) {
        num_ink += 1;
        mistakes.lost += darkest > 110;
      }
    }
  }
  mistakes.left /= num_paper;
  mistakes.lost /= num_ink;
  return mistakes;
}

TEST(WithoutRuling, RemovesRuledAndSquaredPaper) {
  for (const PageStyle& style : {PageStyle{.distance = 17.3},
                                 {.distance = 17.3, .margin = true},
                                 {.distance = 12.1, .squares = true},
                                 {.distance = 16.0, .squares = true, .degrees = 2.0},
                                 {.distance = 21.7, .colour = {210, 70, 70}, .degrees = -4.0},
                                 {.distance = 22.0, .colour = {150, 150, 150}, .noise = 3.0},
                                 {.distance = 14.0, .colour = {205, 215, 230}, .margin = true}}) {
    const Mistakes mistakes = MistakesOn(style);
    // Of turned lines some faint dashes stay, which are no ink.
    EXPECT_LE(mistakes.left, style.degrees == 0.0 ? 0.004 : 0.035) << style.distance;
    EXPECT_LE(mistakes.lost, 0.02) << style.distance;
  }
}

TEST(WithoutRuling, BridgesGapsInStrokesUnderBlackLines) {
  const Mistakes mistakes = MistakesOn({.distance = 23.0, .colour = {40, 40, 40}});
  EXPECT_LE(mistakes.left, 0.01);
  EXPECT_LE(mistakes.lost, 0.08);
}

TEST(WithoutRuling, LoneLineOfAnotherColourIsThePage) {
  const Mistakes mistakes = MistakesOn({.margin = true});
  EXPECT_LE(mistakes.left, 0.001);
  EXPECT_LE(mistakes.lost, 0.01);
}

TEST(WithoutRuling, OtherPicturesAreUnchanged) {
  const Image drawing = RuledDrawing();
  EXPECT_EQ(WithoutRuling(drawing), drawing);
  const Image noisy = OnPage(drawing, {.noise = 8.0});
  EXPECT_EQ(WithoutRuling(noisy), noisy);
  // One black line across the page, and hatching that ends.
  std::vector<Stroke> strokes = {{0, {{0, 200}, {256, 200}}}};
  for (int i = 0; i < 12; ++i) strokes.push_back({0, {{60, 60.0F + 6 * i}, {130, 60.0F + 6 * i}}});
  const Image hatched = ToRgb(RasteriseStrokes(strokes, 400));
  EXPECT_EQ(WithoutRuling(hatched), hatched);
  for (const auto& [height, width] : {std::pair{0, 0}, {1, 1}, {1, 500}, {64, 64}}) {
    const Image blank(height, width, 1, 90);
    EXPECT_EQ(WithoutRuling(blank), blank);
  }
}

}  // namespace
}  // namespace daumier::render
