#include "render/sheet.h"

#include "core/error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(MakeSheet, PlacesCellsRowByRowWithGaps) {
  std::vector<SheetCell> cells;
  for (int i = 0; i < 3; ++i) cells.push_back({Image(20, 30, 1, static_cast<uint8_t>(10 * i))});
  const Image sheet = MakeSheet(cells, 2, {.gap = 4});
  EXPECT_EQ(sheet.channels, 3);
  EXPECT_EQ(sheet.width, 4 + 30 + 4 + 30 + 4);
  EXPECT_EQ(sheet.height, 4 + 20 + 4 + 20 + 4);
  EXPECT_EQ(sheet.at(4, 4), 0);
  EXPECT_EQ(sheet.at(4, 38), 10);
  EXPECT_EQ(sheet.at(28, 4), 20);
  EXPECT_EQ(sheet.at(30, 40), 255) << "the place of the fourth cell is free";
  EXPECT_EQ(sheet.at(3, 4), 255);
}

TEST(MakeSheet, CentresSmallerPictures) {
  const Image sheet = MakeSheet({{Image(10, 10, 3, 0)}, {Image(20, 10, 3, 0)}, {Image(10, 30, 3, 0)}}, 2, {.gap = 2});
  EXPECT_EQ(sheet.width, 2 + 30 + 2 + 10 + 2);
  EXPECT_EQ(sheet.at(6, 17), 255);
  EXPECT_EQ(sheet.at(7, 12), 0);
  EXPECT_EQ(sheet.at(16, 21), 0);
  EXPECT_EQ(sheet.at(17, 17), 255);
}

TEST(MakeSheet, KeepsRoomForTextOnlyWhereThereIsAny) {
  const SheetCell plain{Image(40, 40, 3, 0)}, captioned{Image(40, 40, 3, 0), "a caption"};
  const Image without = MakeSheet({plain, plain}, 1);
  const Image with_caption = MakeSheet({plain, captioned}, 1);
  EXPECT_EQ(with_caption.height - without.height, 20);
  EXPECT_EQ(with_caption.width, without.width);
  const Image with_titles =
      MakeSheet({plain, plain}, 1, {.title = "T", .column_titles = {"c"}, .row_titles = {"first", "second"}});
  EXPECT_EQ(with_titles.height - without.height, 20 + 28);
  EXPECT_GT(with_titles.width, without.width + 30);
}

TEST(MakeSheet, CaptionsStayBelowTheirPictures) {
  const Image sheet =
      MakeSheet({{Image(40, 40, 3, 128), "a caption that is far too long for its cell"}, {Image(40, 40, 3, 128)}}, 2);
  for (int row = 0; row < sheet.height; ++row) {
    for (int column = 55; column < sheet.width; ++column) EXPECT_GE(sheet.at(row, column), 128) << row << " " << column;
  }
}

TEST(MakeSheet, RefusesBadInput) {
  EXPECT_THROW(MakeSheet({}, 2), Error);
  EXPECT_THROW(MakeSheet({{Image(4, 4, 3)}}, 0), Error);
  EXPECT_THROW(MakeSheet({{Image(4, 4, 3)}}, 1, {.column_titles = {"a", "b"}}), Error);
}

}  // namespace
}  // namespace daumier::render
