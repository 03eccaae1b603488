#include "faces/appearance/looks.h"

#include "faces/appearance/albedo_basis.h"
#include "faces/appearance/skin_tone.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace daumier::faces {
namespace {

constexpr int kManyLooks = 3000;

TEST(Looks, AreDrawnInTheirSharesAndRanges) {
  LooksOptions options;
  int hats = 0, glasses = 0, bald = 0, beards = 0;
  std::array<int, kHairStyleNames.size()> styles{};
  for (int i = 0; i < kManyLooks; ++i) {
    Rng rng = Stream(5, "looks", uint64_t(i));
    const Looks looks = DrawLooks(rng, options);
    hats += looks.hat != HatStyle::kNone;
    glasses += looks.glasses != GlassesStyle::kNone;
    beards += looks.beard != BeardStyle::kNone;
    bald += looks.hair == HairStyle::kBald;
    ++styles[size_t(looks.hair)];
    ASSERT_EQ(looks.albedo.size(), kNumAlbedoModes);
    EXPECT_LE(looks.albedo.cwiseAbs().maxCoeff(), 4.0f);
    for (const auto& colour : {looks.hair_colour, looks.brow_colour, looks.iris_colour, looks.hat_colour,
                               looks.clothes_colour, looks.beard_colour, looks.glasses_colour}) {
      EXPECT_GE(colour.minCoeff(), 0);
      EXPECT_LE(colour.maxCoeff(), 1);
    }
    EXPECT_LE(std::abs(looks.gaze_yaw), 0.5);
  }
  EXPECT_NEAR(double(hats) / kManyLooks, options.hats, 0.02);
  EXPECT_NEAR(double(glasses) / kManyLooks, options.glasses, 0.02);
  EXPECT_NEAR(double(beards) / kManyLooks, options.beards, 0.025);
  EXPECT_NEAR(double(bald) / kManyLooks, options.bald, 0.02);
  for (size_t s = 0; s < styles.size(); ++s) EXPECT_GT(styles[s], kManyLooks / 200) << kHairStyleNames[s];
}

TEST(Looks, OfOneOrNoneAreAllOrNobody) {
  LooksOptions options;
  options.bald = options.hats = options.glasses = options.dark_glasses = 1;
  options.beards = 0;
  options.even_tones = 1;
  std::array<int, kNumSkinTones> tones{};
  for (int i = 0; i < 600; ++i) {
    Rng rng = Stream(6, "looks", uint64_t(i));
    const Looks looks = DrawLooks(rng, options);
    EXPECT_EQ(looks.hair, HairStyle::kBald);
    EXPECT_NE(looks.hat, HatStyle::kNone);
    EXPECT_EQ(looks.glasses, GlassesStyle::kDark);
    EXPECT_EQ(looks.beard, BeardStyle::kNone);
    ++tones[size_t(SkinToneOf(looks.albedo))];
  }
  for (const int count : tones) EXPECT_NEAR(count, 100, 45);
}

TEST(Looks, OfOneSeedAreTheSame) {
  Rng a(9), b(9);
  const Looks first = DrawLooks(a), second = DrawLooks(b);
  EXPECT_EQ(first.albedo, second.albedo);
  EXPECT_EQ(first.hair_colour, second.hair_colour);
  EXPECT_EQ(first.detail_seed, second.detail_seed);
  EXPECT_EQ(a.state(), b.state());
}

TEST(Looks, OptionsAreParsed) {
  const auto options = ParseOptions<LooksOptions>(Json{{"hats", 0.5}});
  EXPECT_EQ(options.hats, 0.5);
  EXPECT_EQ(options.bald, LooksOptions{}.bald);
}

}  // namespace
}  // namespace daumier::faces
