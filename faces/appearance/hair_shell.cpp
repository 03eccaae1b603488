#include "faces/appearance/hair_shell.h"

#include "core/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

double RadiansOf(double degrees) {
  return degrees * std::numbers::pi / 180;
}

double Bell(double x, double width) {
  return std::exp(-x * x / (2 * width * width));
}

}  // namespace

HairWaves::HairWaves(uint64_t seed) {
  Rng rng = Stream(seed, "hair waves");
  constexpr std::array<double, kWaves> kUsual = {5, 9, 14, 21, 29, 37};
  for (size_t k = 0; k < kWaves; ++k) {
    number_[k] = kUsual[k] + double(rng.Below(3));
    phase_[k] = rng.Uniform(0, 2 * std::numbers::pi);
    drift_[k] = rng.Uniform(-2.5, 2.5);
  }
}

double HairWaves::At(double azimuth, double share) const {
  double sum = 0;
  for (size_t k = 0; k < 4; ++k) sum += 0.5 * std::sin(number_[k] * RadiansOf(azimuth) + phase_[k] + drift_[k] * share);
  return sum * SmoothBetween(0.0, 0.35, share);
}

double HairWaves::Fine(double azimuth, double share) const {
  double sum = 0;
  for (size_t k = 2; k < kWaves; ++k)
    sum += 0.5 * std::sin(number_[k] * RadiansOf(azimuth) + phase_[k] + 1.5 * drift_[k] * share);
  return sum * SmoothBetween(0.0, 0.35, share);
}

HairShape::HairShape(const ScalpLines& scalp_lines, const Looks& of, double head_size)
    : style(of.hair),
      lines(scalp_lines),
      looks(&of),
      waves(of.detail_seed),
      size(head_size),
      tucked(of.detail_seed % 3 == 0) {}

bool HairShape::HangsAtAll() const {
  return style == HairStyle::kBob || style == HairStyle::kLong;
}

double HairShape::EndAt(double azimuth) const {
  const double a = std::abs(azimuth);
  double end = HairlineAt(lines, azimuth, style == HairStyle::kReceding ? 1.0 : 0.0);
  const double lock = std::abs(std::sin(RadiansOf(azimuth) * 7.5 + double(looks->detail_seed % 7)));
  double fringe = looks->hair_fringe;
  if (style == HairStyle::kFringe) fringe = std::max(fringe, 0.85);
  if (style == HairStyle::kReceding || style == HairStyle::kBun || style == HairStyle::kPonytail) fringe *= 0.3;
  if (style == HairStyle::kParted) {
    // Swept to the side away from the parting.
    const double side = looks->hair_parting >= 0 ? -azimuth : azimuth;
    end -= 0.65 * (lines.hairline - lines.brow) * SmoothBetween(-20, 30, side) * (1 - SmoothBetween(45, 62, a));
  }
  const double width = lines.ear_front - 22;
  const double low = lines.brow + 5 - 3 * Bell(a - width, 14);
  const double covered = fringe * (1 - SmoothBetween(width - 12, width + 4, a));
  if (low < end) end += covered * (low - end);
  end -= (1.2 + 3.0 * fringe) * (lock - 0.6) * (1 - SmoothBetween(60, 80, a));
  return end;
}

double HairShape::HangAt(double azimuth) const {
  if (!HangsAtAll()) return 0;
  const double a = std::abs(azimuth), front = tucked ? lines.ear_back + 2 : lines.ear_front - 14;
  if (a < front) return 0;
  const double length = (style == HairStyle::kBob ? 7.5 : 17.0) * looks->hair_length * size;
  return length * (0.82 + 0.18 * SmoothBetween(front, front + 45, a)) + 0.35 * size * waves.At(azimuth, 1);
}

double HairShape::HeightAt(double azimuth, double elevation) const {
  const double a = std::abs(azimuth), up = SmoothBetween(0, 70, elevation), volume = looks->hair_volume * size;
  double height = 0;
  switch (style) {
    case HairStyle::kBald:
      return 0;
    case HairStyle::kShort:
    case HairStyle::kSpiky:
      height = 0.55 + 1.0 * up;
      break;
    case HairStyle::kReceding:
      height = 0.45 + 0.3 * up;
      break;
    case HairStyle::kBun:
    case HairStyle::kPonytail:
      height = 0.55 + 0.35 * up;
      break;
    case HairStyle::kCurly:
      height = 1.2 + 1.3 * up;
      break;
    case HairStyle::kBob:
      height = 1.3 + 0.5 * up;
      break;
    case HairStyle::kLong:
      height = 1.1 + 0.6 * up;
      break;
    case HairStyle::kParted:
    case HairStyle::kFringe:
      height = 0.8 + 0.9 * up;
      break;
  }
  if (style == HairStyle::kShort || style == HairStyle::kParted)
    height += 0.9 * Bell(azimuth, 40) * SmoothBetween(25, 60, elevation) * (1 - 0.6 * SmoothBetween(70, 90, elevation));
  if (style == HairStyle::kParted || style == HairStyle::kBob || style == HairStyle::kLong) {
    // A furrow from the hairline over the crown.
    const double across = std::sin(RadiansOf(azimuth)) * std::cos(RadiansOf(elevation));
    const double furrow = Bell(across - 0.42 * looks->hair_parting, 0.045) * (1 - SmoothBetween(75, 115, a));
    height *= 1 - 0.55 * furrow;
  }
  // Over the ears, which long hair covers.
  if (HangsAtAll() && !tucked) {
    const double middle = 0.5 * (lines.ear_front + lines.ear_back);
    height += 1.3 * Bell(a - middle, 24) * (1 - SmoothBetween(5, 45, elevation));
  }
  return height * volume;
}

}  // namespace daumier::faces
