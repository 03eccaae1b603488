#include "fitting/stroke_distance.h"

#include "core/error.h"
#include "fitting/stroke_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::fitting {
namespace {

using Eigen::Vector2f;

constexpr float kStepPx = 1.0f;

/// Segments laid out coordinate by coordinate, so that one point is held against all of them at once.
class AllSegments {
 public:
  explicit AllSegments(const std::vector<Segment>& segments)
      : from_(2, Eigen::Index(segments.size())), along_(2, from_.cols()) {
    for (Eigen::Index i = 0; i < from_.cols(); ++i) {
      from_.col(i) = segments[size_t(i)].from;
      along_.col(i) = segments[size_t(i)].to - segments[size_t(i)].from;
    }
    inverse_length2_ = (along_.colwise().squaredNorm().array() + std::numeric_limits<float>::min()).inverse();
  }

  float DistanceTo(const Vector2f& point) const {
    const auto x = (point.x() - from_.row(0).array()).eval(), y = (point.y() - from_.row(1).array()).eval();
    const auto share =
        ((x * along_.row(0).array() + y * along_.row(1).array()) * inverse_length2_).min(1.0f).max(0.0f).eval();
    return std::sqrt(
        ((x - share * along_.row(0).array()).square() + (y - share * along_.row(1).array()).square()).minCoeff());
  }

 private:
  Eigen::Matrix<float, 2, Eigen::Dynamic, Eigen::RowMajor> from_, along_;
  Eigen::Array<float, 1, Eigen::Dynamic> inverse_length2_;
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
  const AllSegments targets(to);
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
