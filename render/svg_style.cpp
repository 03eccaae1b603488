#include "render/svg_style.h"

#include "core/error.h"
#include "render/svg_path.h"
#include "render/svg_text.h"
#include "render/svg_viewport.h"

#include <algorithm>

namespace daumier::render {
namespace {

constexpr size_t kNumProperties = static_cast<size_t>(SvgProperty::kCount);
/// Replacements of var() in one value, and the length of what they give: variables can double each other.
constexpr int kMaxReplacements = 32;
constexpr size_t kMaxValueLength = 4096;

enum class Inheritance { kInherited, kOwn };
enum class Attributes { kPresentation, kNone };

struct PropertyRow {
  SvgProperty property;
  std::string_view name, initial;
  Inheritance inheritance;
  Attributes attributes = Attributes::kPresentation;
};

/// In the order of SvgProperty.
constexpr PropertyRow kProperties[] = {
    {SvgProperty::kColor, "color", "black", Inheritance::kInherited},
    {SvgProperty::kFill, "fill", "black", Inheritance::kInherited},
    {SvgProperty::kFillOpacity, "fill-opacity", "1", Inheritance::kInherited},
    {SvgProperty::kFillRule, "fill-rule", "nonzero", Inheritance::kInherited},
    {SvgProperty::kClipRule, "clip-rule", "nonzero", Inheritance::kInherited},
    {SvgProperty::kFontSize, "font-size", "16", Inheritance::kInherited},
    {SvgProperty::kMarkerStart, "marker-start", "none", Inheritance::kInherited},
    {SvgProperty::kMarkerMid, "marker-mid", "none", Inheritance::kInherited},
    {SvgProperty::kMarkerEnd, "marker-end", "none", Inheritance::kInherited},
    {SvgProperty::kStroke, "stroke", "none", Inheritance::kInherited},
    {SvgProperty::kStrokeOpacity, "stroke-opacity", "1", Inheritance::kInherited},
    {SvgProperty::kStrokeWidth, "stroke-width", "1", Inheritance::kInherited},
    {SvgProperty::kVisibility, "visibility", "visible", Inheritance::kInherited},
    {SvgProperty::kBackgroundColor, "background-color", "transparent", Inheritance::kOwn, Attributes::kNone},
    {SvgProperty::kClipPath, "clip-path", "none", Inheritance::kOwn},
    {SvgProperty::kDisplay, "display", "inline", Inheritance::kOwn},
    {SvgProperty::kFilter, "filter", "none", Inheritance::kOwn},
    {SvgProperty::kMask, "mask", "none", Inheritance::kOwn},
    {SvgProperty::kOpacity, "opacity", "1", Inheritance::kOwn},
    {SvgProperty::kOverflow, "overflow", "", Inheritance::kOwn},
    {SvgProperty::kStopColor, "stop-color", "black", Inheritance::kOwn},
    {SvgProperty::kStopOpacity, "stop-opacity", "1", Inheritance::kOwn},
    {SvgProperty::kTransform, "transform", "none", Inheritance::kOwn},
    {SvgProperty::kTransformOrigin, "transform-origin", "", Inheritance::kOwn},
    {SvgProperty::kVectorEffect, "vector-effect", "none", Inheritance::kOwn},
    {SvgProperty::kX, "x", "", Inheritance::kOwn},
    {SvgProperty::kY, "y", "", Inheritance::kOwn},
    {SvgProperty::kWidth, "width", "", Inheritance::kOwn},
    {SvgProperty::kHeight, "height", "", Inheritance::kOwn},
    {SvgProperty::kCx, "cx", "", Inheritance::kOwn},
    {SvgProperty::kCy, "cy", "", Inheritance::kOwn},
    {SvgProperty::kR, "r", "", Inheritance::kOwn},
    {SvgProperty::kRx, "rx", "", Inheritance::kOwn},
    {SvgProperty::kRy, "ry", "", Inheritance::kOwn},
};
static_assert(std::size(kProperties) == kNumProperties);

const PropertyRow* PropertyNamed(std::string_view name) {
  static const auto* const by_name = [] {
    auto* map = new std::map<std::string_view, const PropertyRow*>;
    for (const PropertyRow& row : kProperties) (*map)[row.name] = &row;
    return map;
  }();
  const auto found = by_name->find(name);
  return found == by_name->end() ? nullptr : found->second;
}

/// A number or a percentage. @throws Error if it is neither.
double ParseShare(std::string_view text) {
  SvgNumbers numbers(text);
  const double value = numbers.Number();
  const std::string_view unit = Trimmed(text.substr(numbers.position()));
  DAUMIER_CHECK(unit.empty() || unit == "%", "'{}' is neither a number nor a percentage", text);
  return unit == "%" ? 0.01 * value : value;
}

bool IsPaint(const std::string& lowered) {
  return lowered == "none" || lowered == "currentcolor" || lowered.starts_with("context-") ||
         lowered.starts_with("url(") || ParseSvgColor(lowered).has_value();
}

bool IsValid(SvgProperty property, const std::string& value) {
  const std::string lowered = Lowered(value);
  switch (property) {
    case SvgProperty::kColor:
    case SvgProperty::kBackgroundColor:
    case SvgProperty::kStopColor:
      return lowered == "currentcolor" || ParseSvgColor(lowered).has_value();
    case SvgProperty::kFill:
    case SvgProperty::kStroke:
      return IsPaint(lowered);
    case SvgProperty::kFillOpacity:
    case SvgProperty::kOpacity:
    case SvgProperty::kStopOpacity:
    case SvgProperty::kStrokeOpacity:
      try {
        return ParseShare(value) <= 1e300;
      } catch (const Error&) {
        return false;
      }
    case SvgProperty::kStrokeWidth:
      try {
        const SvgUnits some_units{.viewport = Eigen::Vector2d(1, 1), .sheet = Eigen::Vector2d(1, 1)};
        return ParseSvgLength(value, SvgAxis::kDiagonal, some_units) >= 0.0;
      } catch (const Error&) {
        return false;
      }
    default:
      return true;
  }
}

/// Position of the ')' that closes the function whose inside begins at `begin`.
size_t FunctionEnd(std::string_view text, size_t begin) {
  const size_t length = FindInCss(text.substr(begin), ")");
  return length == std::string_view::npos ? length : begin + length;
}

/// With var(--name, otherwise) and light-dark(light, dark) replaced; nothing if a variable is missing.
std::optional<std::string> WithoutVariables(std::string value, const std::map<std::string, std::string>* variables) {
  for (int i = 0; i < kMaxReplacements && value.size() <= kMaxValueLength; ++i) {
    const size_t variable = value.rfind("var("), light_dark = value.rfind("light-dark(");
    if (variable == std::string::npos && light_dark == std::string::npos) return value;
    const bool is_variable = variable != std::string::npos;
    const size_t name = is_variable ? variable : light_dark;
    const size_t begin = value.find('(', name) + 1, end = FunctionEnd(value, begin);
    if (end == std::string::npos) return std::nullopt;
    const std::string_view inside = std::string_view(value).substr(begin, end - begin);
    const size_t comma = std::min(FindInCss(inside, ","), inside.size());
    std::string replacement(Trimmed(inside.substr(0, comma)));
    if (is_variable) {
      const bool is_set = variables != nullptr && variables->contains(replacement);
      if (!is_set && comma == inside.size()) return std::nullopt;
      replacement = is_set ? variables->at(replacement) : std::string(Trimmed(inside.substr(comma + 1)));
    }
    value.replace(name, end + 1 - name, replacement);
  }
  return std::nullopt;
}

/// Pixels of a font size. @throws Error if it is malformed.
double FontSizeOf(const std::string& value, double of_parent) {
  constexpr std::pair<std::string_view, double> kSizes[] = {{"xx-small", 9.0}, {"x-small", 10.0}, {"small", 13.0},
                                                            {"medium", 16.0},  {"large", 18.0},   {"x-large", 24.0},
                                                            {"xx-large", 32.0}};
  for (const auto& [name, size] : kSizes)
    if (value == name) return size;
  if (value == "larger") return 1.2 * of_parent;
  if (value == "smaller") return of_parent / 1.2;
  const SvgUnits units{.font_size = of_parent,
                       .viewport = Eigen::Vector2d::Constant(of_parent),
                       .sheet = Eigen::Vector2d::Constant(of_parent)};
  return ParseSvgLength(value, SvgAxis::kX, units);
}

/// Shorthands as the properties that they set here.
std::vector<std::string_view> LonghandsOf(std::string_view name) {
  if (name == "marker") return {"marker-start", "marker-mid", "marker-end"};
  if (name == "background") return {"background-color"};
  return {name};
}

}  // namespace

SvgStyle::SvgStyle() {
  for (const PropertyRow& row : kProperties) values_[static_cast<size_t>(row.property)] = row.initial;
}

double SvgStyle::Share(SvgProperty property) const {
  return std::clamp(ParseShare(Get(property)), 0.0, 1.0);
}

SvgStyle SvgCascade::Compute(const pugi::xml_node& element, const SvgStyle& parent) const {
  const std::vector<const CssDeclaration*> from_sheets = sheet_.Match(element);
  const std::vector<CssDeclaration> from_attribute = ParseCssDeclarations(element.attribute("style").value());

  std::vector<CssDeclaration> ascending;
  for (const auto& attribute : element.attributes()) {
    const PropertyRow* const row = PropertyNamed(attribute.name());
    if (row == nullptr || row->attributes == Attributes::kNone) continue;
    if (const auto value = Trimmed(attribute.value()); !value.empty())
      ascending.push_back({std::string(row->name), std::string(value)});
  }
  for (const bool important : {false, true}) {
    for (const auto* declaration : from_sheets)
      if (declaration->important == important) ascending.push_back(*declaration);
    for (const auto& declaration : from_attribute)
      if (declaration.important == important) ascending.push_back(declaration);
  }

  SvgStyle style;
  style.variables_ = parent.variables_;
  for (const PropertyRow& row : kProperties) {
    const auto i = static_cast<size_t>(row.property);
    if (row.inheritance != Inheritance::kInherited) continue;
    style.values_[i] = parent.values_[i];
    style.given_[i] = parent.given_[i];
  }
  std::map<std::string, std::string> variables;
  for (const auto& declaration : ascending)
    if (declaration.name.starts_with("--")) variables[declaration.name] = declaration.value;
  if (!variables.empty()) {
    if (parent.variables_) variables.insert(parent.variables_->begin(), parent.variables_->end());
    style.variables_ = std::make_shared<const std::map<std::string, std::string>>(std::move(variables));
  }

  for (const auto& declaration : ascending) {
    for (const std::string_view name : LonghandsOf(declaration.name)) {
      const PropertyRow* const row = PropertyNamed(name);
      if (row == nullptr) continue;
      const auto i = static_cast<size_t>(row->property);
      const auto value = WithoutVariables(declaration.value, style.variables_.get());
      const std::string lowered = value ? Lowered(*value) : std::string();
      if (lowered == "inherit" ||
          ((lowered == "unset" || lowered == "revert") && row->inheritance == Inheritance::kInherited)) {
        style.values_[i] = parent.values_[i];
        style.given_[i] = parent.given_[i];
      } else if (lowered == "initial" || lowered == "unset" || lowered == "revert") {
        style.values_[i] = row->initial;
        style.given_[i] = true;
      } else if (value && IsValid(row->property, *value)) {
        style.values_[i] = *value;
        style.given_[i] = true;
      } else if (row->property != SvgProperty::kBackgroundColor) {
        report_(fmt::format("{} '{}' is not understood", name, declaration.value.substr(0, 60)));
      }
    }
  }
  style.font_size_ = parent.font_size_;
  auto& size = style.values_[static_cast<size_t>(SvgProperty::kFontSize)];
  if (size != parent.Get(SvgProperty::kFontSize)) {
    try {
      style.font_size_ = FontSizeOf(Lowered(size), parent.font_size_);
    } catch (const Error&) {
      report_(fmt::format("font-size '{}' is not understood", size.substr(0, 60)));
    }
  }
  size = fmt::format("{}px", style.font_size_);
  return style;
}

std::optional<std::string> SvgReference(std::string_view value) {
  value = Trimmed(value);
  if (Lowered(value.substr(0, 4)) != "url(") return std::nullopt;
  std::string_view inside = Trimmed(value.substr(4, std::min(value.find(')'), value.size()) - 4));
  if (inside.size() >= 2 && (inside[0] == '"' || inside[0] == '\'')) inside = inside.substr(1, inside.size() - 2);
  if (!inside.starts_with('#')) return std::nullopt;
  return std::string(inside.substr(1));
}

}  // namespace daumier::render
