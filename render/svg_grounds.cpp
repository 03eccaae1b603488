#include "render/svg_grounds.h"

#include "render/area_pieces.h"
#include "render/svg_canvas.h"
#include "render/svg_rings.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <unordered_map>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Share of the sheet that a filled rectangle covers that is the sheet's colour.
constexpr double kSheetCover = 0.98;
/// Shorter side of a rectangle, as a share of the canvas, from which it is a sheet or a frame and no line of a pen.
constexpr double kSheetSide = 0.25;
/// Width of a pen, and how far from an outline something lies along it, as shares of the sheet.
constexpr double kWidestPen = 0.06, kAlong = 0.015;
/// Width of the stroke that tracers draw around slivers in their own colour, as a share of the sheet.
constexpr double kHairline = 0.01;
/// How much more than a wash, and than the shade of an edge, ink differs from the ground.
constexpr double kInkOverWash = 2.0, kInkOverShade = 1.2;
/// Thickness of an edge's shade, in that of its ink.
constexpr double kShadeThickness = 0.5;
/// Share of an outline along which ink lies, or of a shape that lies inside an area.
constexpr double kMostOf = 0.5;
/// Points by which that is found.
constexpr size_t kNumProbes = 48;
/// Pairs of shapes whose contrasts and boxes are compared at most, and pairs of which one is searched inside the other.
constexpr int64_t kMaxComparisons = 40'000'000, kMaxSearches = 60'000;
constexpr double kMaxCellsOfSegment = 1024.0;

/// What is known of a shape.
struct ShapeFacts {
  AlignedBox2d box;
  bool is_ground = false;  ///< Covers the sheet, or is a large rectangle.
  Vector3d ground;         ///< The colour below it.
  double contrast = 0.0;   ///< With the ground.
  double thickness = 0.0;  ///< Of the area, or else of the stroke.
};

/// Points along the lines of a shape, at equal numbers of its points.
std::vector<Vector2d> ProbesOf(const SvgShape& shape) {
  size_t num_points = 0;
  for (const auto& line : shape.polylines) num_points += line.points.size();
  std::vector<Vector2d> probes;
  const size_t per_segment = std::max<size_t>(1, kNumProbes / std::max<size_t>(1, num_points));
  const size_t step = std::max<size_t>(1, num_points / kNumProbes);
  size_t index = 0;
  for (const auto& line : shape.polylines) {
    for (size_t i = 0; i < line.points.size(); ++i, ++index) {
      if (index % step != 0) continue;
      const Vector2d along = line.points[std::min(i + 1, line.points.size() - 1)] - line.points[i];
      for (size_t k = 0; k < per_segment; ++k)
        probes.emplace_back(line.points[i] + (double(k) + 0.5) / double(per_segment) * along);
    }
  }
  return probes;
}

template <class Holds>
double ShareOfProbes(const std::vector<Vector2d>& probes, Holds&& holds) {
  if (probes.empty()) return 0.0;
  return static_cast<double>(std::ranges::count_if(probes, holds)) / static_cast<double>(probes.size());
}

/// Whether a shape has a fill that the file gives, a stroke whose colour differs by at most that, and no open line.
bool HasStrokeOfItsColour(const SvgShape& shape, double difference) {
  if (!shape.fill || !shape.stroke || !shape.is_fill_given) return false;
  const auto on_white = [](const SvgColor& paint) -> Vector3d {
    return paint.alpha * paint.rgb + Vector3d::Constant(1.0 - paint.alpha);
  };
  if ((on_white(*shape.fill) - on_white(*shape.stroke)).cwiseAbs().maxCoeff() > difference) return false;
  return std::ranges::all_of(shape.polylines, [](const SvgPolyline& line) {
    return line.points.size() >= 3 && line.points.front() == line.points.back();
  });
}

bool HasHairline(const SvgScene& scene, const SvgShape& shape) {
  return HasStrokeOfItsColour(shape, 0.0) && shape.stroke_width <= kHairline * std::max(scene.width, scene.height);
}

class GroundReader {
 public:
  GroundReader(const SvgScene& scene, const SvgColor& paper, double side)
      : scene_(scene), paper_(paper.rgb), side_(side), cell_(kAlong * side) {}

  std::vector<AreaReading> Read() {
    for (size_t i = 0; i < scene_.shapes.size(); ++i) facts_.push_back(FactsOf(i));
    std::vector<AreaReading> reading(scene_.shapes.size(), AreaReading::kNothing);
    for (size_t i = 0; i < scene_.shapes.size(); ++i) {
      const SvgShape& shape = scene_.shapes[i];
      if (shape.stroke || !shape.fill || CoversSheet(scene_, shape)) continue;
      reading[i] = facts_[i].is_ground ? AreaReading::kOutlines : AreaReading::kPen;
    }
    SortByContrast();
    MakeGrid();
    MarkHoles(reading);
    for (size_t i = 0; i < scene_.shapes.size() && HasWorkLeft(); ++i) {
      if (facts_[i].contrast < kInkContrast || facts_[i].is_ground) continue;
      if (reading[i] == AreaReading::kPen && (IsAlongInk(i) || HoldsInk(i))) reading[i] = AreaReading::kNothing;
      if (HasHairline(scene_, scene_.shapes[i]) && IsAlongInk(i)) reading[i] = AreaReading::kShade;
    }
    return reading;
  }

 private:
  ShapeFacts FactsOf(size_t index) {
    const SvgShape& shape = scene_.shapes[index];
    ShapeFacts facts;
    facts.box = BoxOfLines(shape.polylines);
    facts.ground = paper_;
    for (const size_t ground : grounds_)
      if (CoversSheet(scene_, scene_.shapes[ground]) || facts_[ground].box.contains(facts.box))
        facts.ground = scene_.shapes[ground].fill->rgb;
    if (shape.fill) facts.thickness = RoughWidth(FilledAreaOf(shape));
    if (shape.fill && std::ranges::any_of(shape.polylines, HasInside))
      facts.contrast = PaintContrast(*shape.fill, facts.ground);
    if (shape.stroke) {
      facts.thickness = std::max(facts.thickness, shape.stroke_width);
      facts.contrast = std::max(facts.contrast, PaintContrast(*shape.stroke, facts.ground));
    }
    facts.is_ground =
        shape.fill &&
        (CoversSheet(scene_, shape) || std::ranges::any_of(shape.polylines, [&](const SvgPolyline& polyline) {
           return RectangleOf(polyline) && BoxOfLine(polyline).sizes().minCoeff() > kSheetSide * side_;
         }));
    constexpr size_t kMaxGrounds = 64;
    if (facts.is_ground && shape.fill->alpha >= 0.5 && grounds_.size() < kMaxGrounds && IsFull(index, facts.box))
      grounds_.push_back(index);
    return facts;
  }

  /// Whether an area has no hole where a frame has it.
  bool IsFull(size_t index, const AlignedBox2d& box) {
    for (const double x : {0.25, 0.5, 0.75})
      for (const double y : {0.25, 0.5, 0.75})
        if (!InsideOf(index).Contains(box.min() + Vector2d(x, y).cwiseProduct(box.sizes()))) return false;
    return true;
  }

  /// The inside of an area, made once.
  const SvgClip& InsideOf(size_t index) {
    auto& inside = insides_[index];
    if (!inside) {
      const SvgShape& shape = scene_.shapes[index];
      inside = std::make_unique<SvgClip>(std::vector<SvgArea>{{shape.polylines, shape.fill_rule}});
    }
    return *inside;
  }

  bool LiesIn(size_t inner, size_t outer) {
    ++num_searches_;
    return ShareOfProbes(ProbesOf(scene_.shapes[inner]),
                         [&](const Vector2d& probe) { return InsideOf(outer).Contains(probe); }) > kMostOf;
  }

  bool HasWorkLeft() const { return num_comparisons_ < kMaxComparisons && num_searches_ < kMaxSearches; }

  void SortByContrast() {
    for (size_t i = 0; i < facts_.size(); ++i)
      if (!facts_[i].is_ground) by_contrast_.push_back(i);
    std::ranges::stable_sort(by_contrast_, [&](size_t a, size_t b) { return facts_[a].contrast > facts_[b].contrast; });
  }

  bool IsArea(size_t index) const { return scene_.shapes[index].fill && facts_[index].thickness > 0.0; }

  /// Whether what an area covers is still seen.
  bool IsTransparent(size_t index) const { return scene_.shapes[index].fill && scene_.shapes[index].fill->alpha < 0.5; }

  /// Areas of the colour of the ground, unless they lie on a thick area.
  void MarkHoles(std::vector<AreaReading>& reading) {
    std::unordered_map<size_t, std::vector<size_t>> holes_of;
    std::vector<size_t> inks;
    for (size_t i = 0; i < reading.size() && HasWorkLeft(); ++i) {
      if (reading[i] != AreaReading::kPen) continue;
      if (facts_[i].contrast >= kInkContrast) inks.push_back(i);
      if (!IsArea(i) || facts_[i].contrast >= kInkContrast) continue;
      reading[i] = AreaReading::kNothing;
      for (auto below = inks.rbegin(); below != inks.rend() && HasWorkLeft(); ++below) {
        ++num_comparisons_;
        if (!facts_[*below].box.intersects(facts_[i].box) || !LiesIn(i, *below)) continue;
        holes_of[*below].push_back(i);
        break;
      }
    }
    for (const auto& [host, holes] : holes_of) {
      FilledArea whole = FilledAreaOf(scene_.shapes[host]);
      double area = 0.5 * RoughWidth(whole) * LengthOf(whole), length = LengthOf(whole);
      for (const size_t hole : holes) {
        const FilledArea part = FilledAreaOf(scene_.shapes[hole]);
        area -= 0.5 * RoughWidth(part) * LengthOf(part);
        length += LengthOf(part);
      }
      if (2.0 * area <= kWidestPen * side_ * length) continue;
      for (const size_t hole : holes) reading[hole] = AreaReading::kPen;
    }
  }

  static double LengthOf(const FilledArea& area) {
    double length = 0.0;
    for (const auto& outline : area.outlines)
      for (size_t i = 0; i < outline.size(); ++i) length += (outline[(i + 1) % outline.size()] - outline[i]).norm();
    return length;
  }

  static int64_t KeyOf(int64_t column, int64_t row) { return (row << 32) ^ (column & 0xffffffff); }
  int64_t CellOf(double coordinate) const {
    return static_cast<int64_t>(std::floor(std::clamp(coordinate / cell_, -1e6, 1e6)));
  }

  /// The shapes that pass through each cell, those of most contrast first.
  void MakeGrid() {
    for (const size_t s : by_contrast_) {
      if (facts_[s].contrast < kInkContrast) break;
      for (const auto& line : scene_.shapes[s].polylines) {
        for (size_t i = 0; i < line.points.size(); ++i) {
          const Vector2d along = line.points[(i + 1) % line.points.size()] - line.points[i];
          const bool closes = i + 1 == line.points.size();
          const int count =
              closes ? 1 : static_cast<int>(std::clamp(std::ceil(along.norm() / cell_), 1.0, kMaxCellsOfSegment));
          for (int k = 0; k < count; ++k) {
            const Vector2d point = line.points[i] + double(k) / count * along;
            auto& shapes = grid_[KeyOf(CellOf(point.x()), CellOf(point.y()))];
            if (shapes.empty() || shapes.back() != s) shapes.push_back(s);
          }
        }
      }
    }
  }

  /// Whether `ink` makes of a pale area a wash if it is drawn along it.
  bool OutweighsAlong(size_t ink, size_t pale) const {
    const double ratio = facts_[ink].contrast / facts_[pale].contrast;
    const bool is_thin = facts_[pale].thickness <= kShadeThickness * facts_[ink].thickness;
    const bool is_over = ink > pale || IsTransparent(pale);
    return ink != pale && ((is_over && ratio >= kInkOverWash) || (is_thin && ratio >= kInkOverShade));
  }

  bool IsAlongInk(size_t pale) {
    return ShareOfProbes(ProbesOf(scene_.shapes[pale]), [&](const Vector2d& probe) {
             for (int64_t row = CellOf(probe.y()) - 1; row <= CellOf(probe.y()) + 1; ++row) {
               for (int64_t column = CellOf(probe.x()) - 1; column <= CellOf(probe.x()) + 1; ++column) {
                 const auto found = grid_.find(KeyOf(column, row));
                 if (found == grid_.end()) continue;
                 for (const size_t ink : found->second) {
                   ++num_comparisons_;
                   if (facts_[ink].contrast < kInkOverShade * facts_[pale].contrast) break;
                   if (OutweighsAlong(ink, pale)) return true;
                 }
               }
             }
             return false;
           }) > kMostOf;
  }

  /// Whether darker ink is drawn inside an area, or the same one with more opacity.
  bool HoldsInk(size_t pale) {
    const SvgColor& paint = *scene_.shapes[pale].fill;
    const auto outweighs = [&](size_t ink) {
      if (facts_[ink].contrast >= kInkOverWash * facts_[pale].contrast) return true;
      const auto& fill = scene_.shapes[ink].fill;
      return paint.alpha < 1.0 && fill && fill->alpha > paint.alpha && fill->rgb == paint.rgb;
    };
    for (const size_t ink : by_contrast_) {
      if (!HasWorkLeft() || (paint.alpha >= 1.0 && facts_[ink].contrast < kInkOverWash * facts_[pale].contrast)) break;
      ++num_comparisons_;
      const bool is_seen = ink > pale || (ink < pale && IsTransparent(pale));
      if (!is_seen || !facts_[ink].box.intersects(facts_[pale].box) || !outweighs(ink)) continue;
      if (LiesIn(ink, pale)) return true;
    }
    return false;
  }

  const SvgScene& scene_;
  Vector3d paper_;
  double side_, cell_;
  std::vector<ShapeFacts> facts_;
  std::vector<size_t> grounds_;
  std::vector<size_t> by_contrast_;  ///< All shapes but large rectangles, that of most contrast first.
  std::unordered_map<size_t, std::unique_ptr<SvgClip>> insides_;
  std::unordered_map<int64_t, std::vector<size_t>> grid_;
  int64_t num_comparisons_ = 0, num_searches_ = 0;
};

}  // namespace

bool CoversSheet(const SvgScene& scene, const SvgShape& shape) {
  if (scene.width <= 0.0 || scene.height <= 0.0) return false;
  const AlignedBox2d sheet(Vector2d(0, 0), Vector2d(scene.width, scene.height));
  return std::ranges::any_of(shape.polylines, [&](const SvgPolyline& polyline) {
    const auto covered = sheet.intersection(BoxOfLine(polyline));
    return RectangleOf(polyline) && !covered.isEmpty() && covered.volume() >= kSheetCover * sheet.volume();
  });
}

void JoinStrokesWithAreas(SvgScene& scene) {
  for (SvgShape& shape : scene.shapes) {
    if (!HasStrokeOfItsColour(shape, kInkContrast)) continue;
    const double thickness = RoughWidth(FilledAreaOf(shape));
    const bool is_thin = shape.stroke_width <= thickness || (thickness > 0.0 && HasHairline(scene, shape));
    if (is_thin) shape.stroke.reset();
  }
}

std::vector<AreaReading> ReadingOfAreas(const SvgScene& scene, const SvgColor& paper, double side) {
  return GroundReader(scene, paper, side).Read();
}

}  // namespace daumier::render
