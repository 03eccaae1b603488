#include "faces/appearance/hats.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr SoupKind kHatKind{PictureClass::kBackground, PicturePart::kHat};
constexpr int kHatRows = 18, kBrimRows = 5;
constexpr double kUnderHat = 0.35;  // Room that a hat leaves for hair, cm.

double CosineOf(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180);
}

/// A thin closed sheet around the head that leaves the hat's border outwards.
void AddBrim(const SkullGrid& skull, const HatFit& fit, double size, const Looks& looks, HeadSoup& soup) {
  constexpr int kColumns = SkullGrid::kColumns;
  const bool is_cap = looks.hat == HatStyle::kCap;
  const double widest = is_cap ? 72 : 180;
  const double length = (is_cap ? 6.2 : 4.6) * size, thickness = 0.28 * size;
  std::vector<int> first(kColumns, -1);
  for (int c = 0; c < kColumns; ++c) {
    const double azimuth = SkullGrid::Azimuth(c), border = fit.BorderAt(azimuth) + 1;
    if (std::abs(azimuth) > widest) continue;
    const geometry::Vector3 outwards = skull.Outwards(c, border);
    const geometry::Vector3 from = skull.At(c, border) + (fit.Offset(azimuth, border) - 0.25 * size) * outwards;
    geometry::Vector3 along(outwards.x(), 0, outwards.z());
    double reach = length;
    if (is_cap) {
      along = geometry::Vector3(0.35 * outwards.x(), 0, 1);
      reach *= std::sqrt(std::max(0.0, 1 - std::pow(azimuth / widest, 2)));
    }
    along.normalize();
    first[size_t(c)] = soup.size();
    const double side = 1 - std::abs(CosineOf(azimuth));
    for (int sheet = 0; sheet < 2; ++sheet) {
      for (int k = 0; k < kBrimRows; ++k) {
        const double t = double(k) / (kBrimRows - 1);
        double y = is_cap ? -0.12 * reach * t * t - 0.02 * reach * t : (-0.06 + 0.24 * side) * reach * t * t;
        y += (sheet == 0 ? 0.5 : -0.5) * thickness * (1 - 0.6 * t);
        const float light = sheet == 0 ? 1.0f : 0.6f;
        soup.AddVertex(from + reach * t * along + geometry::Vector3(0, y, 0), light * looks.hat_colour);
      }
    }
  }
  for (int c = 0; c < kColumns; ++c) {
    const int a = first[size_t(c)], b = first[size_t((c + 1) % kColumns)];
    if (a < 0) continue;
    const auto strip = [&](int from, int to) {
      for (int k = 0; k + 1 < kBrimRows; ++k) {
        soup.AddQuad(from + k, from + k + 1, to + k + 1, to + k, kHatKind);
        soup.AddQuad(from + kBrimRows + k, to + kBrimRows + k, to + kBrimRows + k + 1, from + kBrimRows + k + 1,
                     kHatKind);
      }
      soup.AddQuad(from + kBrimRows - 1, from + 2 * kBrimRows - 1, to + 2 * kBrimRows - 1, to + kBrimRows - 1,
                   kHatKind);
      soup.AddQuad(from, to, to + kBrimRows, from + kBrimRows, kHatKind);
    };
    const auto end = [&](int at, bool last) {
      for (int k = 0; k + 1 < kBrimRows; ++k) {
        const int p = at + k, q = at + k + 1, r = at + kBrimRows + k + 1, s = at + kBrimRows + k;
        last ? soup.AddQuad(p, q, r, s, kHatKind) : soup.AddQuad(p, s, r, q, kHatKind);
      }
    };
    if (b >= 0) strip(a, b);
    if (b < 0) end(a, true);
    if (first[size_t((c + kColumns - 1) % kColumns)] < 0) end(a, false);
  }
}

}  // namespace

HatFit::HatFit(HatStyle style, const ScalpLines& lines, double size) : style_(style), size_(size) {
  front_ = lines.hairline - (style == HatStyle::kBeanie ? 6 : 5);
  front_ = std::max(front_, lines.brow + 9);
  back_ = lines.ear_top + (style == HatStyle::kBeanie ? -4 : 0);
}

double HatFit::BorderAt(double azimuth) const {
  const double t = 0.5 + 0.5 * CosineOf(azimuth);
  return back_ + t * (front_ - back_) + 3.5 * (1 - std::pow(CosineOf(azimuth), 2));
}

double HatFit::Offset(double azimuth, double elevation) const {
  const double up = SmoothBetween(BorderAt(azimuth), 90, elevation);
  switch (style_) {
    case HatStyle::kCap:
      return size_ * (1.0 + 0.9 * up);
    case HatStyle::kBeanie:
      return size_ * (1.0 + 1.9 * up * up);
    default:
      return size_ * (1.05 + 3.0 * SmoothBetween(0.15, 0.75, up));
  }
}

double HatFit::Pressed(double height, double azimuth, double elevation) const {
  if (style_ == HatStyle::kNone) return height;
  const double under = SmoothBetween(-9, -2, elevation - BorderAt(azimuth));
  return height + under * (std::min(height, kUnderHat * size_) - height);
}

void AddHat(const SkullGrid& skull, const HatFit& fit, double size, const Looks& looks, HeadSoup& soup) {
  if (!fit.is_there()) return;
  constexpr int kColumns = SkullGrid::kColumns;
  const int first = soup.size();
  for (int c = 0; c < kColumns; ++c) {
    const double azimuth = SkullGrid::Azimuth(c), border = fit.BorderAt(azimuth);
    for (int k = 0; k <= kHatRows; ++k) {
      const double share = double(k) / kHatRows, elevation = 90 + share * (border - 90);
      double offset = fit.Offset(azimuth, elevation);
      const bool is_band = share > (looks.hat == HatStyle::kBeanie ? 0.72 : 0.83);
      if (looks.hat == HatStyle::kBeanie) {
        if (is_band) offset += 0.45 * size * std::sqrt(std::max(0.0, 1 - std::pow((share - 0.86) / 0.14, 2)));
        offset += 0.06 * size * SmoothBetween(0, 0.2, share) * CosineOf(32 * azimuth);  // Knitted.
      }
      if (looks.hat == HatStyle::kCap)
        offset -= 0.05 * size * SmoothBetween(0, 0.2, share) * std::pow(std::abs(CosineOf(3 * azimuth)), 12);  // Seams.
      const Eigen::Vector3f colour = is_band && looks.hat != HatStyle::kCap ? looks.hat_band : looks.hat_colour;
      soup.AddVertex(skull.At(c, elevation) + offset * skull.Outwards(c, elevation), colour);
    }
    // Inside, under the skin.
    for (int k = 0; k <= 2; ++k) {
      const double elevation = border + 2 + (90 - border) * k / 2.0;
      soup.AddVertex(skull.At(c, std::min(90.0, elevation)) - 0.4 * size * skull.Outwards(c, std::min(90.0, elevation)),
                     0.5f * looks.hat_colour);
    }
  }
  constexpr int kStride = kHatRows + 4;
  for (int c = 0; c < kColumns; ++c) {
    const int a = first + c * kStride, b = first + (c + 1) % kColumns * kStride;
    for (int k = 0; k + 1 < kStride; ++k) {
      if (k == 0 || k + 2 == kStride) {
        // At the crown all columns are in one place.
        k == 0 ? soup.AddTriangle(a, a + 1, b + 1, kHatKind) : soup.AddTriangle(a + k, a + k + 1, b + k, kHatKind);
        continue;
      }
      soup.AddQuad(a + k, a + k + 1, b + k + 1, b + k, kHatKind);
    }
  }
  if (looks.hat != HatStyle::kBeanie) AddBrim(skull, fit, size, looks, soup);
}

}  // namespace daumier::faces
