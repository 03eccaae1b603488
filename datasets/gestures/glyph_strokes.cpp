#include "datasets/gestures/glyph_strokes.h"

#include "datasets/gestures/path_pen.h"

#include <array>
#include <sstream>

namespace daumier::datasets {
namespace {

struct GlyphText {
  const char *name, *points;  ///< x and y by turns.
};

constexpr std::array kGlyphTexts = {
    GlyphText{"a", "8 2 4 1 1 5 4 9 8 5 8 1 8 8 10 9"},
    GlyphText{"b", "2 0 2 5 2 10 2 6 6 4 8 7 6 10 2 9"},
    GlyphText{"c", "9 2 5 0 1 5 5 10 9 8"},
    GlyphText{"d", "7 4 3 4 1 7 4 10 7 7 7 0 7 10"},
    GlyphText{"e", "1 5 8 5 7 1 4 0 1 4 2 9 6 10 9 8"},
    GlyphText{"f", "8 1 5 0 4 4 4 10"},
    GlyphText{"g", "7 1 3 0 1 3 3 6 7 4 7 0 7 8 4 10 1 9"},
    GlyphText{"h", "1 0 1 5 1 10 1 6 4 4 7 6 7 10"},
    GlyphText{"k", "1 0 1 5 1 10 1 6 7 3 3 6 7 10"},
    GlyphText{"m", "0 10 0 4 0 6 2 4 4 6 4 10 4 6 6 4 8 6 8 10"},
    GlyphText{"n", "1 10 1 4 1 6 4 4 7 6 7 10"},
    GlyphText{"p", "2 10 2 6 2 3 2 4 6 3 8 5 6 7 2 7"},
    GlyphText{"q", "8 4 4 3 2 5 4 8 8 6 8 4 8 10 10 9"},
    GlyphText{"r", "1 10 1 4 1 6 4 4 7 5"},
    GlyphText{"s", "8 1 4 0 1 2 4 5 8 7 5 10 1 9"},
    GlyphText{"t", "3 0 3 8 5 10 8 9"},
    GlyphText{"u", "0 0 0 7 3 10 7 7 7 0 7 10"},
    GlyphText{"w", "0 0 2 10 5 3 8 10 10 0"},
    GlyphText{"x", "0 0 8 10 8 0 0 10"},
    GlyphText{"y", "0 0 3 5 8 0 5 6 2 11"},
    GlyphText{"z", "0 0 8 0 0 10 8 10"},
    GlyphText{"A", "0 10 4 0 8 10 7 6 2 6"},
    GlyphText{"B", "1 10 1 0 6 1 6 4 1 5 7 6 7 9 1 10"},
    GlyphText{"E", "8 1 4 0 2 2 5 5 1 8 4 10 9 9"},
    GlyphText{"G", "9 2 5 0 1 5 5 10 9 8 9 5 6 5"},
    GlyphText{"H", "1 0 1 10 1 5 8 5 8 0 8 10"},
    GlyphText{"J", "7 0 7 8 4 10 1 8"},
    GlyphText{"K", "1 0 1 10 1 5 8 0 1 5 8 10"},
    GlyphText{"M", "0 10 1 0 5 7 9 0 10 10"},
    GlyphText{"N", "0 10 0 0 8 10 8 0"},
    GlyphText{"P", "1 10 1 0 7 1 7 4 1 5"},
    GlyphText{"R", "1 10 1 0 7 1 7 4 1 5 8 10"},
    GlyphText{"W", "0 0 3 10 5 3 7 10 10 0"},
    GlyphText{"Y", "0 0 4 5 8 0 4 5 4 10"},
    GlyphText{"1", "1 4 5 0 5 10"},
    GlyphText{"2", "1 2 4 0 8 2 6 6 1 10 8 10"},
    GlyphText{"3", "1 1 5 0 8 2 4 5 8 7 5 10 1 9"},
    GlyphText{"4", "6 10 6 0 0 7 9 7"},
    GlyphText{"4 open", "1 0 1 6 8 6 6 6 6 2 6 10"},
    GlyphText{"5", "8 0 2 0 1 5 6 4 8 7 5 10 1 9"},
    GlyphText{"6", "8 1 3 3 1 7 4 10 8 7 5 5 1 7"},
    GlyphText{"7", "0 0 8 0 3 10"},
    GlyphText{"8", "7 2 4 0 1 2 4 5 8 8 4 10 1 8 4 5 7 2"},
    GlyphText{"9", "8 3 4 5 1 2 4 0 8 3 7 10"},
    GlyphText{"and", "9 10 2 3 4 0 6 2 1 8 4 10 8 6"},
    GlyphText{"query", "1 2 4 0 8 2 6 5 4 6 4 10"},
    GlyphText{"alpha", "9 1 6 7 3 9 1 5 3 1 6 4 9 9"},
    GlyphText{"phi", "4 10 4 5 4 2 1 4 1 7 4 8 7 7 7 4 4 2"},
    GlyphText{"lightning", "5 0 1 6 5 5 2 10"},
    GlyphText{"brace", "6 0 4 1 4 4 2 5 4 6 4 9 6 10"},
    GlyphText{"bracket", "6 0 2 0 2 10 6 10"},
    GlyphText{"star", "1 4 9 4 2 9 5 0 8 9 1 4"},
    GlyphText{"fish", "9 1 3 8 0 5 3 2 9 9"},
    GlyphText{"house", "0 10 0 4 4 0 8 4 8 10"},
    GlyphText{"hour glass", "1 0 8 0 1 10 8 10 1 0"},
    GlyphText{"cross", "1 5 9 5 5 5 5 1 5 9"},
    GlyphText{"tee", "0 0 9 0 5 0 5 10"},
    GlyphText{"anchor", "5 0 5 10 2 10 0 7 2 10 8 10 10 7"},
};

Polyline PointsOf(const char* text) {
  Polyline points;
  std::istringstream numbers(text);
  for (double x, y; numbers >> x >> y;) points.emplace_back(x, y);
  return points;
}

}  // namespace

const std::vector<Glyph>& Glyphs() {
  static const std::vector<Glyph> glyphs = [] {
    std::vector<Glyph> list;
    for (const GlyphText& text : kGlyphTexts) list.push_back({text.name, PointsOf(text.points)});
    return list;
  }();
  return glyphs;
}

Polyline DrawGlyph(Rng& rng) {
  Polyline points = Glyphs()[rng.Below(Glyphs().size())].points;
  for (Eigen::Vector2d& point : points) point += 0.5 * Eigen::Vector2d{rng.Normal(), rng.Normal()};
  const Polyline line = Happens(0.65, rng) ? Smooth(points, 240) : Resampled(points, 240);
  const double slant = Deviate(0.2, rng);
  Polyline written;
  for (const Eigen::Vector2d& point : line) written.emplace_back(point.x() - slant * point.y(), point.y());
  const Polyline sized = Scaled(written, 1, LogUniform(0.6, 1.6, rng));
  return Turned(sized, Deviate(0.12, rng));
}

}  // namespace daumier::datasets
