#include "render/styles/backgrounds.h"

#include "core/error.h"
#include "render/styles/dot_screen.h"
#include "render/styles/filled_shapes.h"
#include "render/styles/plane_noise.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

using Tint = std::array<float, 3>;

constexpr std::array<std::string_view, kNumBackgroundKinds> kBackgroundNames = {
    "flat", "gradient", "clouds", "paper", "dots", "stripes", "shapes", "room", "foliage", "hills"};

/// Hue, saturation and value, hue in turns.
Tint ColourOfHue(float hue, float saturation, float value) {
  Tint colour{};
  for (int channel = 0; channel < 3; ++channel) {
    const float place = hue + static_cast<float>(3 - channel) / 3.0f;
    const float t = place - std::floor(place);
    const float wave = std::clamp(std::abs(6 * t - 3) - 1, 0.0f, 1.0f);
    colour[channel] = value * (1 - saturation + saturation * wave);
  }
  return colour;
}

Tint MixedColour(const Tint& from, const Tint& to, float share) {
  Tint colour{};
  for (int channel = 0; channel < 3; ++channel) colour[channel] = from[channel] + share * (to[channel] - from[channel]);
  return colour;
}

Tint ScaledColour(const Tint& colour, float factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

/// One picture's background: its size, colours and random places.
struct BackgroundScene {
  const BackgroundChoice& choice;
  Rng& rng;
  float height, width;
  float unit;  ///< Pixels a 224th of the height, by the choice's scale.
  ColourPlanes& colours;

  float Draw(double low, double high) const { return static_cast<float>(rng.Uniform(low, high)); }
  Tint AnyColour() const {
    const double which = rng.Uniform();
    return which < 0.4 ? choice.first : which < 0.75 ? choice.second : choice.third;
  }
  /// Every pixel between the first and the second colour by weight(x, y).
  template <class Weight>
  void Mix(Weight&& weight) const {
    size_t pixel = 0;
    for (int row = 0; row < colours[0].height; ++row) {
      for (int column = 0; column < colours[0].width; ++column, ++pixel) {
        const float share = weight(static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f);
        for (int channel = 0; channel < 3; ++channel) {
          colours[channel].values[pixel] =
              choice.first[channel] + share * (choice.second[channel] - choice.first[channel]);
        }
      }
    }
  }
  void MixBy(const Plane& weights) const {
    for (int channel = 0; channel < 3; ++channel) {
      for (size_t i = 0; i < weights.values.size(); ++i) {
        colours[channel].values[i] =
            choice.first[channel] + weights.values[i] * (choice.second[channel] - choice.first[channel]);
      }
    }
  }
};

void DrawGradient(const BackgroundScene& scene) {
  const float x = scene.Draw(0.2, 0.8) * scene.width, y = scene.Draw(0.2, 0.8) * scene.height;
  if (scene.rng.Uniform() < 0.5) {
    const float reach = scene.Draw(0.5, 0.9) * scene.height;
    scene.Mix([&](float px, float py) {
      const float dx = (px - x) / reach, dy = (py - y) / reach;
      return std::min(1.0f, dx * dx + dy * dy);
    });
    return;
  }
  const float angle = scene.Draw(0, 6.2831853), across = std::cos(angle) / scene.width,
              down = std::sin(angle) / scene.height;
  scene.Mix([&](float px, float py) {
    return std::clamp(0.5f + across * (px - 0.5f * scene.width) + down * (py - 0.5f * scene.height), 0.0f, 1.0f);
  });
}

void DrawClouds(const BackgroundScene& scene) {
  Plane noise = FractalNoise(scene.colours[0].height, scene.colours[0].width, 60 * scene.unit, 4, scene.rng);
  for (float& value : noise.values) value = std::clamp(0.5f + 0.6f * value, 0.0f, 1.0f);
  scene.MixBy(noise);
}

void DrawPaperSheet(const BackgroundScene& scene) {
  const Plane grain = PaperGrain(scene.colours[0].height, scene.colours[0].width, scene.rng);
  const Plane stains = FractalNoise(scene.colours[0].height, scene.colours[0].width, 90 * scene.unit, 2, scene.rng);
  for (int channel = 0; channel < 3; ++channel) {
    for (size_t i = 0; i < grain.values.size(); ++i) {
      const float light = 0.9f + 0.1f * scene.choice.first[channel];
      scene.colours[channel].values[i] = light * (0.95f + 0.05f * grain.values[i] + 0.015f * stains.values[i]);
    }
  }
}

void DrawDots(const BackgroundScene& scene) {
  const float spacing = scene.Draw(6, 16) * scene.unit, angle = scene.Draw(0, 1.5);
  const float from = scene.Draw(0.1, 0.4), to = scene.Draw(0.1, 0.5);
  const DotScreen screen(std::max(spacing, 3.0f), angle);
  scene.Mix([&](float x, float y) { return screen.Coverage(x, y, from + (to - from) * y / scene.height); });
}

void DrawStripes(const BackgroundScene& scene) {
  if (scene.rng.Uniform() < 0.35) {
    // Rays from behind the head.
    const int num_rays = static_cast<int>(8 + scene.rng.Below(10));
    const float x = scene.Draw(0.35, 0.65) * scene.width, y = scene.Draw(0.35, 0.7) * scene.height,
                turn = scene.Draw(0, 1);
    scene.Mix([&](float px, float py) {
      const float dx = px - x, dy = py - y;
      const float place = std::atan2(dy, dx) * static_cast<float>(num_rays) * 0.15915494f + turn;
      const float wave = std::abs(2 * (place - std::floor(place)) - 1) - 0.5f;
      const float width = std::sqrt(dx * dx + dy * dy) * 3.1415927f / static_cast<float>(num_rays);
      return std::clamp(wave * width + 0.5f, 0.0f, 1.0f);
    });
    return;
  }
  const float period = scene.Draw(10, 40) * scene.unit, angle = scene.Draw(0, 3.1415927), share = scene.Draw(0.2, 0.6);
  const float across = std::cos(angle) / period, down = std::sin(angle) / period,
              bend = scene.rng.Uniform() < 0.3 ? 0.15f : 0.0f;
  scene.Mix([&](float x, float y) {
    float place = across * x + down * y + 100;
    if (bend > 0) place += bend * std::sin((across * y - down * x) * 6.2831853f);
    const float t = place - std::floor(place);
    return std::clamp((share - std::abs(2 * t - 1)) * 0.5f * period + 0.5f, 0.0f, 1.0f);
  });
}

void DrawShapes(const BackgroundScene& scene) {
  const int count = static_cast<int>(6 + scene.rng.Below(14));
  for (int i = 0; i < count; ++i) {
    const Tint colour = MixedColour(scene.AnyColour(), {1, 1, 1}, scene.Draw(0, 0.3));
    const ShapePaint paint{colour, scene.Draw(0.3, 0.95)};
    const float x = scene.Draw(0, 1) * scene.width, y = scene.Draw(0, 1) * scene.height,
                angle = scene.Draw(0, 3.1415927);
    const float size = scene.Draw(8, 50) * scene.unit;
    const double kind = scene.rng.Uniform();
    if (kind < 0.35) {
      FillEllipse(scene.colours, x, y, size, size, 0, paint);
    } else if (kind < 0.7) {
      FillBox(scene.colours, x, y, size, size * scene.Draw(0.3, 1), angle, scene.Draw(0, 10), paint);
    } else {
      FillBox(scene.colours, x, y, 3 * size, scene.Draw(2, 9) * scene.unit, angle, 0, paint);
    }
  }
}

/// A window with bars, or a frame with one colour in it.
void DrawOpening(const BackgroundScene& scene, float x, float y, float half_x, float half_y, const Tint& frame) {
  const float bar = scene.Draw(2.5, 5) * scene.unit;
  FillBox(scene.colours, x, y, half_x + bar, half_y + bar, 0, 1, {frame});
  const bool is_window = scene.rng.Uniform() < 0.6;
  const Tint inside = is_window ? MixedColour({0.8f, 0.92f, 1.0f}, scene.choice.third, 0.25f) : scene.choice.third;
  FillBox(scene.colours, x, y, half_x, half_y, 0, 0, {inside});
  if (!is_window) {
    FillBox(scene.colours, x, y + 0.4f * half_y, half_x, 0.6f * half_y, 0, 0,
            {ScaledColour(scene.choice.second, 0.9f)});
    return;
  }
  FillBox(scene.colours, x, y, 0.35f * bar, half_y, 0, 0, {frame});
  FillBox(scene.colours, x, y - 0.1f * half_y, half_x, 0.35f * bar, 0, 0, {frame});
}

void DrawRoom(const BackgroundScene& scene) {
  const float fall = scene.Draw(-0.2, 0.2);
  scene.Mix([&](float x, float y) {
    return std::clamp(0.15f + 0.25f * y / scene.height + fall * x / scene.width, 0.0f, 0.5f);
  });
  const Tint wood = MixedColour({0.45f, 0.32f, 0.22f}, scene.choice.third, 0.3f);
  const float floor_row = scene.Draw(0.72, 0.95) * scene.height;
  FillBox(scene.colours, 0.5f * scene.width, scene.height + floor_row, scene.width, scene.height, 0, 0,
          {ScaledColour(wood, 0.85f)});
  FillBox(scene.colours, 0.5f * scene.width, floor_row, scene.width, 2.5f * scene.unit, 0, 0,
          {ScaledColour(wood, 1.25f)});
  const bool window_left = scene.rng.Uniform() < 0.5;
  const float side = window_left ? scene.Draw(0.05, 0.25) : scene.Draw(0.75, 0.95);
  DrawOpening(scene, side * scene.width, scene.Draw(0.2, 0.4) * scene.height, scene.Draw(18, 34) * scene.unit,
              scene.Draw(26, 44) * scene.unit, MixedColour({0.95f, 0.93f, 0.9f}, wood, scene.Draw(0, 0.8)));
  const float other = (1 - side) * scene.width, shelf_row = scene.Draw(0.4, 0.65) * scene.height;
  if (scene.rng.Uniform() < 0.6) {
    const float half = scene.Draw(30, 50) * scene.unit;
    FillBox(scene.colours, other, shelf_row, half, 2 * scene.unit, 0, 0, {wood});
    for (float x = other - half + 3 * scene.unit; x < other + half - 8 * scene.unit;) {
      const float book = scene.Draw(2, 4.5) * scene.unit, high = scene.Draw(9, 16) * scene.unit;
      const Tint colour = MixedColour(scene.AnyColour(), ColourOfHue(scene.Draw(0, 1), 0.5f, 0.6f), 0.6f);
      FillBox(scene.colours, x + book, shelf_row - high - 2 * scene.unit, book, high, 0, 1, {colour});
      x += 2 * book + (scene.rng.Uniform() < 0.15 ? 8 * scene.unit : 0.6f * scene.unit);
    }
  } else {
    DrawOpening(scene, other, shelf_row - 30 * scene.unit, scene.Draw(14, 24) * scene.unit,
                scene.Draw(14, 24) * scene.unit, wood);
  }
}

void DrawFoliage(const BackgroundScene& scene) {
  scene.Mix([&](float, float y) { return y / scene.height; });
  const float hue = scene.Draw(0.2, 0.42);
  for (int layer = 0; layer < 3; ++layer) {
    const float depth = static_cast<float>(layer) / 2;  // From far to near: smaller and paler to larger and darker.
    const int count = 60 - 10 * layer;
    for (int i = 0; i < count; ++i) {
      const float value = scene.Draw(0.3, 0.7) * (1 - 0.35f * depth);
      const Tint leaf = MixedColour(ColourOfHue(hue + scene.Draw(-0.05, 0.05), scene.Draw(0.35, 0.7), value),
                                    scene.choice.first, 0.4f * (1 - depth));
      const float size = scene.Draw(7, 15) * scene.unit * (0.8f + 0.9f * depth);
      const float x = scene.Draw(0, 1) * scene.width, high = scene.Draw(0, 1);
      const float y = scene.height * (0.1f + 0.25f * depth + (0.9f - 0.2f * depth) * high);
      FillEllipse(scene.colours, x, y, size, size * scene.Draw(0.35, 0.7), scene.Draw(0, 3.1415927), {leaf, 0.9f});
    }
  }
}

void DrawHills(const BackgroundScene& scene) {
  const Tint sky = MixedColour(scene.choice.first, {0.6f, 0.8f, 1.0f}, 0.5f);
  const Plane clouds = FractalNoise(scene.colours[0].height, scene.colours[0].width, 45 * scene.unit, 3, scene.rng);
  for (int row = 0; row < scene.colours[0].height; ++row) {
    const float low = static_cast<float>(row) / scene.height;
    for (int column = 0; column < scene.colours[0].width; ++column) {
      const float white = std::min(1.0f, 0.45f * low + std::clamp(1.6f * clouds.at(row, column) - 0.2f, 0.0f, 0.7f));
      for (int channel = 0; channel < 3; ++channel) {
        scene.colours[channel].at(row, column) = sky[channel] + white * (0.97f - sky[channel]);
      }
    }
  }
  const int num_layers = static_cast<int>(2 + scene.rng.Below(3));
  std::vector<float> top(scene.colours[0].width);
  const float hue = scene.Draw(0.2, 0.6);
  for (int layer = 0; layer < num_layers; ++layer) {
    const float near = static_cast<float>(layer + 1) / static_cast<float>(num_layers);
    const float base = scene.height * (0.45f + 0.4f * near), swell = scene.Draw(8, 26) * scene.unit;
    const float first = scene.Draw(0, 6.28), second = scene.Draw(0, 6.28), wave = scene.Draw(30, 60) * scene.unit;
    for (size_t column = 0; column < top.size(); ++column) {
      const float place = static_cast<float>(column) / wave;
      top[column] = base + swell * (std::sin(place + first) + 0.4f * std::sin(2.3f * place + second));
    }
    FillBelow(scene.colours, top, {MixedColour(sky, ColourOfHue(hue, 0.5f, 0.45f), 0.3f + 0.6f * near)});
  }
}

}  // namespace

std::string_view NameOf(BackgroundKind kind) {
  return kBackgroundNames[static_cast<size_t>(kind)];
}

BackgroundChoice DrawBackgroundChoice(Rng& rng, double busy) {
  constexpr std::array<BackgroundKind, 3> kPlain = {BackgroundKind::kFlat, BackgroundKind::kGradient,
                                                    BackgroundKind::kPaper};
  constexpr std::array<BackgroundKind, 7> kBusy = {
      BackgroundKind::kClouds, BackgroundKind::kDots,    BackgroundKind::kStripes, BackgroundKind::kShapes,
      BackgroundKind::kRoom,   BackgroundKind::kFoliage, BackgroundKind::kHills};
  BackgroundChoice choice;
  choice.kind = rng.Uniform() < busy ? kBusy[rng.Below(kBusy.size())] : kPlain[rng.Below(kPlain.size())];
  const auto draw = [&](double low, double high) { return static_cast<float>(rng.Uniform(low, high)); };
  // Neighbours, opposites or thirds on the circle of hues.
  constexpr std::array<float, 4> kSteps = {0.07f, 0.12f, 0.33f, 0.5f};
  const float hue = draw(0, 1), step = kSteps[rng.Below(kSteps.size())] * (rng.Uniform() < 0.5 ? -1.0f : 1.0f);
  const double mood = rng.Uniform();  // Pale, muted, bright, dark.
  const float saturation = mood < 0.3 ? draw(0.03, 0.2) : mood < 0.6 ? draw(0.15, 0.45) : draw(0.3, 0.85);
  const float value = mood < 0.3 ? draw(0.85, 1) : mood < 0.85 ? draw(0.55, 0.97) : draw(0.12, 0.4);
  choice.first = ColourOfHue(hue, saturation, value);
  choice.second =
      ColourOfHue(hue + step * draw(0.5, 1), saturation * draw(0.6, 1.1), std::min(1.0f, value * draw(0.6, 1.15)));
  choice.third = ColourOfHue(hue - step, saturation * draw(0.5, 1.2), std::min(1.0f, value * draw(0.8, 1.3)));
  if (rng.Uniform() < 0.12) choice.first = {1, 1, 1};
  choice.scale = draw(0.7, 1.5);
  const bool is_scene = choice.kind == BackgroundKind::kRoom || choice.kind == BackgroundKind::kFoliage ||
                        choice.kind == BackgroundKind::kHills || choice.kind == BackgroundKind::kShapes;
  choice.blur = is_scene && rng.Uniform() < 0.6 ? draw(1, 6) : 0.0f;
  return choice;
}

ColourPlanes DrawBackground(const BackgroundChoice& choice, int height, int width, Rng& rng) {
  DAUMIER_CHECK(height > 0 && width > 0, "a background of {} x {} pixels", height, width);
  ColourPlanes colours = MakeColourPlanes(height, width, choice.first);
  const float pixels = static_cast<float>(height) / 224.0f;
  const BackgroundScene scene{choice, rng, static_cast<float>(height), static_cast<float>(width), pixels * choice.scale,
                              colours};
  switch (choice.kind) {
    case BackgroundKind::kFlat:
      break;
    case BackgroundKind::kGradient:
      DrawGradient(scene);
      break;
    case BackgroundKind::kClouds:
      DrawClouds(scene);
      break;
    case BackgroundKind::kPaper:
      DrawPaperSheet(scene);
      break;
    case BackgroundKind::kDots:
      DrawDots(scene);
      break;
    case BackgroundKind::kStripes:
      DrawStripes(scene);
      break;
    case BackgroundKind::kShapes:
      DrawShapes(scene);
      break;
    case BackgroundKind::kRoom:
      DrawRoom(scene);
      break;
    case BackgroundKind::kFoliage:
      DrawFoliage(scene);
      break;
    case BackgroundKind::kHills:
      DrawHills(scene);
      break;
  }
  if (choice.blur > 0) {
    for (Plane& plane : colours) plane = Blur(plane, choice.blur * pixels);
  }
  return colours;
}

}  // namespace daumier::render
