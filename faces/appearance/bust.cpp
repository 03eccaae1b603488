#include "faces/appearance/bust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace daumier::faces {
namespace {

constexpr int kBustSides = 48;
constexpr SoupKind kNeckKind{PictureClass::kSkin, PicturePart::kSkin};
constexpr SoupKind kClothesKind{PictureClass::kBackground, PicturePart::kClothes};

/// A ring below the head: how far down along the neck, the neck's outline times `scale` plus `wider`, and how much of an
/// ellipse of these half axes it is, cm for a usual head.
struct BustRing {
  double down, scale, wider, of_ellipse, across, deep;
  float light;
};

double AzimuthAt(int side) {
  return 2 * std::numbers::pi * side / kBustSides;
}

/// Rings, closed at both ends.
void AddBustRings(const std::vector<BustRing>& rings, const std::vector<geometry::Vector3>& outline,
                  const geometry::Vector3& centre, double size, double neckline, const Eigen::Vector3f& colour,
                  SoupKind kind, HeadSoup& soup) {
  const geometry::Vector3 along = geometry::Vector3(0, -1, -0.30) * size;
  std::vector<int> first;
  for (const BustRing& ring : rings) {
    first.push_back(soup.size());
    for (int k = 0; k < kBustSides; ++k) {
      const double x = std::sin(AzimuthAt(k)), z = std::cos(AzimuthAt(k));
      const geometry::Vector3 from_neck =
          ring.scale * outline[size_t(k)] + ring.wider * size * geometry::Vector3(x, 0, z);
      const geometry::Vector3 of_ellipse(ring.across * size * x, 0, ring.deep * size * z);
      geometry::Vector3 p = (1 - ring.of_ellipse) * from_neck + ring.of_ellipse * of_ellipse;
      p.y() -= neckline * size * (1 - ring.of_ellipse) * std::pow(std::max(0.0, z), 3);
      soup.AddVertex(
          centre + p + std::min(ring.down, 9.0) * along - geometry::Vector3(0, std::max(0.0, ring.down - 9) * size, 0),
          ring.light * colour);
    }
  }
  for (size_t r = 0; r + 1 < rings.size(); ++r) {
    for (int k = 0; k < kBustSides; ++k) {
      const int j = (k + 1) % kBustSides, a = first[r], b = first[r + 1];
      soup.AddQuad(a + k, b + k, b + j, a + j, kind);
    }
  }
  for (const bool at_end : {false, true}) {
    const int ring = at_end ? first.back() : first.front();
    const BustRing& of = at_end ? rings.back() : rings.front();
    const int middle = soup.AddVertex(
        centre + std::min(of.down, 9.0) * along - geometry::Vector3(0, std::max(0.0, of.down - 9) * size, 0),
        of.light * colour);
    for (int k = 0; k < kBustSides; ++k) {
      const int j = (k + 1) % kBustSides;
      at_end ? soup.AddTriangle(ring + j, ring + k, middle, kind) : soup.AddTriangle(ring + k, ring + j, middle, kind);
    }
  }
}

}  // namespace

void AddBust(const std::vector<geometry::Vector3>& border, const Eigen::Vector3f& skin_colour, double size,
             const Looks& looks, HeadSoup& soup) {
  if (border.size() < 6) return;
  geometry::Vector3 centre = geometry::Vector3::Zero();
  for (const geometry::Vector3& p : border) centre += p / double(border.size());
  // The border's points by their azimuths about its centre.
  std::vector<std::pair<double, geometry::Vector3>> around;
  for (const geometry::Vector3& p : border) {
    double azimuth = std::atan2(p.x() - centre.x(), p.z() - centre.z());
    if (azimuth < 0) azimuth += 2 * std::numbers::pi;
    around.emplace_back(azimuth, p - centre);
  }
  std::sort(around.begin(), around.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<geometry::Vector3> outline;
  for (int k = 0; k < kBustSides; ++k) {
    const double azimuth = AzimuthAt(k);
    size_t next = 0;
    while (next < around.size() && around[next].first < azimuth) ++next;
    auto a = around[(next + around.size() - 1) % around.size()], b = around[next % around.size()];
    if (next == 0) a.first -= 2 * std::numbers::pi;
    if (next == around.size()) b.first += 2 * std::numbers::pi;
    const double t = std::clamp((azimuth - a.first) / std::max(1e-9, b.first - a.first), 0.0, 1.0);
    outline.emplace_back((1 - t) * a.second + t * b.second);
  }
  AddBustRings({{-0.8, 0.93, 0, 0, 0, 0, 1.0f},
                {0.0, 1.0, 0, 0, 0, 0, 1.0f},
                {2.5, 1.0, 0.1, 0, 0, 0, 0.97f},
                {4.0, 1.0, 0.1, 0, 0, 0, 0.92f},
                {6.0, 0.8, 0, 0, 0, 0, 0.9f}},
               outline, centre, size, 0, skin_colour, kNeckKind, soup);
  const double top = looks.collar == CollarStyle::kHigh ? 0.3 : looks.collar == CollarStyle::kRound ? 2.4 : 3.6;
  const double neckline = looks.collar == CollarStyle::kOpen ? 1.2 : 0.0;
  AddBustRings({{top + 1.2, 1.0, 0.1, 0, 0, 0, 0.5f},
                {top + 0.2, 1.0, 0.25, 0, 0, 0, 0.8f},
                {top, 1.02, 0.65, 0, 0, 0, 1.06f},
                {top + 0.35, 1.05, 0.95, 0, 0, 0, 1.04f},
                {std::max(top + 1.1, 3.4), 1.08, 1.2, 0.06, 12, 8, 0.97f},
                {std::max(top + 1.9, 5.2), 1.1, 1.5, 0.45, 15, 8, 1.0f},
                {6.6, 1.1, 1.5, 0.85, 16.5, 8.5, 1.0f},
                {8.3, 1.1, 1.5, 1, 19, 9.2, 1.0f},
                {12.0, 1.1, 1.5, 1, 21, 10, 0.95f},
                {34.0, 1.1, 1.5, 1, 21, 10, 0.8f}},
               outline, centre, size, neckline, looks.clothes_colour, kClothesKind, soup);
}

}  // namespace daumier::faces
