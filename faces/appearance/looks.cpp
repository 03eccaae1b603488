#include "faces/appearance/looks.h"

#include "faces/appearance/albedo_basis.h"
#include "faces/appearance/skin_tone.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {
namespace {

using Colour = Eigen::Vector3f;

const std::array<Colour, 9> kNaturalHair = {{{0.09f, 0.07f, 0.06f},
                                             {0.16f, 0.11f, 0.08f},
                                             {0.26f, 0.17f, 0.11f},
                                             {0.38f, 0.25f, 0.15f},
                                             {0.50f, 0.34f, 0.19f},
                                             {0.68f, 0.50f, 0.28f},
                                             {0.86f, 0.72f, 0.45f},
                                             {0.56f, 0.25f, 0.12f},
                                             {0.72f, 0.36f, 0.16f}}};
const std::array<Colour, 6> kDyedHair = {{{0.25f, 0.45f, 0.80f},
                                          {0.90f, 0.45f, 0.65f},
                                          {0.35f, 0.65f, 0.40f},
                                          {0.55f, 0.32f, 0.70f},
                                          {0.80f, 0.18f, 0.20f},
                                          {0.30f, 0.70f, 0.72f}}};
const std::array<Colour, 7> kIrises = {{{0.24f, 0.14f, 0.08f},
                                        {0.38f, 0.23f, 0.11f},
                                        {0.50f, 0.36f, 0.16f},
                                        {0.36f, 0.48f, 0.24f},
                                        {0.26f, 0.45f, 0.68f},
                                        {0.45f, 0.55f, 0.62f},
                                        {0.22f, 0.55f, 0.50f}}};

/// Of normal numbers, cut.
double NormalWithin(Rng& rng, double limit) {
  return std::clamp(rng.Normal(), -limit, limit);
}

/// A colour of any hue, as of cloth.
Colour ClothColour(Rng& rng) {
  const double hue = rng.Uniform(0, 6), saturation = rng.Uniform(0.1, 0.8), value = rng.Uniform(0.15, 0.9);
  Colour colour;
  for (int k = 0; k < 3; ++k) {
    const double away = std::abs(std::remainder(hue - 2.0 * k, 6.0));
    colour[k] = float(value * (1 - saturation * std::clamp(away - 1, 0.0, 1.0)));
  }
  return colour;
}

Colour Varied(const Colour& colour, double spread, Rng& rng) {
  Colour varied = colour * float(std::exp(spread * NormalWithin(rng, 2)));
  for (int k = 0; k < 3; ++k) varied[k] += float(0.2 * spread * NormalWithin(rng, 2) * 0.3);
  return varied.cwiseMax(0.02f).cwiseMin(0.97f);
}

HairStyle DrawHairStyle(double long_hair, double age, Rng& rng) {
  struct Entry {
    HairStyle style;
    double short_share, long_share;
  };
  using enum HairStyle;
  constexpr std::array<Entry, 10> kEntries = {{{kShort, 4, 0.7},
                                               {kParted, 2.5, 1},
                                               {kFringe, 1.5, 1},
                                               {kSpiky, 1.5, 0.3},
                                               {kCurly, 1.5, 1.5},
                                               {kReceding, 1, 0},
                                               {kBob, 0.1, 2.5},
                                               {kLong, 0.3, 3},
                                               {kBun, 0.1, 1.5},
                                               {kPonytail, 0.1, 1.3}}};
  double total = 0;
  std::array<double, kEntries.size()> shares{};
  for (size_t k = 0; k < kEntries.size(); ++k) {
    shares[k] = (1 - long_hair) * kEntries[k].short_share + long_hair * kEntries[k].long_share;
    if (kEntries[k].style == kReceding) shares[k] *= 4 * age;
    total += shares[k];
  }
  double draw = rng.Uniform(0, total);
  for (size_t k = 0; k < kEntries.size(); ++k) {
    draw -= shares[k];
    if (draw < 0) return kEntries[k].style;
  }
  return kShort;
}

void DrawAlbedo(const LooksOptions& options, double feminine, Rng& rng, Looks& looks) {
  looks.albedo.resize(kNumAlbedoModes);
  for (int k = 0; k < kNumAlbedoModes; ++k) looks.albedo[k] = float(NormalWithin(rng, 2.5));
  const bool even = rng.Uniform() < options.even_tones;
  const int tone = int(rng.Below(kNumSkinTones));
  if (even) looks.albedo[0] = float(MelaninOfTone(tone) + 0.15 * NormalWithin(rng, 2));
  looks.albedo[0] = std::max(looks.albedo[0], MelaninOfTone(0) - 0.3f);
  const auto move = [&](const char* mode, double share, double offset) {
    float& a = looks.albedo[AlbedoMode(mode)];
    a = float(std::clamp(share * a + offset, -3.0, 3.0));
  };
  const bool makeup = rng.Uniform() < options.makeup * 2 * feminine;
  if (makeup) {
    move("lips_red", 0.8, 1.6);
    move("blush", 0.8, 0.8);
    move("lid_line", 0.6, 1.0);
  }
  // Freckles are there or not; on dark skin colours differ less.
  const bool freckled = rng.Uniform() < 0.15;
  for (const char* mode : {"freckles", "fine_freckles"}) move(mode, freckled ? 0.5 : 0.2, freckled ? 1.6 : 0.0);
  const double darkness = std::clamp(double(looks.albedo[0]) / 2.5, 0.0, 1.0);
  for (int k = 1; k < kNumAlbedoModes; ++k) looks.albedo[k] *= float(1 - 0.45 * darkness);
  const double lines = 2.6 * looks.age - 1.0;
  for (const char* mode : {"nasolabial_lines", "forehead_lines", "eye_bags"}) move(mode, 0.7, lines);
  const double stubble = 0.7 - 1.6 * feminine;
  for (const char* mode : {"beard_shadow", "moustache_shadow"}) move(mode, 0.8, stubble);
}

Colour DrawHairColour(const LooksOptions& options, Rng& rng, const Looks& looks) {
  const bool dyed = rng.Uniform() < options.unnatural_hair;
  // Dark skin mostly has dark hair.
  const double dark = 1 / (1 + std::exp(-1.8 * (double(looks.albedo[0]) - 0.2)));
  const int lightest = rng.Uniform() < dark ? 3 : int(kNaturalHair.size());
  const Colour natural = Varied(kNaturalHair[rng.Below(uint64_t(lightest))], 0.12, rng);
  const Colour dye = Varied(kDyedHair[rng.Below(kDyedHair.size())], 0.1, rng);
  const double grey = std::clamp((looks.age - 0.55) / 0.35, 0.0, 1.0) * rng.Uniform(0.3, 1.1);
  if (dyed) return dye;
  const auto lightness = float(rng.Uniform(0.55, 0.92));
  return natural + float(std::min(1.0, grey)) * (Colour(lightness, lightness, 1.02f * lightness) - natural);
}

}  // namespace

Looks DrawLooks(Rng& rng, const LooksOptions& options) {
  Looks looks;
  const double feminine = rng.Uniform();
  const bool is_old = rng.Uniform() < options.old;
  looks.age = is_old ? rng.Uniform(0.65, 1.0) : rng.Uniform(0.0, 0.6);
  DrawAlbedo(options, feminine, rng, looks);

  const bool bald = rng.Uniform() < options.bald;
  const HairStyle style = DrawHairStyle(feminine, looks.age, rng);
  looks.hair = bald ? HairStyle::kBald : style;
  looks.hair_colour = DrawHairColour(options, rng, looks);
  looks.hair_volume = std::exp(0.22 * NormalWithin(rng, 2));
  looks.hair_length = std::exp(0.2 * NormalWithin(rng, 2));
  looks.hair_fringe = rng.Uniform() < 0.45 ? 0.0 : rng.Uniform(0.1, 1.0);
  looks.hair_parting = rng.Uniform(-1, 1);
  looks.detail_seed = rng.Bits();

  looks.brow_colour = (0.78f * looks.hair_colour + Colour::Constant(0.02f)) * float(rng.Uniform(0.6, 1.0));
  if (looks.hair_colour.sum() > 1.5f) looks.brow_colour *= 0.75f;
  looks.brow_thickness = std::clamp((1.5 - 0.55 * feminine) * std::exp(0.25 * NormalWithin(rng, 2)), 0.5, 1.9);
  looks.brow_arch = std::clamp(0.4 * NormalWithin(rng, 2) + 0.3 * feminine, -1.0, 1.0);
  looks.albedo[AlbedoMode("brows_darkness")] =
      float(1.6 - 3.5 * double(looks.brow_colour.mean()) + 0.5 * NormalWithin(rng, 2));
  looks.lash_length = feminine < 0.35 ? rng.Uniform(0.0, 0.6) : rng.Uniform(0.5, 1.8);
  looks.lid_line = rng.Uniform() < 0.4 + 0.4 * feminine ? rng.Uniform(0.1, 0.9) : 0.0;

  looks.iris_colour = Varied(kIrises[rng.Below(looks.albedo[0] > 0.6f ? 3 : kIrises.size())], 0.15, rng);
  looks.iris_size = std::exp(0.12 + 0.12 * NormalWithin(rng, 2));
  looks.pupil_size = std::exp(0.15 * NormalWithin(rng, 2));
  const bool gazes = rng.Uniform() < options.gaze;
  const double yaw = 0.16 * NormalWithin(rng, 2.2), pitch = 0.09 * NormalWithin(rng, 2.2);
  if (gazes) looks.gaze_yaw = yaw, looks.gaze_pitch = pitch;
  looks.highlights = int(rng.Below(3));

  const bool beard = rng.Uniform() < options.beards * 2 * (1 - feminine);
  const auto beard_style = static_cast<BeardStyle>(1 + rng.Below(kBeardStyleNames.size() - 1));
  if (beard) looks.beard = beard_style;
  looks.beard_colour = Varied(looks.hair_colour, 0.12, rng) * 0.95f;
  looks.beard_length = std::exp(0.25 * NormalWithin(rng, 2));

  const bool hat = rng.Uniform() < options.hats;
  const auto hat_style = static_cast<HatStyle>(1 + rng.Below(kHatStyleNames.size() - 1));
  if (hat) looks.hat = hat_style;
  looks.hat_colour = ClothColour(rng);
  looks.hat_band = ClothColour(rng);
  const bool glasses = rng.Uniform() < options.glasses, dark = rng.Uniform() < options.dark_glasses;
  const auto glasses_style = rng.Uniform() < 0.5 ? GlassesStyle::kRound : GlassesStyle::kSquare;
  if (glasses) looks.glasses = dark ? GlassesStyle::kDark : glasses_style;
  looks.glasses_colour = ClothColour(rng) * float(rng.Uniform(0.1, 1.0));
  looks.collar = static_cast<CollarStyle>(rng.Below(kCollarStyleNames.size()));
  looks.clothes_colour = ClothColour(rng);
  return looks;
}

}  // namespace daumier::faces
