#include "render/svg_clip.h"

#include "core/error.h"
#include "render/cross_product.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

constexpr int kNumBands = 256;
/// What one edge that is compared costs in units of SvgWork.
constexpr int64_t kWorkOfEdge = 6;

}  // namespace

void SvgWork::Spend(int64_t units) {
  spent_ += units;
  DAUMIER_CHECK(spent_ <= kLimit, "{}: the drawing is too large: it repeats or clips its parts too often", file_);
}

SvgClip::SvgClip(std::vector<SvgArea> areas) : areas_(std::move(areas)) {
  for (int a = 0; a < std::ssize(areas_); ++a) {
    for (const SvgPolyline& ring : areas_[a].rings) {
      for (size_t i = 0; i < ring.points.size(); ++i) {
        const Vector2d &from = ring.points[i], &to = ring.points[(i + 1) % ring.points.size()];
        box_.extend(from);
        if (from != to) edges_.push_back({from, to, a});
      }
    }
  }
  // Few edges need few bands.
  bands_.resize(std::clamp<size_t>(edges_.size() / 4, 1, kNumBands));
  for (int e = 0; e < std::ssize(edges_); ++e) {
    const auto [low, high] = std::minmax(edges_[e].from.y(), edges_[e].to.y());
    for (int band = BandOf(low); band <= BandOf(high); ++band) bands_[band].push_back(e);
  }
}

int SvgClip::BandOf(double y) const {
  const double height = box_.isEmpty() ? 0.0 : box_.sizes().y();
  if (height <= 0.0) return 0;
  const auto num_bands = static_cast<double>(bands_.size());
  return static_cast<int>(std::clamp(num_bands * (y - box_.min().y()) / height, 0.0, num_bands - 1.0));
}

bool SvgClip::Contains(const Vector2d& point) const {
  if (box_.isEmpty() || !box_.contains(point)) return false;
  std::vector<int> winding(areas_.size(), 0), crossings(areas_.size(), 0);
  for (const int e : bands_[BandOf(point.y())]) {
    const Edge& edge = edges_[e];
    const bool downwards = edge.from.y() <= point.y() && edge.to.y() > point.y();
    const bool upwards = edge.to.y() <= point.y() && edge.from.y() > point.y();
    if (!downwards && !upwards) continue;
    const double t = (point.y() - edge.from.y()) / (edge.to.y() - edge.from.y());
    if (edge.from.x() + t * (edge.to.x() - edge.from.x()) <= point.x()) continue;
    winding[edge.area] += downwards ? 1 : -1;
    ++crossings[edge.area];
  }
  for (size_t a = 0; a < areas_.size(); ++a) {
    if (areas_[a].rule == FillRule::kEvenOdd ? crossings[a] % 2 != 0 : winding[a] != 0) return true;
  }
  return false;
}

std::vector<SvgPolyline> SvgClip::Clip(const SvgPolyline& polyline, SvgWork& work) const {
  const auto& points = polyline.points;
  if (points.size() == 1) return Contains(points[0]) ? std::vector{polyline} : std::vector<SvgPolyline>();
  std::vector<SvgPolyline> pieces;
  bool is_cut = false;
  const auto append = [&](const Vector2d& from, const Vector2d& to) {
    const bool continues = !pieces.empty() && pieces.back().points.back() == from && !is_cut;
    if (!continues) pieces.push_back({{from}});
    pieces.back().points.push_back(to);
    is_cut = false;
  };
  bool is_whole = true;
  for (size_t i = 1; i < points.size(); ++i) {
    const Vector2d &from = points[i - 1], along = points[i] - from;
    std::vector<double> cuts{0.0, 1.0};
    const auto [low, high] = std::minmax(from.y(), points[i].y());
    const int first_band = BandOf(low), last_band = BandOf(high);
    for (int band = first_band; band <= last_band; ++band) {
      work.Spend(kWorkOfEdge * (1 + std::ssize(bands_[band])));
      for (const int e : bands_[band]) {
        const Vector2d edge = edges_[e].to - edges_[e].from, offset = edges_[e].from - from;
        const double determinant = CrossProduct(along, edge);
        if (determinant == 0.0) continue;
        const double t = CrossProduct(offset, edge) / determinant, u = CrossProduct(offset, along) / determinant;
        if (t > 0.0 && t < 1.0 && u >= 0.0 && u <= 1.0) cuts.push_back(t);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    for (size_t c = 1; c < cuts.size(); ++c) {
      work.Spend(kWorkOfEdge * std::ssize(bands_[BandOf(from.y() + cuts[c] * along.y())]));
      if (Contains(from + 0.5 * (cuts[c - 1] + cuts[c]) * along)) {
        append(c == 1 ? from : Vector2d(from + cuts[c - 1] * along),
               c + 1 == cuts.size() ? points[i] : Vector2d(from + cuts[c] * along));
      } else {
        is_cut = true;
        is_whole = false;
      }
    }
  }
  if (is_whole) return {polyline};
  // The first and the last piece of a closed line that was cut elsewhere are one.
  if (pieces.size() > 1 && points.front() == points.back() && pieces.front().points.front() == points.front() &&
      pieces.back().points.back() == points.back()) {
    auto& last = pieces.back().points;
    last.insert(last.end(), pieces.front().points.begin() + 1, pieces.front().points.end());
    pieces.erase(pieces.begin());
  }
  return pieces;
}

}  // namespace daumier::render
