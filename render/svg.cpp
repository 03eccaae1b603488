#include "render/svg.h"

#include "core/error.h"
#include "core/files.h"
#include "render/pen_areas.h"
#include "render/svg_path.h"
#include "render/svg_transform.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

namespace daumier::render {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

/// Share of the longer side of the sheet by which chords may leave a curve.
constexpr double kTolerance = 0.1 / kSketchCanvas;
/// Groups within groups; a deeper file is damaged or made to overflow the stack.
constexpr int kMaxDepth = 200;
/// Share of the sheet that a filled area without stroke may cover before it counts as the sheet's own colour.
constexpr double kBackgroundShare = 0.98;

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/// A property by the style attribute, else by the attribute of its name; empty where there is neither.
std::string_view Property(const pugi::xml_node& node, std::string_view name) {
  std::string_view style = node.attribute("style").value();
  while (!style.empty()) {
    const std::string_view declaration = style.substr(0, style.find(';'));
    style.remove_prefix(std::min(style.size(), declaration.size() + 1));
    const size_t colon = declaration.find(':');
    if (colon != std::string_view::npos && Trimmed(declaration.substr(0, colon)) == name) {
      return Trimmed(declaration.substr(colon + 1));
    }
  }
  return Trimmed(node.attribute(std::string(name).c_str()).value());
}

bool IsZero(std::string_view opacity) {
  if (opacity.empty()) return false;
  SvgNumbers numbers(opacity);
  return numbers.AtNumber() && numbers.Number() == 0.0;
}

bool IsUnpainted(std::string_view paint) {
  return paint == "none" || paint == "transparent";
}

bool IsWhite(std::string_view paint) {
  std::string word;
  for (const char c : paint) {
    if (c != ' ') word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return word == "white" || word == "#fff" || word == "#ffffff" || word == "rgb(255,255,255)" ||
         word == "rgb(100%,100%,100%)";
}

/// Whether neither an element nor anything inside it is shown.
bool IsLeftOut(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  for (const std::string_view definition : {"defs", "clipPath", "mask", "symbol", "marker", "pattern"}) {
    if (name == definition) return true;
  }
  return Property(node, "display") == "none" || IsZero(Property(node, "opacity"));
}

/// Properties that elements inherit.
struct Inherited {
  Affine2d sheet_from_local = Affine2d::Identity();
  bool visible = true;
  bool fills = true, fill_is_white = false, strokes = false;
  FillRule fill_rule = FillRule::kNonzero;
  int kind = 0;
};

/// Pixels of a length such as "12", "3.5mm" or "1in"; nothing where it is absent or a percentage.
/// @throws Error if it is malformed.
std::optional<double> Length(std::string_view text) {
  if (text.empty()) return std::nullopt;
  SvgNumbers numbers(text);
  const double value = numbers.Number();
  const std::string_view unit = Trimmed(text.substr(numbers.position()));
  if (unit == "%") return std::nullopt;
  for (const auto& [name, pixels] : {std::pair{"", 1.0},
                                     {"px", 1.0},
                                     {"pt", 96.0 / 72.0},
                                     {"pc", 16.0},
                                     {"mm", 96.0 / 25.4},
                                     {"cm", 96.0 / 2.54},
                                     {"in", 96.0}}) {
    if (unit == name) return value * pixels;
  }
  throw Error(fmt::format("'{}' is not a length in px, pt, pc, mm, cm or in", text));
}

/// The sheet, and how the coordinates of the outermost element lie on it.
struct Sheet {
  double width = 0.0, height = 0.0;  ///< 0 where the file has none.
  Affine2d from_user = Affine2d::Identity();
};

/// @throws Error if an attribute is malformed or a size is not positive.
Sheet SheetOf(const pugi::xml_node& root) {
  const auto width = Length(root.attribute("width").value()), height = Length(root.attribute("height").value());
  const std::string_view view_box = root.attribute("viewBox").value();
  DAUMIER_CHECK(width.value_or(1) > 0 && height.value_or(1) > 0, "width and height must be positive");
  Sheet sheet{width.value_or(0.0), height.value_or(0.0)};
  if (view_box.empty()) return sheet;

  SvgNumbers numbers(view_box);
  Eigen::Vector4d box;
  for (double& value : box) {
    numbers.SkipSeparators();
    value = numbers.Number();
  }
  DAUMIER_CHECK(box[2] > 0 && box[3] > 0, "viewBox is '{}', expected a positive size", view_box);
  // A missing side follows from the other and the shape of the box.
  sheet.width = width ? *width : height ? *height * box[2] / box[3] : box[2];
  sheet.height = height ? *height : sheet.width * box[3] / box[2];
  Vector2d scale(sheet.width / box[2], sheet.height / box[3]);
  if (std::string_view(root.attribute("preserveAspectRatio").value()) != "none") scale.setConstant(scale.minCoeff());
  const Vector2d margin = 0.5 * (Vector2d(sheet.width, sheet.height) - scale.cwiseProduct(box.tail<2>()));
  sheet.from_user.linear() = scale.asDiagonal();
  sheet.from_user.translation() = margin - scale.cwiseProduct(box.head<2>());
  return sheet;
}

/// A number that is 0 where it is absent. @throws Error if it is malformed.
double NumberOf(const pugi::xml_node& node, const char* name) {
  return Length(node.attribute(name).value()).value_or(0.0);
}

std::string EllipseData(double cx, double cy, double rx, double ry) {
  if (rx <= 0.0 || ry <= 0.0) return {};
  return fmt::format("M{} {}A{} {} 0 0 1 {} {} {} {} 0 0 1 {} {}Z", cx + rx, cy, rx, ry, cx - rx, cy, rx, ry, cx + rx,
                     cy);
}

std::string RectangleData(const pugi::xml_node& node) {
  const double x = NumberOf(node, "x"), y = NumberOf(node, "y");
  const double width = NumberOf(node, "width"), height = NumberOf(node, "height");
  if (width <= 0.0 || height <= 0.0) return {};
  double rx = NumberOf(node, node.attribute("rx") ? "rx" : "ry"),
         ry = NumberOf(node, node.attribute("ry") ? "ry" : "rx");
  rx = std::clamp(rx, 0.0, 0.5 * width);
  ry = std::clamp(ry, 0.0, 0.5 * height);
  if (rx == 0.0 || ry == 0.0) return fmt::format("M{} {}h{}v{}h{}Z", x, y, width, height, -width);
  return fmt::format("M{} {}H{}A{} {} 0 0 1 {} {}V{}A{} {} 0 0 1 {} {}H{}A{} {} 0 0 1 {} {}V{}A{} {} 0 0 1 {} {}Z",
                     x + rx, y, x + width - rx, rx, ry, x + width, y + ry, y + height - ry, rx, ry, x + width - rx,
                     y + height, x + rx, rx, ry, x, y + height - ry, y + ry, rx, ry, x + rx, y);
}

/// The path equivalent to a shape [SVG 1.1, 9]; nothing if the element is no shape.
std::optional<std::string> PathDataOf(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  if (name == "path") return node.attribute("d").value();
  if (name == "rect") return RectangleData(node);
  if (name == "line") {
    return fmt::format("M{} {}L{} {}", NumberOf(node, "x1"), NumberOf(node, "y1"), NumberOf(node, "x2"),
                       NumberOf(node, "y2"));
  }
  if (name == "circle") {
    const double radius = NumberOf(node, "r");
    return EllipseData(NumberOf(node, "cx"), NumberOf(node, "cy"), radius, radius);
  }
  if (name == "ellipse") {
    return EllipseData(NumberOf(node, "cx"), NumberOf(node, "cy"), NumberOf(node, "rx"), NumberOf(node, "ry"));
  }
  if (name == "polyline" || name == "polygon") {
    const std::string points(Trimmed(node.attribute("points").value()));
    if (points.empty()) return points;
    return "M" + points + (name == "polygon" ? "Z" : "");
  }
  return std::nullopt;
}

class SvgReader {
 public:
  SvgReader(std::string name, const std::string& bytes, const std::vector<std::string>& kind_names)
      : name_(std::move(name)), bytes_(bytes), kind_names_(kind_names) {}

  Drawing Read() {
    pugi::xml_document document;
    const auto result = document.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_auto);
    DAUMIER_CHECK(result, "{}:{}: not XML, or truncated: {}", name_, LineOf(result.offset), result.description());
    const pugi::xml_node root = document.document_element();
    DAUMIER_CHECK(std::string_view(root.name()) == "svg", "{}: the outermost element is <{}>, expected <svg>", name_,
                  root.name());
    try {
      sheet_ = SheetOf(root);
    } catch (const Error& error) {
      throw Error(fmt::format("{}:{}: <svg>: {}", name_, LineOf(root.offset_debug()), error.what()));
    }
    Inherited inherited;
    inherited.sheet_from_local = sheet_.from_user;
    Visit(root, inherited, 0);
    AddStrokesOfAreas();
    DAUMIER_CHECK(!strokes_.empty(), "{}: the drawing holds no strokes", name_);
    return {sheet_.width > 0 ? sheet_.width : reach_.x(), sheet_.height > 0 ? sheet_.height : reach_.y(),
            std::move(strokes_)};
  }

 private:
  int64_t LineOf(ptrdiff_t offset) const {
    return 1 + std::count(bytes_.begin(), bytes_.begin() + std::clamp<ptrdiff_t>(offset, 0, std::ssize(bytes_)), '\n');
  }

  void Visit(const pugi::xml_node& node, const Inherited& from_parent, int depth) {
    Inherited inherited;
    try {
      DAUMIER_CHECK(depth < kMaxDepth, "elements are nested more than {} deep", kMaxDepth);
      if (IsLeftOut(node)) return;
      inherited = Inherit(node, from_parent);
      if (const auto data = PathDataOf(node)) {
        AddShape(*data, node.attribute("inkscape:original-d").value(), inherited);
      }
    } catch (const Error& error) {
      throw Error(fmt::format("{}:{}: <{}>: {}", name_, LineOf(node.offset_debug()), node.name(), error.what()));
    }
    for (const auto& child : node.children()) {
      if (child.type() == pugi::node_element) Visit(child, inherited, depth + 1);
    }
  }

  Inherited Inherit(const pugi::xml_node& node, Inherited inherited) const {
    inherited.sheet_from_local = inherited.sheet_from_local * ParseSvgTransform(node.attribute("transform").value());
    if (const auto word = Property(node, "visibility"); !word.empty()) inherited.visible = word == "visible";
    if (const auto paint = Property(node, "fill"); !paint.empty()) {
      inherited.fills = !IsUnpainted(paint);
      inherited.fill_is_white = IsWhite(paint);
    }
    if (const auto paint = Property(node, "stroke"); !paint.empty()) inherited.strokes = !IsUnpainted(paint);
    if (const auto rule = Property(node, "fill-rule"); !rule.empty()) {
      inherited.fill_rule = rule == "evenodd" ? FillRule::kEvenOdd : FillRule::kNonzero;
    }
    if (IsZero(Property(node, "fill-opacity"))) inherited.fills = false;
    if (IsZero(Property(node, "stroke-opacity"))) inherited.strokes = false;
    inherited.kind = KindOf(node.attribute("class").value()).value_or(inherited.kind);
    return inherited;
  }

  std::optional<int> KindOf(std::string_view words) const {
    while (!(words = Trimmed(words)).empty()) {
      const std::string_view word = words.substr(0, words.find_first_of(" \t\r\n"));
      const auto kind = std::find(kind_names_.begin(), kind_names_.end(), word);
      if (kind != kind_names_.end()) return static_cast<int>(kind - kind_names_.begin());
      words.remove_prefix(word.size());
    }
    return std::nullopt;
  }

  void AddShape(const std::string& data, const std::string& original_data, const Inherited& inherited) {
    const auto polylines = PolylinesOnSheet(data, inherited.sheet_from_local);
    if (!inherited.visible || (!inherited.strokes && !inherited.fills)) return;
    if (inherited.strokes) {
      for (const auto& polyline : polylines) Extend(polyline);
      for (Stroke& stroke : StrokesThrough(polylines)) {
        stroke.kind = inherited.kind;
        strokes_.push_back(std::move(stroke));
      }
      return;
    }
    PaintedArea area{.shape = {{}, inherited.fill_rule},
                     .paint = inherited.fill_is_white ? Paint::kPaper : Paint::kInk,
                     .kind = inherited.kind,
                     .drawn_lines = PolylinesOnSheet(original_data, inherited.sheet_from_local)};
    for (const auto& polyline : polylines) {
      if (area.paint == Paint::kInk && IsBackground(polyline)) continue;
      if (area.paint == Paint::kInk) Extend(polyline);
      area.shape.outlines.push_back(polyline);
    }
    areas_.push_back({std::move(area), strokes_.size()});
  }

  /// @throws Error if a point is not finite as a float.
  std::vector<std::vector<Vector2d>> PolylinesOnSheet(const std::string& data, const Affine2d& transform) const {
    const double scale = 2.0 * transform.linear().cwiseAbs().maxCoeff();  // Of the linear part no vector grows more.
    const double side = std::max({sheet_.width, sheet_.height, 1.0});
    std::vector<std::vector<Vector2d>> polylines;
    for (const auto& polyline : ParseSvgPath(data, kTolerance * side / std::max(scale, 1e-12))) {
      polylines.emplace_back();
      for (const Vector2d& local : polyline.points) {
        const Vector2d point = transform * local;
        DAUMIER_CHECK(point.cast<float>().allFinite(), "a point lies at ({}, {})", point.x(), point.y());
        polylines.back().push_back(point);
      }
    }
    return polylines;
  }

  void Extend(const std::vector<Vector2d>& polyline) {
    for (const Vector2d& point : polyline) reach_ = reach_.cwiseMax(point);
  }

  /// Places the strokes of each area before the strokes that are painted after it.
  void AddStrokesOfAreas() {
    std::vector<PaintedArea> areas;
    for (const auto& [area, num_before] : areas_) areas.push_back(area);
    const double side = std::max({sheet_.width, sheet_.height, reach_.maxCoeff(), 1e-30});
    const auto strokes_of_areas = StrokesOfAreas(areas, side);
    std::vector<Stroke> strokes;
    size_t num_placed = 0;
    const auto place_until = [&](size_t end) {
      for (; num_placed < end; ++num_placed) strokes.push_back(std::move(strokes_[num_placed]));
    };
    for (size_t i = 0; i < areas_.size(); ++i) {
      place_until(areas_[i].num_strokes_before);
      strokes.insert(strokes.end(), strokes_of_areas[i].begin(), strokes_of_areas[i].end());
    }
    place_until(strokes_.size());
    strokes_ = std::move(strokes);
  }

  /// Whether an area is a rectangle that covers the whole sheet.
  bool IsBackground(const std::vector<Vector2d>& outline) const {
    if (sheet_.width == 0.0 || sheet_.height == 0.0 || outline.size() != 5) return false;
    Eigen::AlignedBox2d box;
    for (const Vector2d& point : outline) box.extend(point);
    const Eigen::AlignedBox2d sheet(Vector2d(0, 0), Vector2d(sheet_.width, sheet_.height));
    const auto covered = sheet.intersection(box);
    return !covered.isEmpty() && covered.volume() >= kBackgroundShare * sheet.volume();
  }

  std::string name_;
  const std::string& bytes_;
  const std::vector<std::string>& kind_names_;
  Sheet sheet_;
  Vector2d reach_ = Vector2d::Zero();
  std::vector<Stroke> strokes_;
  struct PlacedArea {
    PaintedArea area;
    size_t num_strokes_before;
  };
  std::vector<PlacedArea> areas_;
};

}  // namespace

void WriteSvg(const std::filesystem::path& path, const std::vector<Stroke>& strokes,
              const std::vector<std::string>& kind_names) {
  for (const auto& name : kind_names) {
    DAUMIER_CHECK(!name.empty() && name.find_first_of(" \t\r\n") == std::string::npos,
                  "{}: '{}' cannot be the name of a kind of line: it is empty or holds white space", path.string(),
                  name);
  }
  pugi::xml_document document;
  auto root = document.append_child("svg");
  root.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
  root.append_attribute("width") = kSketchCanvas;
  root.append_attribute("height") = kSketchCanvas;
  root.append_attribute("viewBox") = fmt::format("0 0 {0} {0}", kSketchCanvas).c_str();
  root.append_attribute("fill") = "none";
  root.append_attribute("stroke") = "black";
  root.append_attribute("stroke-width") = StrokeStyle{}.width;
  root.append_attribute("stroke-linecap") = "round";
  root.append_attribute("stroke-linejoin") = "round";
  for (const Stroke& stroke : strokes) {
    DAUMIER_CHECK(stroke.kind >= 0 && stroke.kind < std::ssize(kind_names),
                  "{}: a stroke is of kind {}, but there are {} names", path.string(), stroke.kind, kind_names.size());
    if (stroke.points.empty()) continue;
    std::string data;
    for (const auto& [x, y] : stroke.points) {
      DAUMIER_CHECK(std::isfinite(x) && std::isfinite(y), "{}: a point is ({}, {})", path.string(), x, y);
      data += fmt::format("{}{} {}", data.empty() ? 'M' : 'L', x, y);
    }
    // A lone moveto paints nothing; a closed one paints a dot.
    if (stroke.points.size() == 1) data += 'Z';
    auto element = root.append_child("path");
    element.append_attribute("class") = kind_names[stroke.kind].c_str();
    element.append_attribute("d") = data.c_str();
  }
  std::ostringstream text;
  document.save(text, "  ");
  WriteFileAtomically(path, text.str());
}

Drawing ReadSvg(const std::filesystem::path& path, const std::vector<std::string>& kind_names) {
  const std::string bytes = ReadFile(path);
  return SvgReader(path.string(), bytes, kind_names).Read();
}

}  // namespace daumier::render
