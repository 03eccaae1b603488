#include "render/svg_ink.h"

#include "core/error.h"
#include "render/svg_areas.h"
#include "render/svg_canvas.h"
#include "render/svg_grounds.h"
#include "render/svg_rings.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// How far beyond the sheet a line may lie as a whole, in sides of the sheet.
constexpr double kSheetMargin = 0.1;
/// How far the canvas reaches beyond the sheet, in sides of the sheet.
constexpr double kCanvasMargin = 0.5;
/// Share of the sheet that a frame covers at least to be one without doubt.
constexpr double kFrameShare = 0.6;
/// Height of a straight line at most, as a share of its length; length of a frame's line at least, as a share of the
/// side of what it frames.
constexpr double kStraightness = 0.01, kFrameLine = 0.8;
/// Share of a line that is seen from which the line is kept as a whole.
constexpr double kWholeShare = 0.97;
/// Share of a middle line that is seen from which it is kept; on the rest it crosses other areas of its colour.
constexpr double kMiddleLineShare = 0.3;
/// Steps of the canvas: the shortest piece that is kept of a line; how far from an outline its area is seen.
constexpr double kShortestPiece = 4.0, kOutlineMargin = 1.5;
constexpr int kMaxSamplesOfSegment = 4096, kMaxSamplesOfLine = 65536;

/// A line that may be ink: seen from the sheet until a later shape hides it.
struct InkLine {
  SvgPolyline polyline;
  int shape = 0, kind = 0;
  double half_width = 0.0;
  std::optional<AlignedBox2d> rectangle;  ///< Of which it is a part: its box.
};

double LengthOf(const SvgPolyline& polyline) {
  const auto& points = polyline.points;
  double length = 0.0;
  for (size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// A step of the canvas, or longer: of a drawing far larger than its sheet a line would have millions of samples.
double StepOn(const SvgPolyline& polyline, double step) {
  return std::max(step, LengthOf(polyline) / kMaxSamplesOfLine);
}

/// Calls `visit(point, normal)` along a line at steps of the canvas, normal being of length 1.
template <class Visit>
void Walk(const SvgPolyline& polyline, double canvas_step, Visit&& visit) {
  const auto& points = polyline.points;
  const double step = StepOn(polyline, canvas_step);
  if (points.size() == 1) return visit(points[0], Vector2d(0, 1));
  for (size_t i = 1; i < points.size(); ++i) {
    const Vector2d along = points[i] - points[i - 1];
    if (along.norm() == 0.0) continue;
    const Vector2d normal = Vector2d(-along.y(), along.x()).normalized();
    const int num_samples =
        static_cast<int>(std::clamp(std::ceil(along.norm() / step), 1.0, double(kMaxSamplesOfSegment)));
    for (int s = 0; s < num_samples; ++s) visit(points[i - 1] + (s + 0.5) / num_samples * along, normal);
  }
}

template <class IsSeen>
double SeenShare(const SvgPolyline& polyline, double step, IsSeen&& is_seen) {
  int64_t num_seen = 0, num_samples = 0;
  Walk(polyline, step, [&](const Vector2d& point, const Vector2d& normal) {
    num_seen += is_seen(point, normal) ? 1 : 0;
    ++num_samples;
  });
  return num_samples > 0 ? static_cast<double>(num_seen) / static_cast<double>(num_samples) : 0.0;
}

/// The pieces of a line on which `is_seen(point, normal)` holds; the whole line if that is nearly everywhere.
template <class IsSeen>
std::vector<SvgPolyline> SeenPieces(const SvgPolyline& polyline, double canvas_step, IsSeen&& is_seen) {
  const double step = StepOn(polyline, canvas_step);
  const double share = SeenShare(polyline, step, is_seen);
  if (share == 0.0) return {};
  if (share >= kWholeShare) return {polyline};

  std::vector<SvgPolyline> pieces;
  const auto& points = polyline.points;
  bool open = false;
  const auto append = [&](const Vector2d& point) {
    if (!open) pieces.emplace_back();
    open = true;
    if (pieces.back().points.empty() || pieces.back().points.back() != point) pieces.back().points.push_back(point);
  };
  for (size_t i = 1; i < points.size(); ++i) {
    int sample = 0;
    const Vector2d along = points[i] - points[i - 1];
    const double count = std::clamp(std::ceil(along.norm() / step), 1.0, double(kMaxSamplesOfSegment));
    Walk({{points[i - 1], points[i]}}, step, [&](const Vector2d& point, const Vector2d& normal) {
      if (is_seen(point, normal)) {
        append(sample == 0 ? points[i - 1] : Vector2d(points[i - 1] + sample / count * along));
      } else if (open) {
        if (sample > 0) append(points[i - 1] + sample / count * along);
        open = false;
      }
      ++sample;
    });
    if (open) append(points[i]);
  }
  std::erase_if(pieces, [&](const SvgPolyline& piece) { return LengthOf(piece) < kShortestPiece * canvas_step; });
  return pieces;
}

class InkReader {
 public:
  InkReader(const SvgScene& scene, const SvgColor& paper)
      : scene_(scene), canvas_(CanvasBox(scene), paper, SideOfCanvas(scene, paper)), work_(scene.file) {
    const double side = CanvasBox(scene).sizes().maxCoeff();
    reading_ = ReadingOfAreas(scene, paper, side);
    area_lines_ = LinesOfAreas(scene, reading_, side);
  }

  std::vector<InkLine> Read() {
    for (int index = 0; index < std::ssize(scene_.shapes); ++index) {
      const SvgShape& shape = scene_.shapes[index];
      const auto lines = LinesOf(shape, index);
      if (shape.fill) canvas_.PaintArea(shape, index);
      if (shape.stroke && shape.stroke->alpha >= 0.5 && Erases(shape)) canvas_.Erase(shape, index, kInkContrast);
      lines_.insert(lines_.end(), lines.begin(), lines.end());
    }
    return WithoutHidden();
  }

 private:
  /// All that is drawn, but not much more than the sheet where there is one.
  static AlignedBox2d CanvasBox(const SvgScene& scene) {
    AlignedBox2d box;
    for (const auto& shape : scene.shapes) box.extend(BoxOfLines(shape.polylines));
    const Vector2d size(scene.width, scene.height);
    if (size.minCoeff() > 0.0) {
      box = box.intersection(AlignedBox2d(-kCanvasMargin * size, (1.0 + kCanvasMargin) * size));
    }
    if (box.isEmpty()) box = AlignedBox2d(Vector2d(0, 0), Vector2d(1, 1));
    const double margin = 0.01 * box.sizes().maxCoeff() + 1e-6;
    return {box.min().array() - margin, box.max().array() + margin};
  }

  /// Strokes alone that differ from the paper need no picture of what lies below.
  static double SideOfCanvas(const SvgScene& scene, const SvgColor& paper) {
    const bool is_plain = std::all_of(scene.shapes.begin(), scene.shapes.end(), [&](const SvgShape& shape) {
      return !shape.fill && PaintContrast(*shape.stroke, paper.rgb) >= kInkContrast;
    });
    return is_plain ? 1.0 : SvgCanvas::SideFor(CanvasBox(scene), scene.shapes);
  }

  /// The strokes of a shape, or else the lines of its area, where they differ from what lies below.
  std::vector<InkLine> LinesOf(const SvgShape& shape, int index) {
    const bool has_seen_stroke = shape.stroke && reading_[size_t(index)] != AreaReading::kShade && IsStrokeSeen(shape);
    std::vector<InkLine> lines;
    const auto add = [&](const SvgPolyline& whole, double half_width, const auto& is_ink) {
      for (const auto& polyline : Clipped(whole, shape))
        for (auto& piece : SeenPieces(polyline, canvas_.step(), is_ink))
          lines.push_back({std::move(piece), index, shape.kind, half_width, RectangleOf(whole)});
    };
    if (has_seen_stroke) {
      for (const auto& polyline : shape.polylines) {
        const bool has_area = shape.fill && HasInside(polyline);
        add(polyline, 0.5 * shape.stroke_width, [&](const Vector2d& point, const Vector2d& normal) {
          return PaintContrast(*shape.stroke, canvas_.ColorAt(point)) >= kInkContrast ||
                 (has_area && IsAreaSeen(shape, point, normal));
        });
      }
    } else if (shape.fill && !CoversSheet(scene_, shape)) {
      for (const auto& [line, last_of_colour] : area_lines_[size_t(index)]) {
        const auto is_seen = [&](const Vector2d& point, const Vector2d& normal) {
          return IsAreaSeen(shape, point, normal);
        };
        // Hand-written files leave out fill='none' and stroke; where they have a stroke, no area is no line.
        if (line.points.size() == 1 || (shape.is_stroke_given && !HasInside(line))) continue;
        if (!last_of_colour) {
          add(line, 0.0, is_seen);
        } else if (SeenShare(line, canvas_.step(), is_seen) >= kMiddleLineShare) {
          for (auto& piece : Clipped(line, shape))
            lines.push_back({std::move(piece), *last_of_colour, shape.kind, 0.0, RectangleOf(line)});
        }
      }
    }
    return lines;
  }

  bool IsStrokeSeen(const SvgShape& shape) const {
    bool seen = false;
    for (const auto& polyline : shape.polylines) {
      Walk(polyline, canvas_.step(), [&](const Vector2d& point, const Vector2d&) {
        seen = seen || PaintContrast(*shape.stroke, canvas_.ColorAt(point)) >= kInkContrast;
      });
    }
    return seen;
  }

  bool Erases(const SvgShape& shape) const {
    bool erases = false;
    for (const auto& polyline : shape.polylines) {
      Walk(polyline, canvas_.step(), [&](const Vector2d& point, const Vector2d&) {
        erases = erases || PaintContrast(*shape.stroke, canvas_.ColorAt(point)) < kInkContrast;
      });
    }
    return erases;
  }

  /// Whether the colour of an area differs from what lies below, on its border or on either side of it.
  bool IsAreaSeen(const SvgShape& shape, const Vector2d& point, const Vector2d& normal) const {
    const Vector2d offset = kOutlineMargin * canvas_.step() * normal;
    for (const Vector2d& at : {point, Vector2d(point + offset), Vector2d(point - offset)})
      if (PaintContrast(*shape.fill, canvas_.ColorAt(at)) >= kInkContrast) return true;
    return false;
  }

  std::vector<SvgPolyline> Clipped(const SvgPolyline& polyline, const SvgShape& shape) {
    std::vector<SvgPolyline> pieces{polyline};
    for (const auto& clip : shape.clips) {
      std::vector<SvgPolyline> inside;
      for (const auto& piece : pieces) {
        auto parts = clip->Clip(piece, work_);
        std::move(parts.begin(), parts.end(), std::back_inserter(inside));
      }
      pieces = std::move(inside);
    }
    return pieces;
  }

  std::vector<InkLine> WithoutHidden() const {
    std::vector<InkLine> seen;
    for (const InkLine& line : lines_) {
      const double offset = std::max(0.7 * line.half_width, kOutlineMargin * canvas_.step());
      auto pieces = SeenPieces(line.polyline, canvas_.step(), [&](const Vector2d& point, const Vector2d& normal) {
        return !canvas_.IsHidden(point, line.shape) || !canvas_.IsHidden(point + offset * normal, line.shape) ||
               !canvas_.IsHidden(point - offset * normal, line.shape);
      });
      for (auto& piece : pieces)
        seen.push_back({std::move(piece), line.shape, line.kind, line.half_width, line.rectangle});
    }
    return seen;
  }

  const SvgScene& scene_;
  SvgCanvas canvas_;
  SvgWork work_;
  std::vector<AreaReading> reading_;                  ///< Of each shape.
  std::vector<std::vector<SvgAreaLine>> area_lines_;  ///< Of each shape.
  std::vector<InkLine> lines_;
};

/// Whether a line lies inside a rectangle, or is part of nearly the same one.
bool LiesInside(const InkLine& line, const AlignedBox2d& rectangle) {
  const double margin = 0.01 * rectangle.sizes().maxCoeff();
  const AlignedBox2d grown(rectangle.min().array() - margin, rectangle.max().array() + margin);
  if (grown.contains(BoxOfLine(line.polyline))) return true;
  if (!line.rectangle) return false;
  const AlignedBox2d both = line.rectangle->intersection(rectangle);
  return !both.isEmpty() && both.volume() >= 0.8 * line.rectangle->merged(rectangle).volume();
}

/// Removes rectangles around all other lines, from outside to inside.
void RemoveFrames(SvgScene& scene, std::vector<InkLine>& lines) {
  const auto is_part = [](const InkLine& line) { return line.rectangle.has_value(); };
  if (std::all_of(lines.begin(), lines.end(), is_part)) return;
  for (size_t i = 0; i < lines.size();) {
    const auto box = lines[i].rectangle;
    const auto lies_inside = [&](const InkLine& line) { return LiesInside(line, *box); };
    if (!box || !std::all_of(lines.begin(), lines.end(), lies_inside)) {
      ++i;
      continue;
    }
    if (scene.width * scene.height > 0.0 && box->volume() < kFrameShare * scene.width * scene.height) {
      scene.problems.push_back(fmt::format("{}: a rectangle of {:.4g} x {:.4g} around all else is taken for a frame",
                                           scene.file, box->sizes().x(), box->sizes().y()));
    }
    lines.erase(lines.begin() + static_cast<ptrdiff_t>(i));
    i = 0;
  }
}

/// Removes straight lines along the axes that together surround all others: a frame of single lines. Each lies beyond
/// the others' box, and reaches along most of that side.
void RemoveFrameOfLines(std::vector<InkLine>& lines) {
  const auto is_straight = [](const InkLine& line) {
    const Vector2d size = BoxOfLine(line.polyline).sizes();
    return line.polyline.points.size() > 1 && size.minCoeff() <= kStraightness * size.maxCoeff();
  };
  AlignedBox2d inside;
  for (const auto& line : lines)
    if (!is_straight(line)) inside.extend(BoxOfLine(line.polyline));
  if (inside.isEmpty()) return;
  // -1 and +1: beyond the smaller and the larger coordinate of an axis.
  const auto side_of = [&](const InkLine& line) -> std::optional<std::pair<int, int>> {
    const AlignedBox2d box = BoxOfLine(line.polyline);
    const int along = box.sizes().x() >= box.sizes().y() ? 0 : 1, across = 1 - along;
    if (!is_straight(line) || box.sizes()[along] < kFrameLine * inside.sizes()[along]) return std::nullopt;
    if (box.max()[across] <= inside.min()[across]) return std::pair(across, -1);
    if (box.min()[across] >= inside.max()[across]) return std::pair(across, 1);
    return std::nullopt;
  };
  std::set<std::pair<int, int>> sides;
  for (const auto& line : lines)
    if (const auto side = side_of(line)) sides.insert(*side);
  if (sides.size() == 4) std::erase_if(lines, [&](const InkLine& line) { return side_of(line).has_value(); });
}

/// Removes lines that lie far from the sheet while others do not.
void RemoveOutside(SvgScene& scene, std::vector<InkLine>& lines) {
  const Vector2d size(scene.width, scene.height);
  if (size.minCoeff() <= 0.0) return;
  const AlignedBox2d sheet(-kSheetMargin * size, (1.0 + kSheetMargin) * size);
  const auto is_outside = [&](const InkLine& line) { return !sheet.intersects(BoxOfLine(line.polyline)); };
  const auto num_outside = std::count_if(lines.begin(), lines.end(), is_outside);
  if (num_outside == 0 || num_outside == std::ssize(lines)) return;
  std::erase_if(lines, is_outside);
  scene.problems.push_back(fmt::format("{}: {} strokes outside the sheet are left out", scene.file, num_outside));
}

/// What areas hide and which of their outlines are lines costs by pairs of their points.
void CheckAreas(const SvgScene& scene) {
  for (const SvgShape& shape : scene.shapes) {
    size_t num_points = 0;
    for (const SvgPolyline& polyline : shape.polylines) num_points += polyline.points.size();
    DAUMIER_CHECK(
        !shape.fill || num_points <= kMostPointsOfArea,
        "{}: a filled path has {} points (expected at most {}). Simplify it, or give it fill=\"none\" and a stroke",
        scene.file, num_points, kMostPointsOfArea);
  }
}

}  // namespace

std::vector<Stroke> InkOfScene(SvgScene& scene) {
  if (scene.shapes.empty()) return {};
  CheckAreas(scene);
  const SvgColor white{Vector3d::Ones(), 1.0};
  SvgColor paper = scene.background.value_or(SvgColor{Vector3d::Ones(), 0.0});
  paper.rgb = paper.alpha * paper.rgb + (1.0 - paper.alpha) * white.rgb;
  CutAreasByClips(scene);
  JoinStrokesWithAreas(scene);
  std::vector<InkLine> lines = InkReader(scene, paper).Read();
  if (lines.empty()) {
    lines = InkReader(scene, SvgColor{Vector3d::Zero(), 1.0}).Read();
    if (std::all_of(lines.begin(), lines.end(), [](const auto& line) { return line.rectangle.has_value(); }))
      lines.clear();
    if (!lines.empty())
      scene.problems.push_back(scene.file + ": all strokes are as light as paper; the sheet is taken as dark");
  }
  RemoveOutside(scene, lines);
  RemoveFrames(scene, lines);
  RemoveFrameOfLines(lines);
  std::vector<Stroke> strokes;
  for (const InkLine& line : lines) {
    Stroke stroke{.kind = line.kind, .points = {}};
    for (const Vector2d& point : line.polyline.points) stroke.points.push_back({float(point.x()), float(point.y())});
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

}  // namespace daumier::render
