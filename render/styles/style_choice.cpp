#include "render/styles/style_choice.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr std::array<std::string_view, kNumPictureStyles> kStyleNames = {
    "smooth", "toon", "flat", "ink", "painterly", "pencil", "watercolour", "halftone", "clay"};

float Between(Rng& rng, double low, double high) {
  return static_cast<float>(rng.Uniform(low, high));
}

bool Happens(Rng& rng, double share) {
  return rng.Uniform() < share;
}

PictureStyle DrawStyle(Rng& rng, const StyleOptions& options) {
  const std::array<double, kNumPictureStyles> shares = {options.smooth,      options.toon,      options.flat,
                                                        options.ink,         options.painterly, options.pencil,
                                                        options.watercolour, options.halftone,  options.clay};
  double total = 0;
  for (const double share : shares) total += share;
  if (!(total > 0)) throw UsageError("all shares of styles are 0; give one of them a positive share");
  double left = rng.Uniform() * total;
  int last = 0;
  for (int style = 0; style < kNumPictureStyles; ++style) {
    if (shares[style] <= 0) continue;
    last = style;
    left -= shares[style];
    if (left < 0) break;
  }
  return static_cast<PictureStyle>(last);
}

void DrawLight(Rng& rng, StyleChoice& choice) {
  choice.key = Between(rng, 0.05, 0.45);
  choice.rim = Happens(rng, 0.6) ? Between(rng, 0.1, 0.7) : 0.0f;
  choice.gloss = Between(rng, 0.15, 1.0);
  choice.occlusion = Between(rng, 0.15, 0.6);
  choice.shadows = Happens(rng, 0.8) ? Between(rng, 0.15, 0.5) : 0.0f;
  choice.warm_shade = Between(rng, 0.2, 0.9);
}

void DrawBands(Rng& rng, StyleChoice& choice) {
  const double kind = rng.Uniform();
  choice.bands = kind < 0.6 ? 2 : kind < 0.9 ? 3 : 4;
  choice.band_softness = Happens(rng, 0.75) ? Between(rng, 0.02, 0.06) : Between(rng, 0.1, 0.3);
  choice.band_depth = Between(rng, 0.12, 0.36);
  constexpr std::array<std::array<float, 3>, 5> kHues = {{{1.00f, 0.86f, 0.86f},
                                                          {0.92f, 0.84f, 1.00f},
                                                          {1.00f, 0.88f, 0.78f},
                                                          {0.88f, 0.92f, 1.00f},
                                                          {1.00f, 0.97f, 0.95f}}};
  choice.shadow_hue = kHues[rng.Below(kHues.size())];
}

void DrawLines(Rng& rng, const StyleOptions& options, double share, StyleChoice& choice) {
  if (!Happens(rng, share)) return;
  choice.lines = Happens(rng, options.strokes) ? LineSource::kStrokes : LineSource::kBuffers;
  choice.line_width = Happens(rng, 0.2) ? Between(rng, 2.0, 3.2) : Between(rng, 0.9, 2.0);
  choice.line_variation = Between(rng, 0.3, 1.0);
  choice.line_wobble = Happens(rng, 0.5) ? Between(rng, 0.1, 0.6) : 0.0f;
  if (Happens(rng, 0.35)) choice.line_tint = Between(rng, 0.6, 1.0);
  if (Happens(rng, 0.2))
    choice.line_colour = {Between(rng, 0.1, 0.3), Between(rng, 0.06, 0.15), Between(rng, 0.05, 0.2)};
}

void DrawPaper(Rng& rng, StyleChoice& choice) {
  const float light = Between(rng, 0.88, 1.0), warm = Between(rng, -0.01, 0.08);
  choice.paper = {light, light - 0.3f * warm, light - warm};
}

void DrawMedia(Rng& rng, const StyleOptions& options, StyleChoice& choice) {
  choice.angle = Between(rng, 0.3, 1.2) * (Happens(rng, 0.7) ? 1.0f : -1.0f);
  switch (choice.style) {
    case PictureStyle::kPainterly:
      choice.brush = Between(rng, 1.8, 4.2);
      choice.key += 0.1f;
      DrawLines(rng, options, 0.2 * options.lines, choice);
      break;
    case PictureStyle::kPencil:
      choice.screen = Between(rng, 2.2, 4.0);
      choice.coloured = Happens(rng, 0.45) ? 1.0f : 0.0f;
      choice.key += 0.2f;
      DrawLines(rng, options, 1, choice);
      choice.line_width = Between(rng, 0.8, 1.6);
      choice.line_tint = 0;
      choice.line_colour = {0.16f, 0.16f, 0.17f};
      break;
    case PictureStyle::kInk:
      choice.screen = Between(rng, 2.8, 4.5);
      choice.coloured = Happens(rng, 0.4) ? Between(rng, 0.5, 1.0) : 0.0f;
      DrawLines(rng, options, 1, choice);
      choice.line_tint = 0;
      break;
    case PictureStyle::kWatercolour:
      choice.bands = static_cast<int>(2 + rng.Below(3));
      choice.band_softness = Between(rng, 0.08, 0.35);
      DrawLines(rng, options, options.lines, choice);
      choice.line_width *= 0.75f;
      break;
    case PictureStyle::kHalftone: {
      choice.screens = static_cast<ScreenKind>(rng.Below(3));
      choice.screen = choice.screens == ScreenKind::kShadows ? Between(rng, 3.5, 6.0) : Between(rng, 2.4, 3.8);
      DrawLines(rng, options, options.lines, choice);
      break;
    }
    case PictureStyle::kToon:
      DrawLines(rng, options, options.lines, choice);
      break;
    case PictureStyle::kFlat:
      // Without lines nothing shows the nose.
      DrawLines(rng, options, std::min(1.0, 1.2 * options.lines), choice);
      break;
    case PictureStyle::kSmooth:
    case PictureStyle::kClay:
      break;
  }
}

void DrawClay(Rng& rng, StyleChoice& choice) {
  constexpr std::array<std::array<float, 3>, 6> kClays = {{{0.72f, 0.72f, 0.72f},
                                                           {0.80f, 0.74f, 0.68f},
                                                           {0.66f, 0.69f, 0.74f},
                                                           {0.88f, 0.87f, 0.85f},
                                                           {0.72f, 0.50f, 0.40f},
                                                           {0.52f, 0.53f, 0.55f}}};
  choice.clay = kClays[rng.Below(kClays.size())];
  choice.gloss = Happens(rng, 0.5) ? 0.0f : Between(rng, 0.1, 0.6);
  choice.warm_shade = 0;
  choice.occlusion = Between(rng, 0.3, 0.8);
}

void DrawGrade(Rng& rng, const StyleOptions& options, StyleChoice& choice) {
  const bool is_grey = Happens(rng, options.grey);
  choice.saturation = is_grey ? 0.0f : Between(rng, 0.8, 1.3);
  choice.contrast = Between(rng, 0.9, 1.18);
  choice.brightness = Between(rng, -0.04, 0.06);
  const float warm = Happens(rng, 0.3) ? Between(rng, -0.1, 0.1) : 0.0f;
  choice.tint = {1 + std::min(warm, 0.0f), 1 - 0.4f * std::abs(warm), 1 - std::max(warm, 0.0f)};
}

bool IsOnPaper(PictureStyle style) {
  return style == PictureStyle::kPencil || style == PictureStyle::kInk || style == PictureStyle::kWatercolour;
}

}  // namespace

std::string_view NameOf(PictureStyle style) {
  return kStyleNames[static_cast<size_t>(style)];
}

std::string StyleName(const StyleChoice& choice) {
  return std::string(NameOf(choice.style)) + (choice.saturation == 0 ? "_grey" : "");
}

bool UsesStrokes(const StyleChoice& choice) {
  return choice.lines == LineSource::kStrokes && choice.line_width > 0;
}

StyleChoice DrawStyleChoice(Rng& rng, const StyleOptions& options) {
  StyleChoice choice;
  choice.style = DrawStyle(rng, options);
  DrawLight(rng, choice);
  DrawBands(rng, choice);
  DrawPaper(rng, choice);
  if (choice.style == PictureStyle::kClay) DrawClay(rng, choice);
  DrawMedia(rng, options, choice);
  DrawGrade(rng, options, choice);
  choice.background = DrawBackgroundChoice(rng, options.busy_background);
  if (IsOnPaper(choice.style) && Happens(rng, 0.65)) {
    choice.background.kind = BackgroundKind::kFlat;
    choice.background.first = {1, 1, 1};
  }
  if (choice.style == PictureStyle::kClay && Happens(rng, 0.7)) {
    choice.background.kind = Happens(rng, 0.5) ? BackgroundKind::kFlat : BackgroundKind::kGradient;
    const float level = Between(rng, 0.15, 0.95), other = Between(rng, 0.15, 0.95);
    choice.background.first = {level, level, level};
    choice.background.second = {other, other, other};
  }
  return choice;
}

}  // namespace daumier::render
