#include "render/svg_elements.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(SvgElements, EachNameHasItsKind) {
  EXPECT_EQ(SvgElementOf("g"), SvgElement::kGroup);
  EXPECT_EQ(SvgElementOf("a"), SvgElement::kGroup);
  EXPECT_EQ(SvgElementOf("svg"), SvgElement::kViewport);
  EXPECT_EQ(SvgElementOf("symbol"), SvgElement::kSymbol);
  EXPECT_EQ(SvgElementOf("use"), SvgElement::kUse);
  EXPECT_EQ(SvgElementOf("switch"), SvgElement::kSwitch);
  EXPECT_EQ(SvgElementOf("polyline"), SvgElement::kShape);
  EXPECT_EQ(SvgElementOf("clipPath"), SvgElement::kUnpainted);
  EXPECT_EQ(SvgElementOf("foreignObject"), SvgElement::kNoStrokes);
  EXPECT_EQ(SvgElementOf("Path"), SvgElement::kUnknown);
  EXPECT_EQ(SvgElementOf(""), SvgElement::kUnknown);
}

}  // namespace
}  // namespace daumier::render
