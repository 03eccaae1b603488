#include "render/svg_transform.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <string>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using testing::ExpectError;

void ExpectMaps(const std::string& text, const Vector2d& from, const Vector2d& to) {
  const Vector2d found = ParseSvgTransform(text) * from;
  EXPECT_LT((found - to).norm(), 1e-12) << text << ": " << found.transpose();
}

TEST(SvgTransform, EachFunctionIsWorkedOutByHand) {
  ExpectMaps("", {3, 4}, {3, 4});
  ExpectMaps("matrix(1 2 3 4 5 6)", {10, 100}, {10 + 300 + 5, 20 + 400 + 6});
  ExpectMaps("translate(5)", {1, 2}, {6, 2});
  ExpectMaps("translate(5,-1)", {1, 2}, {6, 1});
  ExpectMaps("scale(2)", {1, 2}, {2, 4});
  ExpectMaps("scale(2 3)", {1, 2}, {2, 6});
  ExpectMaps("rotate(90)", {1, 0}, {0, 1});
  ExpectMaps("rotate(90 10 10)", {11, 10}, {10, 11});
  ExpectMaps("skewX(45)", {1, 2}, {3, 2});
  ExpectMaps("skewY(45)", {1, 2}, {1, 3});
}

TEST(SvgTransform, LastOfAListIsAppliedFirst) {
  ExpectMaps("translate(10,0) scale(2)", {1, 1}, {12, 2});
  ExpectMaps("scale(2),translate(10,0)", {1, 1}, {22, 2});
  ExpectMaps(" rotate(90)translate(1) ", {0, 0}, {0, 1});
}

TEST(SvgTransform, FunctionsOfCssHaveUnits) {
  ExpectMaps("none", {3, 4}, {3, 4});
  ExpectMaps("translate(5px, 6px)", {1, 2}, {6, 8});
  ExpectMaps("translateX(5px) translateY(6)", {1, 2}, {6, 8});
  ExpectMaps("scaleX(2) scaleY(3)", {1, 2}, {2, 6});
  ExpectMaps("rotate(0.25turn)", {1, 0}, {0, 1});
  ExpectMaps("rotate(90deg)", {1, 0}, {0, 1});
  ExpectMaps("rotate(100grad)", {1, 0}, {0, 1});
  ExpectMaps("rotate(1.5707963267948966rad)", {1, 0}, {0, 1});
  ExpectError([] { ParseSvgTransform("translate(5%)"); }, "position 11: '%', expected px");
}

TEST(SvgTransform, RefusesMalformedLists) {
  ExpectError([] { ParseSvgTransform("rotate 90"); }, "expected '('");
  ExpectError([] { ParseSvgTransform("rotate(90"); }, "expected ')'");
  ExpectError([] { ParseSvgTransform("rotate(90 1)"); }, "no transform rotate of 2 numbers");
  ExpectError([] { ParseSvgTransform("spin(90)"); }, "no transform spin");
  ExpectError([] { ParseSvgTransform("scale(1e200) scale(1e200)"); }, "not finite");
  ExpectError([] { ParseSvgTransform("scale(1e999)"); }, "finite number");
}

}  // namespace
}  // namespace daumier::render
