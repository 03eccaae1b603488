#include "render/stroke_samples.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

struct StraightPiece {
  std::array<float, 2> from, to;
  double length;
};

std::vector<StraightPiece> PiecesOf(const std::vector<Stroke>& strokes) {
  std::vector<StraightPiece> pieces;
  for (const Stroke& stroke : strokes) {
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      const auto& from = stroke.points[i - 1];
      const auto& to = stroke.points[i];
      const double length = std::hypot(double(to[0]) - from[0], double(to[1]) - from[1]);
      if (length > 0) pieces.push_back({from, to, length});
    }
  }
  return pieces;
}

}  // namespace

std::vector<StrokeSample> SampleStrokes(const std::vector<Stroke>& strokes, int count) {
  DAUMIER_CHECK(count > 0, "{} points cannot be sampled on strokes", count);
  const std::vector<StraightPiece> pieces = PiecesOf(strokes);
  DAUMIER_CHECK(!pieces.empty(), "there is no stroke to sample points on");
  double total = 0;
  for (const StraightPiece& piece : pieces) total += piece.length;

  std::vector<StrokeSample> samples;
  size_t current = 0;
  double begin = 0;  // Of the current piece.
  for (int i = 0; i < count; ++i) {
    const double at = (i + 0.5) / count * total;
    while (current + 1 < pieces.size() && at > begin + pieces[current].length) begin += pieces[current++].length;
    const auto& [from, to, length] = pieces[current];
    const double share = std::min((at - begin) / length, 1.0);
    const double dx = (double(to[0]) - from[0]) / length, dy = (double(to[1]) - from[1]) / length;
    samples.push_back({float(from[0] + share * (double(to[0]) - from[0])),
                       float(from[1] + share * (double(to[1]) - from[1])), float(dx * dx - dy * dy),
                       float(2 * dx * dy)});
  }
  return samples;
}

std::vector<float> SampleRows(const std::vector<Stroke>& strokes, int count) {
  const std::vector<StrokeSample> samples = SampleStrokes(strokes, count);
  constexpr float kHalf = 0.5f * kSketchCanvas;
  std::vector<float> rows;
  for (const StrokeSample& sample : samples) rows.push_back((sample.x - kHalf) / kHalf);
  for (const StrokeSample& sample : samples) rows.push_back((sample.y - kHalf) / kHalf);
  for (const StrokeSample& sample : samples) rows.push_back(sample.cos_double);
  for (const StrokeSample& sample : samples) rows.push_back(sample.sin_double);
  return rows;
}

}  // namespace daumier::render
