#include "render/styles/styled_picture.h"

#include "core/error.h"
#include "render/styles/picture_layers.h"
#include "tests/render/styles/picture_example.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::render {
namespace {

using daumier::testing::ExpectError;
using testing::BallHead;

StyleChoice PlainChoice(PictureStyle style) {
  StyleChoice choice;
  choice.style = style;
  choice.background.kind = BackgroundKind::kFlat;
  choice.background.first = {0.2f, 0.5f, 0.9f};
  return choice;
}

Image DrawnWith(const PictureBuffers& buffers, const StyleChoice& choice, uint64_t seed = 3) {
  Rng rng(seed);
  return DrawStyled(buffers, choice, rng);
}

std::vector<PictureStyle> AllStyles() {
  std::vector<PictureStyle> styles;
  for (int style = 0; style < kNumPictureStyles; ++style) styles.push_back(static_cast<PictureStyle>(style));
  return styles;
}

TEST(DrawStyled, EveryStyleShowsTheHeadBeforeItsBackground) {
  const PictureBuffers buffers = BallHead();
  for (const PictureStyle style : AllStyles()) {
    StyleChoice choice = PlainChoice(style);
    choice.lines = LineSource::kBuffers;
    const Image picture = DrawnWith(buffers, choice);
    EXPECT_EQ(picture.height, 64);
    EXPECT_EQ(picture.width, 64);
    EXPECT_EQ(picture.channels, 3);
    StyleChoice other = choice;
    other.style = style == PictureStyle::kFlat ? PictureStyle::kClay : PictureStyle::kFlat;
    EXPECT_NE(picture, DrawnWith(buffers, other)) << NameOf(style);
    EXPECT_NE(picture, DrawnWith(EmptyPictureBuffers(128, 128, 2), choice)) << NameOf(style);
  }
}

TEST(DrawStyled, EveryStyleNamedInTheOptionsIsDrawn) {
  // Each share alone, by its name.
  const Json names = ToJson(StyleOptions{});
  for (const PictureStyle style : AllStyles()) {
    Json shares = {{"grey", 0.0}};
    for (const PictureStyle other : AllStyles()) shares[std::string(NameOf(other))] = other == style ? 1.0 : 0.0;
    ASSERT_TRUE(names.contains(std::string(NameOf(style)))) << NameOf(style);
    const auto options = ParseOptions<StyleOptions>(shares);
    for (int i = 0; i < 4; ++i) {
      Rng rng = Stream(5, "styles", i);
      const StyleChoice choice = DrawStyleChoice(rng, options);
      EXPECT_EQ(StyleName(choice), NameOf(style));
      EXPECT_EQ(DrawStyled(BallHead(), choice, rng).height, 64);
    }
  }
}

TEST(DrawStyled, TheSameSeedGivesTheSameBytesInEveryThread) {
  const PictureBuffers buffers = BallHead();
  for (const PictureStyle style : AllStyles()) {
    StyleChoice choice = PlainChoice(style);
    choice.lines = LineSource::kBuffers;
    choice.background.kind = BackgroundKind::kClouds;
    daumier::testing::ExpectTheSameFromThreads(1, [&] { return DrawnWith(buffers, choice); });
  }
}

TEST(DrawStyled, FlatDoesNotDependOnTheShade) {
  PictureBuffers buffers = BallHead();
  StyleChoice choice = PlainChoice(PictureStyle::kFlat);
  const Image picture = DrawnWith(buffers, choice);
  for (float& shade : buffers.shade) shade *= 0.3f;
  EXPECT_EQ(DrawnWith(buffers, choice), picture);
  EXPECT_NE(DrawnWith(buffers, PlainChoice(PictureStyle::kSmooth)),
            DrawnWith(BallHead(), PlainChoice(PictureStyle::kSmooth)));
}

TEST(DrawStyled, GreyPicturesHaveEqualChannels) {
  for (const PictureStyle style : AllStyles()) {
    StyleChoice choice = PlainChoice(style);
    choice.saturation = 0;
    choice.tint = {1, 0.9f, 0.8f};
    choice.contrast = 1.1f;
    const Image picture = DrawnWith(BallHead(), choice);
    for (size_t i = 0; i < picture.pixels.size(); i += 3) {
      ASSERT_EQ(picture.pixels[i], picture.pixels[i + 1]) << NameOf(style);
      ASSERT_EQ(picture.pixels[i], picture.pixels[i + 2]) << NameOf(style);
    }
  }
}

TEST(DrawStyled, CoverageSeparatesTheHeadFromItsBackground) {
  for (const int supersampling : {1, 2, 3}) {
    const PictureBuffers buffers = BallHead(64, supersampling);
    const PictureLayers layers = MakePictureLayers(buffers);
    for (const PictureStyle style :
         {PictureStyle::kSmooth, PictureStyle::kToon, PictureStyle::kFlat, PictureStyle::kClay}) {
      const StyleChoice choice = PlainChoice(style);
      StyleChoice other = choice;
      other.background.first = {0.9f, 0.1f, 0.3f};
      const Image first = DrawnWith(buffers, choice), second = DrawnWith(buffers, other);
      for (size_t i = 0; i < layers.size(); ++i) {
        if (layers.coverage.values[i] == 0) {
          ASSERT_EQ(first.pixels[3 * i], 51) << NameOf(style);
          ASSERT_EQ(first.pixels[3 * i + 1], 128) << NameOf(style);
        } else if (layers.coverage.values[i] == 1) {
          for (int channel = 0; channel < 3; ++channel) {
            ASSERT_EQ(first.pixels[3 * i + channel], second.pixels[3 * i + channel]) << NameOf(style);
          }
        }
      }
    }
  }
}

TEST(DrawStyled, AveragesTheSamplesOfAPixel) {
  PictureBuffers buffers = EmptyPictureBuffers(2, 2, 2);
  for (size_t i = 0; i < 3; ++i) {
    buffers.depth[i] = 100;
    buffers.classes[i] = static_cast<uint8_t>(PictureClass::kEyes);
    buffers.parts[i] = static_cast<uint8_t>(PicturePart::kEyeball);
    for (int channel = 0; channel < 3; ++channel) buffers.albedo[3 * i + channel] = 0.2f * static_cast<float>(i);
  }
  StyleChoice choice = PlainChoice(PictureStyle::kFlat);
  choice.background.first = {1, 1, 1};
  // Three of four samples: (0 + 0.2 + 0.4) / 4 + 1 / 4 = 0.4.
  EXPECT_EQ(DrawnWith(buffers, choice).pixels, (std::vector<uint8_t>{102, 102, 102}));
}

TEST(DrawStyled, LinesDarkenTheOutlineAlone) {
  StyleChoice choice = PlainChoice(PictureStyle::kFlat);
  const Image plain = DrawnWith(BallHead(), choice);
  choice.lines = LineSource::kBuffers;
  choice.line_width = 8;
  choice.line_wobble = 0;
  const Image lined = DrawnWith(BallHead(), choice);
  EXPECT_LT(lined.at(32, 8), 60) << "the ball ends at 12 - 9 cm of 24: pixel 8";
  EXPECT_EQ(lined.at(2, 2), plain.at(2, 2));
  EXPECT_EQ(lined.at(48, 32, 1), plain.at(48, 32, 1)) << "chin";
}

TEST(DrawStyled, GivenStrokesAreDrawn) {
  PictureBuffers buffers = BallHead();
  StyleChoice choice = PlainChoice(PictureStyle::kFlat);
  choice.lines = LineSource::kStrokes;
  choice.line_width = 6;
  EXPECT_TRUE(UsesStrokes(choice));
  buffers.lines.push_back({0, {{40, 96}, {88, 96}}});
  const Image picture = DrawnWith(buffers, choice);
  EXPECT_LT(picture.at(48, 32), 60) << "buffers are twice the picture";
  buffers.lines[0].points[1][0] = std::numeric_limits<float>::quiet_NaN();
  ExpectError([&] { DrawnWith(buffers, choice); }, "not finite");
}

TEST(DrawStyled, RefusesBuffersThatDoNotFit) {
  const StyleChoice choice = PlainChoice(PictureStyle::kSmooth);
  const auto refused = [&](auto&& spoil, const std::string& part) {
    PictureBuffers buffers = BallHead();
    spoil(buffers);
    ExpectError([&] { DrawnWith(buffers, choice); }, part);
  };
  refused([](PictureBuffers& b) { b.albedo.pop_back(); }, "albedo");
  refused([](PictureBuffers& b) { b.normal.pop_back(); }, "normal");
  refused([](PictureBuffers& b) { b.shade.push_back(0); }, "shade");
  refused([](PictureBuffers& b) { b.depth.clear(); }, "depth");
  refused([](PictureBuffers& b) { b.classes.pop_back(); }, "classes");
  refused([](PictureBuffers& b) { b.parts.pop_back(); }, "parts");
  refused([](PictureBuffers& b) { b.classes[0] = 8; }, "classes");
  refused([](PictureBuffers& b) { b.parts[0] = 13; }, "parts");
  refused([](PictureBuffers& b) { b.supersampling = 4; }, "supersampling");
  refused([](PictureBuffers& b) { b.supersampling = 3; }, "multiples");
  refused([](PictureBuffers& b) { b.pixels_per_cm = 0; }, "pixels_per_cm");
  refused([](PictureBuffers& b) { b.shade[b.size() / 2 + 64] = NAN; }, "not finite");
  ExpectError([] { EmptyPictureBuffers(0, 4); }, "0 x 4");
}

}  // namespace
}  // namespace daumier::render
