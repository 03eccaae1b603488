#include "render/svg_areas.h"

#include "render/pen_areas.h"
#include "render/svg_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace daumier::render {
namespace {

/// Steps of a colour's channels: paints that differ by less are one ink. Colours that are read as ink.
constexpr double kColourSteps = 15.0;
constexpr size_t kMaxInks = 8;
/// Areas that may come from clips: a file can use one clip of many areas many times.
constexpr size_t kMaxClipAreas = 50'000;
/// From which an area hides what lies below.
constexpr double kLeastHidingAlpha = 0.5;

using InkColour = std::array<int, 3>;

/// On white.
InkColour ColourOf(const SvgColor& paint) {
  InkColour colour;
  for (int k = 0; k < 3; ++k)
    colour[size_t(k)] = static_cast<int>(std::lround(kColourSteps * (1.0 - paint.alpha * (1.0 - paint.rgb[k]))));
  return colour;
}

SvgPolyline PolylineOf(const Stroke& stroke) {
  SvgPolyline polyline;
  for (const auto& [x, y] : stroke.points) polyline.points.emplace_back(x, y);
  return polyline;
}

/// The ring that the stroke goes round, with its exact points; nothing if it is a middle line.
const SvgPolyline* OutlineOf(const SvgShape& shape, const Stroke& stroke) {
  for (const SvgPolyline& ring : shape.polylines) {
    const auto is_same = [](const std::array<float, 2>& point, const Eigen::Vector2d& of_ring) {
      return point[0] == float(of_ring.x()) && point[1] == float(of_ring.y());
    };
    if (std::ranges::equal(stroke.points, ring.points, is_same)) return &ring;
  }
  return nullptr;
}

/// The first clip that lies inside the shape, if that is a rectangle filled without a stroke; else the end.
std::vector<std::shared_ptr<const SvgClip>>::const_iterator ClipInside(const SvgShape& shape) {
  const auto& clips = shape.clips;
  if (!shape.fill || shape.stroke || shape.polylines.size() != 1) return clips.end();
  const auto rectangle = RectangleOf(shape.polylines[0]);
  if (!rectangle) return clips.end();
  return std::ranges::find_if(clips, [&](const auto& clip) {
    return !clip->areas().empty() && std::ranges::all_of(clip->areas(), [&](const SvgArea& area) {
      return std::ranges::all_of(area.rings, [&](const SvgPolyline& ring) {
        return std::ranges::all_of(ring.points, [&](const auto& point) { return rectangle->contains(point); });
      });
    });
  });
}

/// A shape as areas without the clips that lie inside it.
void AppendCut(SvgShape shape, std::vector<SvgShape>& shapes) {
  const auto clip = ClipInside(shape);
  if (clip == shape.clips.end() || shapes.size() + (*clip)->areas().size() > kMaxClipAreas) {
    shapes.push_back(std::move(shape));
    return;
  }
  const std::shared_ptr<const SvgClip> kept = *clip;
  shape.clips.erase(clip);
  for (const SvgArea& area : kept->areas()) {
    SvgShape part = shape;
    part.polylines = area.rings;
    part.fill_rule = area.rule;
    part.is_fill_given = true;
    for (SvgPolyline& ring : part.polylines)
      if (!ring.points.empty() && ring.points.front() != ring.points.back()) ring.points.push_back(ring.points.front());
    std::erase_if(part.polylines, [](const SvgPolyline& ring) { return ring.points.empty(); });
    if (!part.polylines.empty()) AppendCut(std::move(part), shapes);
  }
}

/// The colours of areas by their number of shapes, the most first.
std::vector<InkColour> InksOf(const std::map<InkColour, std::vector<int>>& shapes_of) {
  std::vector<InkColour> inks;
  for (const auto& [colour, shapes] : shapes_of) inks.push_back(colour);
  std::ranges::stable_sort(
      inks, [&](const InkColour& a, const InkColour& b) { return shapes_of.at(a).size() > shapes_of.at(b).size(); });
  inks.resize(std::min(inks.size(), kMaxInks));
  return inks;
}

}  // namespace

FilledArea FilledAreaOf(const SvgShape& shape) {
  FilledArea area{{}, shape.fill_rule};
  for (const SvgPolyline& polyline : shape.polylines) area.outlines.push_back(polyline.points);
  return area;
}

void CutAreasByClips(SvgScene& scene) {
  std::vector<SvgShape> shapes;
  for (SvgShape& shape : scene.shapes) AppendCut(std::move(shape), shapes);
  scene.shapes = std::move(shapes);
}

std::vector<std::vector<SvgAreaLine>> LinesOfAreas(const SvgScene& scene, const std::vector<AreaReading>& reading,
                                                   double side) {
  std::vector<std::vector<SvgAreaLine>> lines(scene.shapes.size());
  std::vector<PaintedArea> areas;
  std::vector<int> shape_of;  // Of each area.
  std::map<InkColour, std::vector<int>> shapes_of;
  for (size_t i = 0; i < scene.shapes.size(); ++i) {
    const SvgShape& shape = scene.shapes[i];
    // What lies below a tint is still seen.
    const bool has_lines = reading[i] == AreaReading::kOutlines || reading[i] == AreaReading::kPen;
    if (!shape.fill || (!has_lines && shape.fill->alpha < kLeastHidingAlpha)) continue;
    areas.push_back({FilledAreaOf(shape), Paint::kPaper, shape.kind, shape.drawn_lines});
    shape_of.push_back(static_cast<int>(i));
    if (reading[i] == AreaReading::kPen) shapes_of[ColourOf(*shape.fill)].push_back(static_cast<int>(i));
    if (!has_lines) continue;
    for (const SvgPolyline& ring : shape.polylines) lines[i].push_back({ring, std::nullopt});
  }
  for (const InkColour& ink : InksOf(shapes_of)) {
    for (size_t a = 0; a < areas.size(); ++a) {
      const auto shape = static_cast<size_t>(shape_of[a]);
      const bool is_ink = reading[shape] == AreaReading::kPen && ColourOf(*scene.shapes[shape].fill) == ink;
      areas[a].paint = is_ink ? Paint::kInk : Paint::kPaper;
    }
    const std::vector<std::vector<Stroke>> strokes = StrokesOfAreas(areas, side);
    for (size_t a = 0; a < areas.size(); ++a) {
      if (areas[a].paint == Paint::kPaper) continue;
      const auto index = static_cast<size_t>(shape_of[a]);
      lines[index].clear();
      for (const Stroke& stroke : strokes[a]) {
        const SvgPolyline* const outline = OutlineOf(scene.shapes[index], stroke);
        if (outline != nullptr) {
          lines[index].push_back({*outline, std::nullopt});
        } else {
          lines[index].push_back({PolylineOf(stroke), shapes_of.at(ink).back()});
        }
      }
    }
  }
  return lines;
}

}  // namespace daumier::render
