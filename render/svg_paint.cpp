#include "render/svg_paint.h"

#include "render/svg_text.h"

#include <fmt/format.h>
#include <algorithm>

namespace daumier::render {
namespace {

/// Gradients that take their stops from one another, and stops of each that count.
constexpr int kMaxGradients = 16, kMaxStops = 64;

SvgColor ColorOf(const std::string& value, const SvgStyle& style) {
  if (Lowered(value) == "currentcolor") return ParseSvgColor(style.Get(SvgProperty::kColor)).value_or(SvgColor{});
  return ParseSvgColor(value).value_or(SvgColor{});
}

/// The mean of a gradient's stops; nothing if it has none.
std::optional<SvgColor> MeanOfGradient(const SvgDocument& document, pugi::xml_node gradient) {
  const SvgCascade cascade(document.sheet(), [](const std::string&) {});
  for (int i = 0; gradient && i < kMaxGradients; ++i) {
    SvgColor sum{Eigen::Vector3d::Zero(), 0.0};
    double num_stops = 0.0;
    for (const auto& child : gradient.children()) {
      if (document.SvgName(child) != "stop" || num_stops >= kMaxStops) continue;
      const SvgStyle style = cascade.Compute(child, cascade.Compute(gradient, SvgStyle()));
      const SvgColor color = ColorOf(style.Get(SvgProperty::kStopColor), style);
      const double alpha = color.alpha * style.Share(SvgProperty::kStopOpacity);
      sum.rgb += alpha * color.rgb;
      sum.alpha += alpha;
      num_stops += 1.0;
    }
    if (num_stops > 0.0) {
      if (sum.alpha > 0.0) sum.rgb /= sum.alpha;
      return SvgColor{sum.rgb, sum.alpha / num_stops};
    }
    gradient = document.Referenced(gradient);
  }
  return std::nullopt;
}

}  // namespace

std::optional<SvgColor> SvgPaint(const SvgDocument& document, const SvgStyle& style, SvgProperty paint,
                                 const std::function<void(const std::string&)>& report) {
  const std::string& value = style.Get(paint);
  std::string_view word = value;
  std::optional<SvgColor> color;
  if (Lowered(word.substr(0, 4)) == "url(") {
    const auto id = SvgReference(value);
    const pugi::xml_node server = id ? document.ById(*id) : pugi::xml_node();
    const std::string_view name = server ? document.SvgName(server) : "";
    if (name == "pattern" || name == "hatch") {
      report(fmt::format("it is painted with a <{}>, read as grey", name));
      color = SvgColor{Eigen::Vector3d::Constant(0.5), 1.0};
    } else if (name == "linearGradient" || name == "radialGradient" || name == "meshgradient") {
      color = MeanOfGradient(document, server);
    } else {
      word.remove_prefix(std::min(word.find(')') + 1, word.size()));
      word = Trimmed(word);
      if (word.empty()) report(fmt::format("'{}' leads to no paint", value.substr(0, 60)));
    }
  }
  if (!color) {
    const std::string lowered = Lowered(word);
    if (lowered.empty() || lowered == "none" || lowered.starts_with("url(")) return std::nullopt;
    if (lowered.starts_with("context-")) report(fmt::format("'{}' is read as black", value));
    color = ColorOf(std::string(word), style);
  }
  color->alpha *= style.Share(paint == SvgProperty::kFill ? SvgProperty::kFillOpacity : SvgProperty::kStrokeOpacity);
  return color;
}

}  // namespace daumier::render
