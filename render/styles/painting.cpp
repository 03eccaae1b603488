#include "render/styles/painting.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr float kColourReach = 0.13f;  ///< Difference from a stroke's colour at which it ends.
constexpr float kDetail = 0.05f;       ///< Difference of brightness that wants fine strokes.
constexpr int kNumBristles = 64;

struct BrushStroke {
  float x, y, along_x, along_y, length, width;
  std::array<float, 3> colour;
  int bristle;
};

/// Ridges across a brush, some strong, for all strokes; each begins at another one.
std::array<float, kNumBristles> DrawBristles(Rng& rng) {
  std::array<float, kNumBristles> bristles{};
  for (float& value : bristles) value = static_cast<float>(rng.Uniform());
  return bristles;
}

/// Largest difference of brightness between a pixel and those two pixels away.
Plane DetailOf(const ColourPlanes& picture) {
  const Plane luma = Luma(picture);
  Plane detail(luma.height, luma.width);
  for (int row = 2; row + 2 < luma.height; ++row) {
    const float *above = luma.row(row - 2), *here = luma.row(row), *below = luma.row(row + 2);
    float* target = detail.row(row);
    for (int column = 2; column + 2 < luma.width; ++column) {
      target[column] = std::max(std::abs(here[column + 2] - here[column - 2]), std::abs(below[column] - above[column]));
    }
  }
  return detail;
}

/// Paint and its thickness, next to each other, over a ground.
struct PaintedPixel {
  std::array<float, 3> colour;
  float thickness;
};

class Canvas {
 public:
  Canvas(const ColourPlanes& ground, const std::array<float, kNumBristles>& bristles)
      : height_(ground[0].height), width_(ground[0].width), bristles_(bristles) {
    ground_.resize(ground[0].values.size());
    for (size_t i = 0; i < ground_.size(); ++i) {
      ground_[i] = {{ground[0].values[i], ground[1].values[i], ground[2].values[i]}, 0.5f};
    }
    paint_ = ground_;
  }

  void Add(const BrushStroke& stroke) {
    const float half_length = 0.5f * stroke.length, half_width = 0.5f * stroke.width;
    const float reach_y = std::abs(stroke.along_y) * half_length + std::abs(stroke.along_x) * half_width + 0.5f;
    const int top = std::max(0, static_cast<int>(stroke.y - reach_y)),
              bottom = std::min(height_ - 1, static_cast<int>(stroke.y + reach_y));
    const float inverse_length = 1 / half_length;
    for (int row = top; row <= bottom; ++row) {
      const float down = static_cast<float>(row) + 0.5f - stroke.y;
      // Where |u| < half_length + 1/2 and |v| < half_width + 1/2 in this row.
      float from = -1e6f, to = 1e6f;
      Narrow(stroke.along_x, down * stroke.along_y, half_length + 0.5f, from, to);
      Narrow(-stroke.along_y, down * stroke.along_x, half_width + 0.5f, from, to);
      const int left = std::max(0, static_cast<int>(std::max(from + stroke.x, 0.0f))),
                right = std::min(width_ - 1, static_cast<int>(std::max(to + stroke.x, -1.0f)));
      for (int column = left; column <= right; ++column) {
        const float across = static_cast<float>(column) + 0.5f - stroke.x;
        const float u = across * stroke.along_x + down * stroke.along_y;
        const float v = down * stroke.along_x - across * stroke.along_y;
        float alpha = std::min(half_width + 0.5f - std::abs(v), half_length + 0.5f - std::abs(u));
        if (alpha <= 0) continue;
        const size_t pixel = size_t(row) * width_ + column;
        const auto& ground = ground_[pixel].colour;
        const float difference = std::abs(ground[0] - stroke.colour[0]) + std::abs(ground[1] - stroke.colour[1]) +
                                 std::abs(ground[2] - stroke.colour[2]);
        if (difference >= kColourReach) continue;
        const float ridge = bristles_[(stroke.bristle + static_cast<int>((v + half_width + 1) * 1.7f)) % kNumBristles];
        // Paint runs out towards the end of a stroke.
        const float left_over = 1 - 0.5f * std::max(0.0f, u * inverse_length) * (1 - ridge);
        alpha = std::min(alpha, 1.0f) * left_over * std::min(1.0f, 2 - 2 * difference / kColourReach) * 0.92f;
        auto& [colour, thickness] = paint_[pixel];
        for (int channel = 0; channel < 3; ++channel) {
          colour[channel] += alpha * (stroke.colour[channel] - colour[channel]);
        }
        const float edge = std::abs(v) > half_width - 0.7f ? 0.25f : 0.0f;
        thickness += alpha * (0.3f + 0.5f * ridge + edge - thickness);
      }
    }
  }

  /// The paint with light from the upper left on its ridges.
  ColourPlanes Lit(float strength) const {
    ColourPlanes colours = MakeColourPlanes(height_, width_, {0, 0, 0});
    for (int row = 0; row < height_; ++row) {
      for (int column = 0; column < width_; ++column) {
        const size_t pixel = size_t(row) * width_ + column;
        const float thickness = paint_[pixel].thickness;
        const float before = column > 0 ? paint_[pixel - 1].thickness : thickness;
        const float above = row > 0 ? paint_[pixel - width_].thickness : thickness;
        const float light = 1 + strength * (thickness - 0.5f * (before + above));
        for (int channel = 0; channel < 3; ++channel) {
          colours[channel].values[pixel] = paint_[pixel].colour[channel] * light;
        }
      }
    }
    return colours;
  }

 private:
  /// Narrows `from`..`to` to where |slope t + offset| < reach.
  static void Narrow(float slope, float offset, float reach, float& from, float& to) {
    if (std::abs(slope) < 1e-4f) {
      if (std::abs(offset) >= reach) to = from - 1;
      return;
    }
    const float inverse = 1 / slope, first = (-reach - offset) * inverse, second = (reach - offset) * inverse;
    from = std::max(from, std::min(first, second));
    to = std::min(to, std::max(first, second));
  }

  int height_, width_;
  std::vector<PaintedPixel> ground_, paint_;
  const std::array<float, kNumBristles>& bristles_;
};

}  // namespace

ColourPlanes Kuwahara(const ColourPlanes& picture, int radius) {
  if (radius <= 0) return picture;
  const int height = picture[0].height, width = picture[0].width;
  const Plane luma = Luma(picture);
  Plane squares = luma;
  for (float& value : squares.values) value *= value;
  const Plane mean = BoxBlur(luma, radius);
  Plane weight = BoxBlur(squares, radius);
  for (size_t i = 0; i < weight.values.size(); ++i) {
    const float variance = std::max(0.0f, weight.values[i] - mean.values[i] * mean.values[i]) + 1e-4f;
    weight.values[i] = 1e-6f / (variance * variance);
  }
  const ColourPlanes means = {BoxBlur(picture[0], radius), BoxBlur(picture[1], radius), BoxBlur(picture[2], radius)};
  const int diagonal = std::max(1, static_cast<int>(std::lround(0.71 * radius)));
  const std::array<std::array<int, 2>, 8> shifts = {{{-radius, 0},
                                                     {radius, 0},
                                                     {0, -radius},
                                                     {0, radius},
                                                     {-diagonal, -diagonal},
                                                     {-diagonal, diagonal},
                                                     {diagonal, -diagonal},
                                                     {diagonal, diagonal}}};
  ColourPlanes sums = MakeColourPlanes(height, width, {0, 0, 0});
  Plane total(height, width, 1e-20f);
  for (const auto& [down, across] : shifts) {
    const int from = std::max(0, -across), to = std::min(width, width - across);
    for (int row = 0; row < height; ++row) {
      const int other = std::clamp(row + down, 0, height - 1);
      const float* __restrict weights = weight.row(other) + across;
      const float* __restrict red = means[0].row(other) + across;
      const float* __restrict green = means[1].row(other) + across;
      const float* __restrict blue = means[2].row(other) + across;
      float* __restrict red_sum = sums[0].row(row);
      float* __restrict green_sum = sums[1].row(row);
      float* __restrict blue_sum = sums[2].row(row);
      float* __restrict weight_sum = total.row(row);
      for (int column = from; column < to; ++column) {
        const float w = weights[column];
        red_sum[column] += w * red[column];
        green_sum[column] += w * green[column];
        blue_sum[column] += w * blue[column];
        weight_sum[column] += w;
      }
    }
  }
  for (Plane& plane : sums) {
    for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] /= total.values[i];
  }
  return sums;
}

FlowField FlowAlongForms(const Plane& plane, float deviation) {
  const int height = plane.height, width = plane.width;
  Plane xx(height, width), xy(height, width), yy(height, width);
  for (int row = 1; row + 1 < height; ++row) {
    const float *above = plane.row(row - 1), *here = plane.row(row), *below = plane.row(row + 1);
    for (int column = 1; column + 1 < width; ++column) {
      const float across = here[column + 1] - here[column - 1], down = below[column] - above[column];
      xx.at(row, column) = across * across;
      xy.at(row, column) = across * down;
      yy.at(row, column) = down * down;
    }
  }
  xx = Blur(xx, deviation);
  xy = Blur(xy, deviation);
  yy = Blur(yy, deviation);
  FlowField flow{Plane(height, width, 1), Plane(height, width), Plane(height, width)};
  for (size_t i = 0; i < xx.values.size(); ++i) {
    const float half = 0.5f * (xx.values[i] - yy.values[i]), cross = xy.values[i];
    const float root = std::sqrt(half * half + cross * cross), sum = xx.values[i] + yy.values[i];
    // The tangent is the eigenvector of the smaller eigenvalue; of two forms of it the longer one is exact.
    float x = half > 0 ? -cross : root - half, y = half > 0 ? root + half : -cross;
    const float length = std::sqrt(x * x + y * y);
    if (length < 1e-9f) continue;
    flow.x.values[i] = x / length;
    flow.y.values[i] = y / length;
    flow.strength.values[i] = 2 * root / (sum + 1e-5f);
  }
  return flow;
}

ColourPlanes BrushPainting(const ColourPlanes& picture, float brush, Rng& rng) {
  brush = std::max(brush, 1.0f);
  const int height = picture[0].height, width = picture[0].width;
  const ColourPlanes ground = Kuwahara(picture, std::max(1, static_cast<int>(std::lround(0.6f * brush))));
  const FlowField flow = FlowAlongForms(Luma(ground), 1.2f * brush);
  const Plane detail = DetailOf(ground);
  const auto bristles = DrawBristles(rng);
  Canvas canvas(ground, bristles);
  for (const float size : {2.4f, 1.2f}) {
    const float stroke_width = size * brush, spacing = (size > 2 ? 0.85f : 0.95f) * stroke_width;
    const int rows = static_cast<int>(static_cast<float>(height) / spacing) + 1,
              columns = static_cast<int>(static_cast<float>(width) / spacing) + 1;
    const std::vector<int> order = rng.Permutation(rows * columns);
    for (const int place : order) {
      const uint64_t bits = rng.Bits();
      const auto fraction = [&](int shift) { return static_cast<float>(bits >> shift & 255) * (1.0f / 255.0f); };
      BrushStroke stroke{};
      stroke.x = (static_cast<float>(place % columns) + fraction(0)) * spacing;
      stroke.y = (static_cast<float>(place / columns) + fraction(8)) * spacing;
      const int row = static_cast<int>(stroke.y), column = static_cast<int>(stroke.x);
      if (row >= height || column >= width) continue;
      const size_t pixel = size_t(row) * width + column;
      // Fine strokes are for details; elsewhere most of the coarse ones stay.
      if (size < 2 && detail.values[pixel] < kDetail && fraction(0) > 0.25f) continue;
      // Where there is no form, strokes go about one way.
      const float aimless = 0.25f * (1 - std::min(1.0f, flow.strength.values[pixel]));
      stroke.along_x = flow.x.values[pixel] * (flow.x.values[pixel] < 0 ? -1.0f : 1.0f) + aimless;
      stroke.along_y =
          flow.y.values[pixel] * (flow.x.values[pixel] < 0 ? -1.0f : 1.0f) + aimless + 0.5f * (fraction(16) - 0.5f);
      const float norm = std::hypot(stroke.along_x, stroke.along_y) + 1e-6f;
      stroke.along_x /= norm;
      stroke.along_y /= norm;
      stroke.width = stroke_width * (0.7f + 0.6f * fraction(24));
      stroke.length = stroke_width * (2.0f + 1.6f * fraction(32));
      stroke.bristle = static_cast<int>(bits >> 40 & 63);
      const float lighter = 0.075f * (fraction(48) - 0.5f), warmer = 0.045f * (fraction(56) - 0.5f);
      stroke.colour = {ground[0].values[pixel] + lighter + warmer, ground[1].values[pixel] + lighter,
                       ground[2].values[pixel] + lighter - warmer};
      canvas.Add(stroke);
    }
  }
  return canvas.Lit(0.24f);
}

}  // namespace daumier::render
