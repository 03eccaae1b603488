#include "fitting/stroke_distance.h"

#include "core/error.h"
#include "fitting/stroke_segments.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

using Eigen::Vector2f;

constexpr float kStepPx = 1.0f;

/// Segments in blocks of neighbours with their bounding boxes, so that most of them are never held against a point.
class SegmentBlocks {
 public:
  explicit SegmentBlocks(const std::vector<Segment>& segments) : segments_(segments) {
    for (size_t first = 0; first < segments.size(); first += kBlock) {
      Eigen::AlignedBox2f box;
      for (size_t i = first; i < std::min(first + kBlock, segments.size()); ++i)
        box.extend(segments[i].from), box.extend(segments[i].to);
      boxes_.push_back(box);
    }
  }

  /// Points in an order in which neighbours follow each other are fastest.
  float DistanceTo(const Vector2f& point) {
    float best = SquaredDistance(point, segments_[last_nearest_]);
    for (size_t block = 0; block < boxes_.size(); ++block) {
      if (boxes_[block].squaredExteriorDistance(point) >= best) continue;
      for (size_t i = block * kBlock; i < std::min((block + 1) * kBlock, segments_.size()); ++i) {
        const float squared = SquaredDistance(point, segments_[i]);
        if (squared < best) best = squared, last_nearest_ = i;
      }
    }
    return std::sqrt(best);
  }

 private:
  static constexpr size_t kBlock = 16;

  static float SquaredDistance(const Vector2f& point, const Segment& segment) {
    return (segment.Nearest(point) - point).squaredNorm();
  }

  const std::vector<Segment>& segments_;
  std::vector<Eigen::AlignedBox2f> boxes_;
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
  std::vector<Sample> samples;
  for (const Segment& segment : from) {
    const float length = (segment.to - segment.from).norm();
    const int num_parts = static_cast<int>(std::ceil(length / kStepPx));
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
