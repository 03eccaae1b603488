#pragma once
#include "render/svg_color.h"
#include "render/svg_css.h"

#include <array>
#include <bitset>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::render {

/// The properties that decide what is drawn, and where.
enum class SvgProperty {
  // Inherited.
  kColor,
  kFill,
  kFillOpacity,
  kFillRule,
  kClipRule,
  kFontSize,
  kMarkerStart,
  kMarkerMid,
  kMarkerEnd,
  kStroke,
  kStrokeOpacity,
  kStrokeWidth,
  kVisibility,
  // Not inherited.
  kBackgroundColor,
  kClipPath,
  kDisplay,
  kFilter,
  kMask,
  kOpacity,
  kOverflow,
  kStopColor,
  kStopOpacity,
  kTransform,
  kTransformOrigin,
  kVectorEffect,
  kX,
  kY,
  kWidth,
  kHeight,
  kCx,
  kCy,
  kR,
  kRx,
  kRy,
  kCount
};

/// Computed properties of one element.
class SvgStyle {
 public:
  /// The initial values.
  SvgStyle();

  const std::string& Get(SvgProperty property) const { return values_[static_cast<size_t>(property)]; }
  /// Whether the file has a valid value of the property, for the element or, if it is inherited, one around it.
  bool IsGiven(SvgProperty property) const { return given_[static_cast<size_t>(property)]; }
  /// A number or a percentage, clamped to [0, 1].
  double Share(SvgProperty property) const;
  double font_size() const { return font_size_; }
  bool IsDisplayed() const { return Get(SvgProperty::kDisplay) != "none"; }
  bool IsVisible() const { return Get(SvgProperty::kVisibility) == "visible"; }

 private:
  friend class SvgCascade;

  std::array<std::string, static_cast<size_t>(SvgProperty::kCount)> values_;
  std::bitset<static_cast<size_t>(SvgProperty::kCount)> given_;
  double font_size_ = 16.0;                                              ///< Pixels.
  std::shared_ptr<const std::map<std::string, std::string>> variables_;  ///< Custom properties (--name).
};

/// Cascade and inheritance [CSS Cascade 3; SVG 2, 6]: presentation attributes < style sheets < style attribute, and
/// !important declarations of the sheets and of the attribute above these. inherit, initial, unset, var() and the first
/// colour of light-dark() are replaced. A declaration whose value is invalid is ignored.
class SvgCascade {
 public:
  /// `report` receives a line for each value that is ignored, without its element.
  SvgCascade(const CssStyleSheet& sheet, std::function<void(const std::string&)> report)
      : sheet_(sheet), report_(std::move(report)) {}

  SvgStyle Compute(const pugi::xml_node& element, const SvgStyle& parent) const;

 private:
  const CssStyleSheet& sheet_;
  std::function<void(const std::string&)> report_;
};

/// The fragment of a reference `url(#name)` at the beginning of a value, quoted or not; nothing if there is none.
std::optional<std::string> SvgReference(std::string_view value);

}  // namespace daumier::render
