#include "datasets/read/pen_effects.h"

#include "core/error.h"
#include "datasets/read/stroke_arc.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {

using Eigen::Vector2d;

render::Stroke Jitter(render::Stroke stroke, double rms_px, double length_px, Rng& rng) {
  const std::vector<double> arc_lengths = StrokeArc(stroke).arc_lengths();
  if (arc_lengths.empty()) return stroke;
  const double length = arc_lengths.back();
  const bool closed = IsClosed(stroke) && length > 0;
  const int num_spans = closed ? std::max(4, static_cast<int>(std::lround(length / length_px)))
                               : static_cast<int>(length / length_px) + 1;
  const double span = closed ? length / num_spans : length_px;

  const double mean_square = 151.0 / 315.0;  // Of a sum of cubic B-splines with coefficients of variance 1.
  const double amplitude = rms_px / std::sqrt(mean_square);
  std::vector<Vector2d> coefficients(num_spans + 3);
  for (int i = 0; i < num_spans + 3; ++i) {
    if (closed && i >= num_spans) {
      coefficients[i] = coefficients[i - num_spans];
      continue;
    }
    const double x = rng.Normal(), y = rng.Normal();
    coefficients[i] = amplitude * Vector2d(x, y);
  }
  for (size_t i = 0; i < arc_lengths.size(); ++i) {
    const int k = std::min(static_cast<int>(arc_lengths[i] / span), num_spans - 1);
    const double t = arc_lengths[i] / span - k, s = 1 - t;
    const Vector2d offset = (s * s * s * coefficients[k] + (3 * t * t * t - 6 * t * t + 4) * coefficients[k + 1] +
                             (3 * s * s * s - 6 * s * s + 4) * coefficients[k + 2] + t * t * t * coefficients[k + 3]) /
                            6;
    stroke.points[i] = ToPoint(ToVector(stroke.points[i]) + offset);
  }
  if (closed) stroke.points.back() = stroke.points.front();
  return stroke;
}

CutStroke CutOut(const render::Stroke& stroke, double begin, double end) {
  DAUMIER_CHECK(begin <= end, "a gap from {} to {} pixels", begin, end);
  const StrokeArc arc(stroke);
  const bool has_first = begin > 0, has_last = end < arc.length();
  render::Stroke first{stroke.kind, {}}, last{stroke.kind, {}};
  CutStroke cut;
  if (has_last) last.points.push_back(ToPoint(arc.PointAt(end)));
  for (size_t i = 0; i < stroke.points.size(); ++i) {
    const double arc_length = arc.arc_lengths()[i];
    if (arc_length < begin) first.points.push_back(stroke.points[i]);
    if (arc_length > end) last.points.push_back(stroke.points[i]);
    cut.visible.push_back((has_first && arc_length <= begin) || (has_last && arc_length >= end));
  }
  if (has_first) {
    first.points.push_back(ToPoint(arc.PointAt(begin)));
    cut.pieces.push_back(std::move(first));
  }
  if (has_last) cut.pieces.push_back(std::move(last));
  return cut;
}

}  // namespace daumier::datasets
