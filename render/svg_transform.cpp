#include "render/svg_transform.h"

#include "core/error.h"
#include "render/svg_path.h"

#include <cctype>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace daumier::render {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

double Radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// x' = a x + c y + e, y' = b x + d y + f.
Affine2d Matrix(double a, double b, double c, double d, double e, double f) {
  Affine2d transform = Affine2d::Identity();
  transform.linear() << a, c, b, d;
  transform.translation() = Vector2d(e, f);
  return transform;
}

/// Pixels or degrees of the unit after a number; 1 where there is none. @throws Error if it is unknown.
double TakeUnit(SvgNumbers& numbers) {
  const size_t position = numbers.position();
  std::string unit;
  while (!numbers.AtEnd() && (numbers.Peek() == '%' || std::isalpha(static_cast<unsigned char>(numbers.Peek())))) {
    unit += numbers.Take();
  }
  for (const auto& [name, factor] : {std::pair{"", 1.0},
                                     {"px", 1.0},
                                     {"deg", 1.0},
                                     {"rad", 180.0 / std::numbers::pi},
                                     {"grad", 0.9},
                                     {"turn", 360.0}}) {
    if (unit == name) return factor;
  }
  throw Error(fmt::format("position {}: '{}', expected px, deg, rad, grad, turn or no unit", position, unit));
}

/// @throws Error if no function of that name takes this number of values.
Affine2d TransformOf(std::string_view name, const std::vector<double>& values) {
  const size_t count = values.size();
  const auto value = [&](size_t i, double otherwise = 0.0) { return i < count ? values[i] : otherwise; };
  if (name == "matrix" && count == 6) return Matrix(values[0], values[1], values[2], values[3], values[4], values[5]);
  if (name == "translate" && (count == 1 || count == 2)) return Matrix(1, 0, 0, 1, value(0), value(1));
  if (name == "scale" && (count == 1 || count == 2)) return Matrix(value(0), 0, 0, value(1, value(0)), 0, 0);
  if (name == "rotate" && (count == 1 || count == 3)) {
    const Vector2d centre(value(1), value(2));
    Affine2d transform = Affine2d::Identity();
    return transform.translate(centre).rotate(Radians(values[0])).translate(-centre);
  }
  if ((name == "translateX" || name == "scaleX") && count == 1)
    return name == "scaleX" ? Matrix(values[0], 0, 0, 1, 0, 0) : Matrix(1, 0, 0, 1, values[0], 0);
  if ((name == "translateY" || name == "scaleY") && count == 1)
    return name == "scaleY" ? Matrix(1, 0, 0, values[0], 0, 0) : Matrix(1, 0, 0, 1, 0, values[0]);
  if (name == "skewX" && count == 1) return Matrix(1, 0, std::tan(Radians(values[0])), 1, 0, 0);
  if (name == "skewY" && count == 1) return Matrix(1, std::tan(Radians(values[0])), 0, 1, 0, 0);
  throw Error(fmt::format("there is no transform {} of {} numbers", name, count));
}

}  // namespace

Affine2d ParseSvgTransform(std::string_view text) {
  if (text == "none") return Affine2d::Identity();
  Affine2d product = Affine2d::Identity();
  SvgNumbers numbers(text);
  numbers.SkipSeparators();
  while (!numbers.AtEnd()) {
    std::string name;
    while (!numbers.AtEnd() && std::isalpha(static_cast<unsigned char>(numbers.Peek()))) name += numbers.Take();
    numbers.SkipSeparators();
    DAUMIER_CHECK(!numbers.AtEnd() && numbers.Take() == '(', "position {}: expected '(' after '{}'", numbers.position(),
                  name);
    std::vector<double> values;
    numbers.SkipSeparators();
    while (!numbers.AtEnd() && numbers.AtNumber()) {
      const double value = numbers.Number();
      values.push_back(value * TakeUnit(numbers));
      numbers.SkipSeparators();
    }
    DAUMIER_CHECK(!numbers.AtEnd() && numbers.Take() == ')', "position {}: expected ')' after the numbers of '{}'",
                  numbers.position(), name);
    product = product * TransformOf(name, values);
    while (!numbers.AtEnd() && numbers.Peek() == ',') numbers.Take();
    numbers.SkipSeparators();
  }
  DAUMIER_CHECK(product.matrix().allFinite(), "the transform is not finite");
  return product;
}

}  // namespace daumier::render
