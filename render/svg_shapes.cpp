#include "render/svg_shapes.h"

#include "render/svg_text.h"

#include <fmt/format.h>
#include <algorithm>

namespace daumier::render {
namespace {

std::string EllipseData(double cx, double cy, double rx, double ry) {
  if (rx <= 0.0 || ry <= 0.0) return {};
  return fmt::format("M{} {}A{} {} 0 0 1 {} {} {} {} 0 0 1 {} {}Z", cx + rx, cy, rx, ry, cx - rx, cy, rx, ry, cx + rx,
                     cy);
}

/// Lengths of one element.
class ShapeLengths {
 public:
  ShapeLengths(const pugi::xml_node& node, const SvgStyle& style, const SvgUnits& units)
      : node_(node), style_(style), units_(units) {}

  /// 0 where it is absent or `auto`.
  double Geometry(SvgProperty property, SvgAxis axis) const { return OptionalGeometry(property, axis).value_or(0.0); }

  std::optional<double> OptionalGeometry(SvgProperty property, SvgAxis axis) const {
    const std::string& text = style_.Get(property);
    if (text.empty() || text == "auto") return std::nullopt;
    return ParseSvgLength(text, axis, units_);
  }

  double Attribute(const char* name, SvgAxis axis) const {
    const std::string_view text = node_.attribute(name).value();
    return text.empty() ? 0.0 : ParseSvgLength(text, axis, units_);
  }

 private:
  const pugi::xml_node& node_;
  const SvgStyle& style_;
  const SvgUnits& units_;
};

std::string RectangleData(const ShapeLengths& lengths) {
  const double x = lengths.Geometry(SvgProperty::kX, SvgAxis::kX), y = lengths.Geometry(SvgProperty::kY, SvgAxis::kY);
  const double width = lengths.Geometry(SvgProperty::kWidth, SvgAxis::kX),
               height = lengths.Geometry(SvgProperty::kHeight, SvgAxis::kY);
  if (width <= 0.0 || height <= 0.0) return {};
  const auto given_rx = lengths.OptionalGeometry(SvgProperty::kRx, SvgAxis::kX),
             given_ry = lengths.OptionalGeometry(SvgProperty::kRy, SvgAxis::kY);
  const double rx = std::clamp(given_rx.value_or(given_ry.value_or(0.0)), 0.0, 0.5 * width),
               ry = std::clamp(given_ry.value_or(given_rx.value_or(0.0)), 0.0, 0.5 * height);
  if (rx == 0.0 || ry == 0.0) return fmt::format("M{} {}h{}v{}h{}Z", x, y, width, height, -width);
  return fmt::format("M{} {}H{}A{} {} 0 0 1 {} {}V{}A{} {} 0 0 1 {} {}H{}A{} {} 0 0 1 {} {}V{}A{} {} 0 0 1 {} {}Z",
                     x + rx, y, x + width - rx, rx, ry, x + width, y + ry, y + height - ry, rx, ry, x + width - rx,
                     y + height, x + rx, rx, ry, x, y + height - ry, y + ry, rx, ry, x + rx, y);
}

}  // namespace

std::optional<std::string> SvgShapeData(const pugi::xml_node& node, const SvgStyle& style, const SvgUnits& units) {
  const std::string_view name = LocalName(node);
  const ShapeLengths lengths(node, style, units);
  if (name == "path") {
    const std::string_view data = node.attribute("d").value();
    return std::string(Trimmed(data) == "none" ? "" : data);
  }
  if (name == "rect") return RectangleData(lengths);
  if (name == "line") {
    return fmt::format("M{} {}L{} {}", lengths.Attribute("x1", SvgAxis::kX), lengths.Attribute("y1", SvgAxis::kY),
                       lengths.Attribute("x2", SvgAxis::kX), lengths.Attribute("y2", SvgAxis::kY));
  }
  if (name == "circle" || name == "ellipse") {
    const double cx = lengths.Geometry(SvgProperty::kCx, SvgAxis::kX),
                 cy = lengths.Geometry(SvgProperty::kCy, SvgAxis::kY);
    if (name == "circle") {
      const double radius = lengths.Geometry(SvgProperty::kR, SvgAxis::kDiagonal);
      return EllipseData(cx, cy, radius, radius);
    }
    const auto rx = lengths.OptionalGeometry(SvgProperty::kRx, SvgAxis::kX),
               ry = lengths.OptionalGeometry(SvgProperty::kRy, SvgAxis::kY);
    return EllipseData(cx, cy, rx.value_or(ry.value_or(0.0)), ry.value_or(rx.value_or(0.0)));
  }
  if (name == "polyline" || name == "polygon") {
    const std::string points(Trimmed(node.attribute("points").value()));
    if (points.empty()) return points;
    return "M" + points + (name == "polygon" ? "Z" : "");
  }
  return std::nullopt;
}

}  // namespace daumier::render
