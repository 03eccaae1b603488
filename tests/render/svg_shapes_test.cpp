#include "render/svg_shapes.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExpectError;

std::optional<std::string> DataOf(const std::string& markup) {
  pugi::xml_document document;
  document.load_string(markup.c_str());
  const CssStyleSheet sheet;
  const SvgCascade cascade(sheet, [](const std::string& problem) { ADD_FAILURE() << problem; });
  const SvgUnits units{.viewport = Eigen::Vector2d(200, 100)};
  return SvgShapeData(document.document_element(), cascade.Compute(document.document_element(), {}), units);
}

TEST(SvgShapes, AreWorkedOutByHand) {
  EXPECT_EQ(DataOf("<path d='M1 2'/>"), "M1 2");
  EXPECT_EQ(DataOf("<line x1='1' y1='2' x2='3'/>"), "M1 2L3 0");
  EXPECT_EQ(DataOf("<polyline points=' 1,2 3,4 '/>"), "M1,2 3,4");
  EXPECT_EQ(DataOf("<polygon points='1,2 3,4'/>"), "M1,2 3,4Z");
  EXPECT_EQ(DataOf("<rect x='1' y='2' width='3' height='4'/>"), "M1 2h3v4h-3Z");
  EXPECT_EQ(DataOf("<circle cx='5' r='2'/>"), "M7 0A2 2 0 0 1 3 0 2 2 0 0 1 7 0Z");
  EXPECT_EQ(DataOf("<ellipse rx='2' ry='auto'/>"), DataOf("<ellipse rx='2' ry='2'/>"));
  EXPECT_EQ(DataOf("<rect width='9' height='9' rx='2'/>"), DataOf("<rect width='9' height='9' ry='2'/>"));
}

TEST(SvgShapes, LengthsMayBeRelativeOrInStyles) {
  EXPECT_EQ(DataOf("<rect width='100%' height='50%'/>"), "M0 0h200v50h-200Z");
  EXPECT_EQ(DataOf("<rect style='x:1px;y:2px;width:3px;height:4px' width='7'/>"), "M1 2h3v4h-3Z");
  EXPECT_EQ(DataOf("<s:line xmlns:s='x' x2='50%' y2='50%'/>"), "M0 0L100 50");
}

TEST(SvgShapes, WhatPaintsNothingIsEmpty) {
  for (const char* markup : {"<circle/>", "<circle r='-1'/>", "<rect width='3'/>", "<ellipse ry='0' rx='2'/>",
                             "<polygon/>", "<path/>", "<path d='none'/>"})
    EXPECT_EQ(DataOf(markup), "") << markup;
  EXPECT_FALSE(DataOf("<g/>"));
  ExpectError([] { DataOf("<circle r='big'/>"); }, "position 0: 'big'");
}

}  // namespace
}  // namespace daumier::render
