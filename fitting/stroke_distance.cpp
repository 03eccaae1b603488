#include "fitting/stroke_distance.h"

#include "core/error.h"
#include "fitting/stroke_segments.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace daumier::fitting {
namespace {

using Eigen::Vector2f;

constexpr float kStepPx = 1.0f;
/// Of one side; longer lines are sampled more coarsely.
constexpr double kMostDistanceSamples = 12000;

/// The bits of a number below 2^16 at the even places of the result.
uint32_t SpreadBits(uint32_t bits) {
  bits = (bits | bits << 8) & 0x00FF00FFU;
  bits = (bits | bits << 4) & 0x0F0F0F0FU;
  bits = (bits | bits << 2) & 0x33333333U;
  return (bits | bits << 1) & 0x55555555U;
}

/// Along a curve that keeps what is near in the plane near [Morton 1966].
std::vector<Segment> InSpatialOrder(const std::vector<Segment>& segments) {
  Eigen::AlignedBox2f box;
  for (const Segment& segment : segments) box.extend(segment.from), box.extend(segment.to);
  constexpr float kSmallest = 1e-20f;  // Of a box with an order; a single dot has none.
  const float size = box.sizes().maxCoeff(), scale = size > kSmallest ? 65535.0f / size : 0.0f;
  std::vector<std::pair<uint32_t, size_t>> order;
  for (size_t i = 0; i < segments.size(); ++i) {
    const Vector2f place =
        (scale * (0.5f * (segments[i].from + segments[i].to) - box.min())).cwiseMax(0).cwiseMin(65535);
    order.emplace_back(SpreadBits(uint32_t(place.x())) | SpreadBits(uint32_t(place.y())) << 1, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Segment> ordered;
  for (const auto& [code, index] : order) ordered.push_back(segments[index]);
  return ordered;
}

/// Segments in blocks of neighbours, and these in blocks again, with their bounding boxes, so that most segments are
/// never held against a point.
class SegmentBlocks {
 public:
  explicit SegmentBlocks(const std::vector<Segment>& segments) : segments_(InSpatialOrder(segments)) {
    boxes_.resize((segments_.size() + kBlock - 1) / kBlock);
    outer_boxes_.resize((boxes_.size() + kBlock - 1) / kBlock);
    for (size_t i = 0; i < segments_.size(); ++i) {
      for (Eigen::AlignedBox2f* box : {&boxes_[i / kBlock], &outer_boxes_[i / (kBlock * kBlock)]})
        box->extend(segments_[i].from), box->extend(segments_[i].to);
    }
  }

  /// Fastest where each point is near to the one before.
  float DistanceTo(const Vector2f& point) {
    float best = SquaredDistance(point, segments_[last_nearest_]);
    for (size_t outer = 0; outer < outer_boxes_.size(); ++outer) {
      if (outer_boxes_[outer].squaredExteriorDistance(point) >= best) continue;
      for (size_t block = outer * kBlock; block < std::min((outer + 1) * kBlock, boxes_.size()); ++block) {
        if (boxes_[block].squaredExteriorDistance(point) >= best) continue;
        for (size_t i = block * kBlock; i < std::min((block + 1) * kBlock, segments_.size()); ++i) {
          const float squared = SquaredDistance(point, segments_[i]);
          if (squared < best) best = squared, last_nearest_ = i;
        }
      }
    }
    return std::sqrt(best);
  }

 private:
  static constexpr size_t kBlock = 16;

  static float SquaredDistance(const Vector2f& point, const Segment& segment) {
    return (segment.Nearest(point) - point).squaredNorm();
  }

  std::vector<Segment> segments_;
  std::vector<Eigen::AlignedBox2f> boxes_, outer_boxes_;
  size_t last_nearest_ = 0;
};

struct Sample {
  float distance, length;
};

/// The mean over the nearest 1 - trim of the length.
double TrimmedMean(std::vector<Sample> samples, double trim) {
  double total = 0.0, counted = 0.0, sum = 0.0;
  for (const Sample& sample : samples) total += sample.length;
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.distance < b.distance; });
  for (const Sample& sample : samples) {
    const double length = std::min<double>(sample.length, (1.0 - trim) * total - counted);
    if (length <= 0.0) break;
    counted += length;
    sum += length * sample.distance;
  }
  return sum / counted;
}

double OneWay(const std::vector<Segment>& from, const std::vector<Segment>& to, double trim) {
  SegmentBlocks targets(to);
  double total = 0;
  for (const Segment& segment : from) total += (segment.to - segment.from).norm();
  const auto step = float(std::max<double>(kStepPx, total / kMostDistanceSamples));
  std::vector<Sample> samples;
  for (const Segment& segment : from) {
    const float length = (segment.to - segment.from).norm();
    const int num_parts = static_cast<int>(std::ceil(length / step));
    for (int part = 0; part < num_parts; ++part) {
      const Vector2f point = segment.from + (float(part) + 0.5f) / float(num_parts) * (segment.to - segment.from);
      samples.push_back({targets.DistanceTo(point), length / float(num_parts)});
    }
  }
  DAUMIER_CHECK(!samples.empty(), "strokes without any length have no distance");
  return TrimmedMean(std::move(samples), trim);
}

}  // namespace

StrokeDistance DistanceBetween(const std::vector<render::Stroke>& drawn, const std::vector<render::Stroke>& projected,
                               double drawn_trim, double projected_trim) {
  for (const double trim : {drawn_trim, projected_trim})
    DAUMIER_CHECK(trim >= 0.0 && trim < 1.0, "a share of {} was to be trimmed, expected one from 0 to below 1", trim);
  const std::vector<Segment> drawn_segments = SegmentsOf(drawn), projected_segments = SegmentsOf(projected);
  DAUMIER_CHECK(!drawn_segments.empty() && !projected_segments.empty(), "strokes without any length have no distance");
  return {.drawn_to_projected = OneWay(drawn_segments, projected_segments, drawn_trim),
          .projected_to_drawn = OneWay(projected_segments, drawn_segments, projected_trim)};
}

}  // namespace daumier::fitting
