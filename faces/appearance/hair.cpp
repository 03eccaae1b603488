#include "faces/appearance/hair.h"

#include "core/random.h"
#include "faces/appearance/hair_shell.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::faces {
namespace {

constexpr SoupKind kHairKind{PictureClass::kHair, PicturePart::kHair};
constexpr int kHairRows = 26;       // Outside; the inside has half of them.
constexpr double kHangFrom = 2.0;   // Elevation at which hanging hair leaves the skull.
constexpr double kSkullLift = 0.3;  // cm
constexpr double kEndLength = 2.2;  // How much of the hair bends down to its end, cm.

/// Outside and inside of the hair at the points of a column, from the crown to its end.
struct HairPoint {
  geometry::Vector3 outside, inside;
  double share;       ///< Of the column's length.
  double wave, fine;  ///< HairWaves there.
};

struct HairGuide {
  geometry::Vector3 base, outwards;
  double height, length;  ///< Height of the hair there; length from the crown.
  bool hangs;
};

std::vector<HairPoint> HairColumn(const SkullGrid& skull, const HairShape& shape, const HatFit& hat, int column) {
  const double azimuth = SkullGrid::Azimuth(column), hang = shape.HangAt(azimuth), size = shape.size;
  const double end = hang > 0 ? kHangFrom : shape.EndAt(azimuth);
  constexpr int kSteps = 16, kHangSteps = 10;
  std::vector<HairGuide> guides;
  for (int k = 0; k <= kSteps; ++k) {
    const double elevation = 90 + (end - 90) * k / kSteps;
    HairGuide guide{skull.At(column, elevation), skull.Outwards(column, elevation),
                    hat.Pressed(shape.HeightAt(azimuth, elevation), azimuth, elevation), 0, false};
    if (k > 0) guide.length = guides.back().length + (guide.base - guides.back().base).norm();
    guides.push_back(guide);
  }
  if (hang > 0) {
    const HairGuide from = guides.back();
    const geometry::Vector3 level = geometry::Vector3(from.outwards.x(), 0, from.outwards.z()).normalized();
    for (int k = 1; k <= kHangSteps; ++k) {
      const double t = double(k) / kHangSteps;
      // Slightly outwards first; a bob curls in, long hair flares.
      const double out = shape.style == HairStyle::kBob ? 0.9 * t - 1.5 * t * t * t : 0.5 * t + 0.5 * t * t;
      HairGuide guide = from;
      guide.base = from.base + geometry::Vector3(0, -hang * t, 0) + size * out * level;
      guide.outwards = level;
      guide.height = from.height * (1 + 0.15 * std::sin(std::numbers::pi * t));
      guide.length = from.length + hang * t;
      guide.hangs = true;
      guides.push_back(guide);
    }
  }
  const double total = guides.back().length;
  const double bend = std::min(kEndLength * size, 0.4 * total);
  std::vector<HairPoint> points;
  size_t segment = 0;
  for (int j = 0; j <= kHairRows; ++j) {
    const double even = double(j) / kHairRows, share = 0.45 * even + 0.55 * std::sin(0.5 * std::numbers::pi * even);
    const double length = share * total;
    while (segment + 2 < guides.size() && guides[segment + 1].length < length) ++segment;
    const HairGuide &p = guides[segment], &q = guides[segment + 1];
    const double t = std::clamp((length - p.length) / std::max(1e-9, q.length - p.length), 0.0, 1.0);
    const geometry::Vector3 base = (1 - t) * p.base + t * q.base;
    const geometry::Vector3 outwards = ((1 - t) * p.outwards + t * q.outwards).normalized();
    const double height = (1 - t) * p.height + t * q.height;
    const double to_end = std::clamp(1 - (total - length) / bend, 0.0, 1.0);
    HairPoint point;
    point.share = share;
    point.wave = shape.waves.At(azimuth, share);
    point.fine = shape.waves.Fine(azimuth, share);
    const double waves = size * (0.22 * point.wave + 0.06 * point.fine);
    if (q.hangs) {
      const double thick = std::min(height, 1.6 * size) * (1 - 0.75 * to_end * to_end);
      point.outside = base + (height - 0.55 * height * to_end * to_end + waves) * outwards;
      point.inside = point.outside - std::max(0.2 * size, thick) * outwards;
      if (j == kHairRows) point.inside = point.outside - 0.2 * size * outwards;
    } else {
      const double dip = 0.35 * size;
      const double round = std::sqrt(std::max(0.0, 1 - to_end * to_end));
      // The skull is smooth, so its convex skin lies a little higher.
      const double over = (height + std::min(1.0, height / (1.2 * size)) * waves + kSkullLift * size) * round;
      point.outside = base + (over - dip * to_end * to_end * to_end) * outwards;
      point.inside = base - 0.5 * size * outwards;
    }
    points.push_back(point);
  }
  return points;
}

void AddShell(const SkullGrid& skull, const HairShape& shape, const HatFit& hat, const Looks& looks, HeadSoup& soup) {
  constexpr int kColumns = SkullGrid::kColumns, kInside = kHairRows / 2 + 1, kStride = kHairRows + 1 + kInside;
  const int first = soup.size();
  for (int c = 0; c < kColumns; ++c) {
    const std::vector<HairPoint> points = HairColumn(skull, shape, hat, c);
    for (const HairPoint& point : points) {
      const double strand = 0.10 * point.fine + 0.05 * point.wave;
      const double shine = 0.14 * std::exp(-std::pow((point.share - 0.42) / 0.10, 2));
      const auto light = static_cast<float>(0.94 + strand + shine - 0.15 * std::pow(point.share, 4));
      soup.AddVertex(point.outside, light * looks.hair_colour + Eigen::Vector3f::Constant(0.12f * float(shine)));
    }
    for (int k = 0; k < kInside; ++k)
      soup.AddVertex(points[size_t(kHairRows - 2 * k)].inside, 0.6f * looks.hair_colour);
  }
  for (int c = 0; c < kColumns; ++c) {
    const int a = first + c * kStride, b = first + (c + 1) % kColumns * kStride;
    for (int k = 0; k + 1 < kStride; ++k) {
      if (k == 0) {
        soup.AddTriangle(a, a + 1, b + 1, kHairKind);
      } else if (k + 2 == kStride) {
        soup.AddTriangle(a + k, a + k + 1, b + k, kHairKind);
      } else {
        soup.AddQuad(a + k, a + k + 1, b + k + 1, b + k, kHairKind);
      }
    }
  }
}

/// A direction drawn evenly over the hair, as column and elevation, at least `margin` degrees inside its ends and `under_hat` below a hat.
struct HairPlace {
  int column;
  double azimuth, elevation;
};

std::vector<HairPlace> HairPlaces(const HairShape& shape, const HatFit& hat, int count, double margin, double under_hat,
                                  Rng& rng) {
  // A spiral of even density over the sphere.
  std::vector<HairPlace> places;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0)), start = rng.Uniform(0, 2 * std::numbers::pi);
  for (int k = 0; k < count; ++k) {
    const double y = 1 - 1.75 * (k + 0.5) / count;
    const double elevation = std::asin(y) * 180 / std::numbers::pi;
    double azimuth = std::fmod((start + turn * k) * 180 / std::numbers::pi, 360.0) - 180;
    const int column = static_cast<int>((azimuth + 180) / 360 * SkullGrid::kColumns) % SkullGrid::kColumns;
    if (elevation < shape.EndAt(azimuth) + margin) continue;
    if (hat.is_there() && elevation > hat.BorderAt(azimuth) - under_hat) continue;
    places.push_back({column, azimuth, elevation});
  }
  return places;
}

void AddCurls(const SkullGrid& skull, const HairShape& shape, const HatFit& hat, const Looks& looks, HeadSoup& soup) {
  Rng rng = Stream(looks.detail_seed, "curls");
  for (const HairPlace& place : HairPlaces(shape, hat, 150, 4, 14, rng)) {
    const geometry::Vector3 outwards = skull.Outwards(place.column, place.elevation);
    const double radius = shape.size * (1.25 + 0.6 * rng.Uniform()) * std::sqrt(looks.hair_volume);
    const double height = shape.HeightAt(place.azimuth, place.elevation) - 0.15 * radius;
    const geometry::Vector3 side = outwards.unitOrthogonal();
    Eigen::Matrix3d axes;
    axes << radius * side, radius * outwards.cross(side), 0.9 * radius * outwards;
    const auto light = static_cast<float>(0.88 + 0.24 * rng.Uniform());
    AddEllipsoid(skull.At(place.column, place.elevation) + height * outwards, axes, 5, 8,
                 0.85f * light * looks.hair_colour, 1.08f * light * looks.hair_colour, kHairKind, soup);
  }
}

void AddSpikes(const SkullGrid& skull, const HairShape& shape, const HatFit& hat, const Looks& looks, HeadSoup& soup) {
  Rng rng = Stream(looks.detail_seed, "spikes");
  const double length = 5.2 * shape.size * looks.hair_length;
  for (const HairPlace& place : HairPlaces(shape, hat, 90, 3, 8, rng)) {
    if (place.elevation < 2) continue;
    const geometry::Vector3 outwards = skull.Outwards(place.column, place.elevation);
    // Swept up and back.
    const geometry::Vector3 along =
        (outwards + geometry::Vector3(0.25 * rng.Normal(), 0.45 + 0.2 * rng.Normal(), -0.25)).normalized();
    const geometry::Vector3 root = skull.At(place.column, place.elevation) +
                                   (shape.HeightAt(place.azimuth, place.elevation) - 0.9 * shape.size) * outwards;
    const double reach = length * (0.7 + 0.5 * rng.Uniform()) * (0.55 + 0.45 * SmoothBetween(0, 60, place.elevation));
    const geometry::Vector3 bow = 0.22 * reach * geometry::Vector3(0, -0.2, -1);
    std::vector<geometry::Vector3> path;
    std::vector<double> radii;
    for (int k = 0; k <= 3; ++k) {
      const double t = k / 3.0;
      path.push_back(root + reach * t * along + t * t * bow);
      radii.push_back(shape.size * 1.75 * (1 - 0.6 * t - 0.4 * t * t) + 0.02);
    }
    const auto light = static_cast<float>(0.86 + 0.26 * rng.Uniform());
    AddTube(path, radii, 6, light * looks.hair_colour, kHairKind, soup);
  }
}

void AddBun(const SkullGrid& skull, const HairShape& shape, const HatFit& hat, const Looks& looks, HeadSoup& soup) {
  const double elevation = hat.is_there() ? -2 : looks.detail_seed % 2 == 0 ? 72 : 38;
  const geometry::Vector3 outwards = skull.Outwards(0, elevation), side(1, 0, 0);
  const double radius = (hat.is_there() ? 2.2 : 3.1) * shape.size * std::sqrt(looks.hair_volume);
  const geometry::Vector3 centre = skull.At(0, elevation) + (0.75 * radius + 0.5 * shape.size) * outwards;
  Eigen::Matrix3d axes;
  axes << radius * side, radius * outwards.cross(side), 0.85 * radius * outwards;
  AddEllipsoid(centre, axes, 9, 16, 0.95f * looks.hair_colour, 1.1f * looks.hair_colour, kHairKind, soup);
  // A band of hair around its root, and two turns on it.
  for (int turn = 0; turn < 2; ++turn) {
    std::vector<geometry::Vector3> ring;
    const double height = (-0.55 + 0.5 * turn) * radius,
                 wide = std::sqrt(std::max(0.1, 1 - std::pow(height / (0.85 * radius), 2)));
    for (int k = 0; k < 20; ++k) {
      const double a = 2 * std::numbers::pi * k / 20;
      ring.push_back(centre + height * outwards +
                     0.93 * radius * wide * (std::cos(a) * side + std::sin(a) * outwards.cross(side)));
    }
    AddRing(ring, 0.22 * radius, 6, (turn % 2 == 0 ? 0.85f : 1.02f) * looks.hair_colour, kHairKind, soup);
  }
}

void AddTail(const SkullGrid& skull, const HairShape& shape, const Looks& looks, HeadSoup& soup) {
  const double elevation = 22;
  const geometry::Vector3 outwards = skull.Outwards(0, elevation);
  const geometry::Vector3 root = skull.At(0, elevation) + 0.3 * shape.size * outwards;
  const double length = 15 * shape.size * looks.hair_length;
  const double sway = 3.5 * shape.size * (double(looks.detail_seed % 5) / 2 - 1);
  std::vector<geometry::Vector3> path;
  std::vector<double> radii;
  for (int k = 0; k <= 12; ++k) {
    const double t = k / 12.0;
    path.push_back(root + geometry::Vector3(sway * t, 2.5 * shape.size * std::sin(3 * t) - length * t * t,
                                            -4.5 * shape.size * std::sin(2.2 * t)));
    radii.push_back(shape.size * looks.hair_volume * (0.9 + 1.3 * std::sin(2.6 * std::pow(t, 0.8))) *
                    (1 - 0.75 * std::pow(t, 5)));
  }
  AddTube(path, radii, 12, 0.95f * looks.hair_colour, kHairKind, soup);
  std::vector<geometry::Vector3> band;
  const geometry::Vector3 along = (path[2] - path[0]).normalized(), side = along.unitOrthogonal();
  for (int k = 0; k < 16; ++k) {
    const double a = 2 * std::numbers::pi * k / 16;
    band.push_back(path[1] + 1.05 * radii[1] * (std::cos(a) * side + std::sin(a) * along.cross(side)));
  }
  AddRing(band, 0.35 * shape.size, 6, looks.hat_band, {PictureClass::kHair, PicturePart::kHair}, soup);
}

}  // namespace

void AddHair(const SkullGrid& skull, const ScalpLines& lines, const HatFit& hat, double size, const Looks& looks,
             HeadSoup& soup) {
  if (looks.hair == HairStyle::kBald) return;
  const HairShape shape(lines, looks, size);
  AddShell(skull, shape, hat, looks, soup);
  if (looks.hair == HairStyle::kCurly) AddCurls(skull, shape, hat, looks, soup);
  if (looks.hair == HairStyle::kSpiky) AddSpikes(skull, shape, hat, looks, soup);
  if (looks.hair == HairStyle::kBun) AddBun(skull, shape, hat, looks, soup);
  if (looks.hair == HairStyle::kPonytail) AddTail(skull, shape, looks, soup);
}

}  // namespace daumier::faces
