#include "render/svg_color.h"

#include "core/error.h"
#include "render/svg_path.h"
#include "render/svg_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace daumier::render {
namespace {

using Eigen::Vector3d;

struct NamedColor {
  std::string_view name;
  uint32_t value;
};

/// [CSS Color 4, 6.1], sorted by name.
constexpr NamedColor kNamedColors[] = {{"aliceblue", 0xf0f8ff},
                                       {"antiquewhite", 0xfaebd7},
                                       {"aqua", 0x00ffff},
                                       {"aquamarine", 0x7fffd4},
                                       {"azure", 0xf0ffff},
                                       {"beige", 0xf5f5dc},
                                       {"bisque", 0xffe4c4},
                                       {"black", 0x000000},
                                       {"blanchedalmond", 0xffebcd},
                                       {"blue", 0x0000ff},
                                       {"blueviolet", 0x8a2be2},
                                       {"brown", 0xa52a2a},
                                       {"burlywood", 0xdeb887},
                                       {"cadetblue", 0x5f9ea0},
                                       {"chartreuse", 0x7fff00},
                                       {"chocolate", 0xd2691e},
                                       {"coral", 0xff7f50},
                                       {"cornflowerblue", 0x6495ed},
                                       {"cornsilk", 0xfff8dc},
                                       {"crimson", 0xdc143c},
                                       {"cyan", 0x00ffff},
                                       {"darkblue", 0x00008b},
                                       {"darkcyan", 0x008b8b},
                                       {"darkgoldenrod", 0xb8860b},
                                       {"darkgray", 0xa9a9a9},
                                       {"darkgreen", 0x006400},
                                       {"darkgrey", 0xa9a9a9},
                                       {"darkkhaki", 0xbdb76b},
                                       {"darkmagenta", 0x8b008b},
                                       {"darkolivegreen", 0x556b2f},
                                       {"darkorange", 0xff8c00},
                                       {"darkorchid", 0x9932cc},
                                       {"darkred", 0x8b0000},
                                       {"darksalmon", 0xe9967a},
                                       {"darkseagreen", 0x8fbc8f},
                                       {"darkslateblue", 0x483d8b},
                                       {"darkslategray", 0x2f4f4f},
                                       {"darkslategrey", 0x2f4f4f},
                                       {"darkturquoise", 0x00ced1},
                                       {"darkviolet", 0x9400d3},
                                       {"deeppink", 0xff1493},
                                       {"deepskyblue", 0x00bfff},
                                       {"dimgray", 0x696969},
                                       {"dimgrey", 0x696969},
                                       {"dodgerblue", 0x1e90ff},
                                       {"firebrick", 0xb22222},
                                       {"floralwhite", 0xfffaf0},
                                       {"forestgreen", 0x228b22},
                                       {"fuchsia", 0xff00ff},
                                       {"gainsboro", 0xdcdcdc},
                                       {"ghostwhite", 0xf8f8ff},
                                       {"gold", 0xffd700},
                                       {"goldenrod", 0xdaa520},
                                       {"gray", 0x808080},
                                       {"green", 0x008000},
                                       {"greenyellow", 0xadff2f},
                                       {"grey", 0x808080},
                                       {"honeydew", 0xf0fff0},
                                       {"hotpink", 0xff69b4},
                                       {"indianred", 0xcd5c5c},
                                       {"indigo", 0x4b0082},
                                       {"ivory", 0xfffff0},
                                       {"khaki", 0xf0e68c},
                                       {"lavender", 0xe6e6fa},
                                       {"lavenderblush", 0xfff0f5},
                                       {"lawngreen", 0x7cfc00},
                                       {"lemonchiffon", 0xfffacd},
                                       {"lightblue", 0xadd8e6},
                                       {"lightcoral", 0xf08080},
                                       {"lightcyan", 0xe0ffff},
                                       {"lightgoldenrodyellow", 0xfafad2},
                                       {"lightgray", 0xd3d3d3},
                                       {"lightgreen", 0x90ee90},
                                       {"lightgrey", 0xd3d3d3},
                                       {"lightpink", 0xffb6c1},
                                       {"lightsalmon", 0xffa07a},
                                       {"lightseagreen", 0x20b2aa},
                                       {"lightskyblue", 0x87cefa},
                                       {"lightslategray", 0x778899},
                                       {"lightslategrey", 0x778899},
                                       {"lightsteelblue", 0xb0c4de},
                                       {"lightyellow", 0xffffe0},
                                       {"lime", 0x00ff00},
                                       {"limegreen", 0x32cd32},
                                       {"linen", 0xfaf0e6},
                                       {"magenta", 0xff00ff},
                                       {"maroon", 0x800000},
                                       {"mediumaquamarine", 0x66cdaa},
                                       {"mediumblue", 0x0000cd},
                                       {"mediumorchid", 0xba55d3},
                                       {"mediumpurple", 0x9370db},
                                       {"mediumseagreen", 0x3cb371},
                                       {"mediumslateblue", 0x7b68ee},
                                       {"mediumspringgreen", 0x00fa9a},
                                       {"mediumturquoise", 0x48d1cc},
                                       {"mediumvioletred", 0xc71585},
                                       {"midnightblue", 0x191970},
                                       {"mintcream", 0xf5fffa},
                                       {"mistyrose", 0xffe4e1},
                                       {"moccasin", 0xffe4b5},
                                       {"navajowhite", 0xffdead},
                                       {"navy", 0x000080},
                                       {"oldlace", 0xfdf5e6},
                                       {"olive", 0x808000},
                                       {"olivedrab", 0x6b8e23},
                                       {"orange", 0xffa500},
                                       {"orangered", 0xff4500},
                                       {"orchid", 0xda70d6},
                                       {"palegoldenrod", 0xeee8aa},
                                       {"palegreen", 0x98fb98},
                                       {"paleturquoise", 0xafeeee},
                                       {"palevioletred", 0xdb7093},
                                       {"papayawhip", 0xffefd5},
                                       {"peachpuff", 0xffdab9},
                                       {"peru", 0xcd853f},
                                       {"pink", 0xffc0cb},
                                       {"plum", 0xdda0dd},
                                       {"powderblue", 0xb0e0e6},
                                       {"purple", 0x800080},
                                       {"rebeccapurple", 0x663399},
                                       {"red", 0xff0000},
                                       {"rosybrown", 0xbc8f8f},
                                       {"royalblue", 0x4169e1},
                                       {"saddlebrown", 0x8b4513},
                                       {"salmon", 0xfa8072},
                                       {"sandybrown", 0xf4a460},
                                       {"seagreen", 0x2e8b57},
                                       {"seashell", 0xfff5ee},
                                       {"sienna", 0xa0522d},
                                       {"silver", 0xc0c0c0},
                                       {"skyblue", 0x87ceeb},
                                       {"slateblue", 0x6a5acd},
                                       {"slategray", 0x708090},
                                       {"slategrey", 0x708090},
                                       {"snow", 0xfffafa},
                                       {"springgreen", 0x00ff7f},
                                       {"steelblue", 0x4682b4},
                                       {"tan", 0xd2b48c},
                                       {"teal", 0x008080},
                                       {"thistle", 0xd8bfd8},
                                       {"tomato", 0xff6347},
                                       {"turquoise", 0x40e0d0},
                                       {"violet", 0xee82ee},
                                       {"wheat", 0xf5deb3},
                                       {"white", 0xffffff},
                                       {"whitesmoke", 0xf5f5f5},
                                       {"yellow", 0xffff00},
                                       {"yellowgreen", 0x9acd32}};

SvgColor ColorOfBytes(uint32_t value) {
  return {Vector3d((value >> 16) & 255, (value >> 8) & 255, value & 255) / 255.0, 1.0};
}

/// The digits after '#'.
std::optional<SvgColor> HexColor(std::string_view digits) {
  std::vector<double> values;
  for (const char c : digits) {
    const std::string_view all = "0123456789abcdef";
    const size_t value = all.find(c);
    if (value == std::string_view::npos) return std::nullopt;
    values.push_back(static_cast<double>(value));
  }
  const size_t count = values.size();
  const auto part = [&](size_t i) {
    return count <= 4 ? values[i] / 15.0 : (16.0 * values[2 * i] + values[2 * i + 1]) / 255.0;
  };
  if (count != 3 && count != 4 && count != 6 && count != 8) return std::nullopt;
  return SvgColor{{part(0), part(1), part(2)}, count % 4 == 0 ? part(3) : 1.0};
}

/// A number, what its percentage sign or unit of angle makes of it, and `none`, which is 0.
struct ColorPart {
  double value;
  std::string unit;
};

/// The parts of a function between its parentheses, separated by commas, white space and, before alpha, a slash.
std::optional<std::vector<ColorPart>> ColorParts(std::string_view text) {
  std::vector<ColorPart> parts;
  SvgNumbers numbers(text);
  numbers.SkipSeparators();
  while (!numbers.AtEnd()) {
    if (numbers.Peek() == '/' || numbers.Peek() == ',') {
      numbers.Take();
    } else if (numbers.AtNumber()) {
      parts.push_back({numbers.Number(), {}});
      while (!numbers.AtEnd() && (numbers.Peek() == '%' || (numbers.Peek() >= 'a' && numbers.Peek() <= 'z'))) {
        parts.back().unit += numbers.Take();
      }
    } else if (text.substr(numbers.position()).starts_with("none")) {
      for (int i = 0; i < 4; ++i) numbers.Take();
      parts.push_back({0.0, {}});
    } else {
      return std::nullopt;
    }
    numbers.SkipSeparators();
  }
  if (parts.size() != 3 && parts.size() != 4) return std::nullopt;
  return parts;
}

/// A share of `whole`, or of 100 %.
double ShareOf(const ColorPart& part, double whole) {
  return std::clamp(part.value / (part.unit == "%" ? 100.0 : whole), 0.0, 1.0);
}

/// Turns, in [0, 1).
double HueOf(const ColorPart& part) {
  double turns = part.value / 360.0;
  if (part.unit == "rad") turns = part.value / (2.0 * std::numbers::pi);
  if (part.unit == "grad") turns = part.value / 400.0;
  if (part.unit == "turn") turns = part.value;
  return turns - std::floor(turns);
}

/// [CSS Color 4, 7.1]
Vector3d RgbOfHsl(double hue, double saturation, double lightness) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + 12.0 * hue, 12.0);
    const double reach = saturation * std::min(lightness, 1.0 - lightness);
    return lightness - reach * std::max(-1.0, std::min({k - 3.0, 9.0 - k, 1.0}));
  };
  return {channel(0), channel(8), channel(4)};
}

std::optional<SvgColor> FunctionColor(std::string_view name, std::string_view inside) {
  double whole = 255.0;
  if (name == "color") {
    inside = Trimmed(inside);
    const std::string_view space = inside.substr(0, inside.find_first_of(kSvgSpace));
    if (space != "srgb" && space != "display-p3") return std::nullopt;
    inside.remove_prefix(space.size());
    whole = 1.0;
  }
  const auto parts = ColorParts(inside);
  if (!parts) return std::nullopt;
  const double alpha = parts->size() == 4 ? ShareOf((*parts)[3], 1.0) : 1.0;
  const ColorPart &first = (*parts)[0], &second = (*parts)[1], &third = (*parts)[2];
  if (name == "rgb" || name == "rgba" || name == "color") {
    return SvgColor{{ShareOf(first, whole), ShareOf(second, whole), ShareOf(third, whole)}, alpha};
  }
  const double hue = HueOf(first), b = ShareOf(second, 100.0), c = ShareOf(third, 100.0);
  if (name == "hsl" || name == "hsla") return SvgColor{RgbOfHsl(hue, b, c), alpha};
  if (name != "hwb") return std::nullopt;
  if (b + c >= 1.0) return SvgColor{Vector3d::Constant(b / (b + c)), alpha};
  return SvgColor{RgbOfHsl(hue, 1.0, 0.5) * (1.0 - b - c) + Vector3d::Constant(b), alpha};
}

}  // namespace

std::optional<SvgColor> ParseSvgColor(std::string_view text) {
  const std::string lowered = Lowered(Trimmed(text));
  const std::string_view word = lowered;
  if (word == "transparent") return SvgColor{Vector3d::Zero(), 0.0};
  if (word.starts_with('#')) return HexColor(word.substr(1, word.find_first_of(kSvgSpace) - 1));
  if (const size_t open = word.find('('); open != std::string_view::npos) {
    const size_t close = word.find(')', open);
    if (close == std::string_view::npos) return std::nullopt;
    try {
      return FunctionColor(Trimmed(word.substr(0, open)), word.substr(open + 1, close - open - 1));
    } catch (const Error&) {  // A number that no double can hold.
      return std::nullopt;
    }
  }
  const auto* const found = std::lower_bound(std::begin(kNamedColors), std::end(kNamedColors), word,
                                             [](const NamedColor& c, std::string_view name) { return c.name < name; });
  if (found == std::end(kNamedColors) || found->name != word) return std::nullopt;
  return ColorOfBytes(found->value);
}

}  // namespace daumier::render
