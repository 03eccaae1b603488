#include "render/styles/backgrounds.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::render {
namespace {

std::vector<BackgroundKind> AllKinds() {
  std::vector<BackgroundKind> kinds;
  for (int kind = 0; kind < kNumBackgroundKinds; ++kind) kinds.push_back(static_cast<BackgroundKind>(kind));
  return kinds;
}

Image DrawnBackground(const BackgroundChoice& choice, int height, int width, uint64_t seed) {
  Rng rng(seed);
  return ToImage(DrawBackground(choice, height, width, rng));
}

TEST(DrawBackground, EveryKindIsDrawnInEverySizeAndByItsSeed) {
  std::set<std::string_view> names;
  for (const BackgroundKind kind : AllKinds()) {
    BackgroundChoice choice;
    choice.kind = kind;
    names.insert(NameOf(kind));
    for (const auto& [height, width] : {std::pair{64, 48}, {31, 77}, {1, 1}}) {
      const Image picture = DrawnBackground(choice, height, width, 7);
      EXPECT_EQ(picture.height, height);
      EXPECT_EQ(picture.width, width);
      EXPECT_EQ(picture, DrawnBackground(choice, height, width, 7)) << NameOf(kind);
    }
    if (kind != BackgroundKind::kFlat) {
      EXPECT_NE(DrawnBackground(choice, 64, 48, 7), DrawnBackground(choice, 64, 48, 8)) << NameOf(kind);
    }
  }
  EXPECT_EQ(names.size(), size_t(kNumBackgroundKinds));
}

TEST(DrawBackground, FlatIsItsColour) {
  BackgroundChoice choice;
  choice.first = {1, 0.2f, 0};
  const Image picture = DrawnBackground(choice, 2, 1, 1);
  EXPECT_EQ(picture.pixels, (std::vector<uint8_t>{255, 51, 0, 255, 51, 0}));
}

TEST(DrawBackground, RefusesAnEmptyPicture) {
  Rng rng(1);
  daumier::testing::ExpectError([&] { DrawBackground({}, 0, 5, rng); }, "0 x 5");
}

TEST(DrawBackgroundChoice, BusyIsTheShareOfKindsWithSomethingInThem) {
  Rng rng(2);
  for (const double busy : {0.0, 1.0}) {
    std::set<BackgroundKind> kinds;
    for (int i = 0; i < 200; ++i) {
      const BackgroundChoice choice = DrawBackgroundChoice(rng, busy);
      kinds.insert(choice.kind);
      for (const auto& colour : {choice.first, choice.second, choice.third}) {
        for (const float value : colour) {
          EXPECT_GE(value, 0);
          EXPECT_LE(value, 1);
        }
      }
    }
    EXPECT_EQ(kinds.count(BackgroundKind::kFlat) + kinds.count(BackgroundKind::kPaper), busy == 0 ? 2u : 0u);
    EXPECT_EQ(kinds.size(), busy == 0 ? 3u : 7u);
  }
}

}  // namespace
}  // namespace daumier::render
