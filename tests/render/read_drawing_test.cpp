#include "render/read_drawing.h"

#include "core/files.h"
#include "render/image.h"
#include "render/svg.h"
#include "tests/render/gzipped.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExpectError;

const std::vector<Stroke> kStrokes = {{1, {{40, 60}, {220, 190}}}, {0, {{50, 200}, {210, 40}}}};

TEST(ReadDrawings, ReadsEachFormatByItsSuffix) {
  const testing::TempDir folder;
  WriteSvg(folder / "vector.SVG", kStrokes, {"a", "b"});
  testing::WriteQuickly(folder / "packed.svgz", testing::Gzipped(ReadFile(folder / "vector.SVG")));
  testing::WriteQuickly(folder / "many.ndjson", "{\"drawing\":[[[0],[0]]]}\n{\"drawing\":[[[1],[1]]]}\n");
  WriteImage(folder / "picture.png", RasteriseStrokes(kStrokes, 300));

  const auto vector = ReadDrawings(folder / "vector.SVG", {"a", "b"});
  ASSERT_EQ(vector.size(), 1U);
  EXPECT_EQ(vector[0].strokes[0].points, kStrokes[0].points);
  EXPECT_EQ(vector[0].strokes[0].kind, 1);
  EXPECT_EQ(ReadDrawings(folder / "vector.SVG")[0].strokes[0].kind, 0);
  EXPECT_EQ(ReadDrawings(folder / "packed.svgz")[0].strokes[1].points, kStrokes[1].points);
  EXPECT_EQ(ReadDrawings(folder / "many.ndjson").size(), 2U);
  const auto picture = ReadDrawings(folder / "picture.png");
  ASSERT_EQ(picture.size(), 1U);
  EXPECT_EQ(picture[0].width, 300.0);
  EXPECT_EQ(picture[0].strokes.size(), 2U);
}

TEST(ReadDrawings, ErrorsNameTheFile) {
  const testing::TempDir folder;
  WriteImage(folder / "blank.png", Image(40, 40, 1, 255));
  ExpectError([&] { ReadDrawings(folder / "blank.png"); }, "blank.png: the picture holds no lines");
  testing::WriteQuickly(folder / "text.txt", "no picture");
  ExpectError([&] { ReadDrawings(folder / "text.txt"); }, "text.txt: not a readable picture");
  for (const char* name : {"absent.svg", "absent.ndjson", "absent.png"}) {
    ExpectError([&] { ReadDrawings(folder / name); }, name);
  }
  WriteImage(folder / "cut.png", RasteriseStrokes(kStrokes, 100));
  const std::string bytes = ReadFile(folder / "cut.png");
  testing::WriteQuickly(folder / "cut.png", std::string_view(bytes).substr(0, bytes.size() / 2));
  ExpectError([&] { ReadDrawings(folder / "cut.png"); }, "cut.png");
}

}  // namespace
}  // namespace daumier::render
