#include "render/read_drawing.h"

#include "core/files.h"
#include "render/faces_on_sheet.h"
#include "render/image.h"
#include "render/svg.h"
#include "tests/render/gzipped.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <Eigen/Core>

#include <algorithm>

namespace daumier::render {
namespace {

using testing::ExpectError;

const std::vector<Stroke> kStrokes = {{1, {{40, 60}, {220, 190}}}, {0, {{50, 200}, {210, 40}}}};

/// Of the strokes' points from the lines of others that are enlarged and then moved to the right.
double MeanDistance(const std::vector<Stroke>& strokes, const std::vector<Stroke>& others, double scale, double right) {
  double sum = 0, count = 0;
  for (const Stroke& stroke : strokes) {
    for (const auto& [x, y] : stroke.points) {
      const Eigen::Vector2d point(x, y);
      double nearest = 1e9;
      for (const Stroke& other : others) {
        for (size_t i = 1; i < other.points.size(); ++i) {
          const Eigen::Vector2d from(scale * other.points[i - 1][0] + right, scale * other.points[i - 1][1]),
              to(scale * other.points[i][0] + right, scale * other.points[i][1]);
          const double share = std::clamp((point - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
          nearest = std::min(nearest, (from + share * (to - from) - point).norm());
        }
      }
      sum += nearest, count += 1;
    }
  }
  return sum / count;
}

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

TEST(ReadDrawings, ReadsEachFormatByItsContentWhateverItsName) {
  const testing::TempDir folder;
  WriteSvg(folder / "vector.svg", kStrokes, {"a", "b"});
  WriteImage(folder / "picture.png", RasteriseStrokes(kStrokes, 300));
  std::filesystem::rename(folder / "vector.svg", folder / "vector.png");
  std::filesystem::rename(folder / "picture.png", folder / "picture.svg");
  testing::WriteQuickly(folder / "one.json", "{\"word\":\"face\",\"drawing\":[[[0,9],[0,9]]]}");
  testing::WriteQuickly(folder / "trace.xml",
                        "<ink xmlns=\"http://www.w3.org/2003/InkML\"><trace>0 0,9 9</trace></ink>");
  testing::WriteQuickly(folder / "page.gz",
                        testing::Gzipped("<?xml version=\"1.0\"?><xournal><page><layer><stroke>0 0 9 9"
                                         "</stroke></layer></page></xournal>"));
  EXPECT_EQ(ReadDrawings(folder / "vector.png").at(0).strokes.size(), 2U);
  EXPECT_EQ(ReadDrawings(folder / "picture.svg").at(0).strokes.size(), 2U);
  for (const char* name : {"one.json", "trace.xml", "page.gz"})
    EXPECT_EQ(ReadDrawings(folder / name).at(0).strokes.at(0).points.size(), 2U) << name;
}

TEST(ReadDrawings, RefusesOtherFormatsByTheirContentWhateverTheirName) {
  const testing::TempDir folder;
  for (const char* name : {"face.svg", "face.png", "face.ndjson", "face.xopp", "face.inkml"}) {
    testing::WriteQuickly(folder / name, "%PDF-1.7");
    ExpectError([&] { ReadDrawings(folder / name); }, std::string(name) + ": this is a PDF");
    testing::WriteQuickly(folder / name, "");
    ExpectError([&] { ReadDrawings(folder / name); }, std::string(name) + ": the file is empty");
  }
}

// A sheet of two faces is twice as wide, and each is as fine as on a sheet of its own.
TEST(ReadDrawings, TracesEachOfTwoFacesAsFinelyAsOne) {
  std::vector<Stroke> face = {{0, {{60, 60}, {60, 150}, {128, 210}, {196, 150}, {196, 60}, {60, 60}}},
                              {0, {{85, 95}, {110, 95}}},
                              {0, {{146, 95}, {171, 95}}},
                              {0, {{128, 100}, {118, 140}, {134, 142}}},
                              {0, {{100, 170}, {156, 170}}}};
  const Image one = RasteriseStrokes(face, 512);
  Image two(512, 1024, 1);
  for (int row = 0; row < 512; ++row)
    for (int column = 0; column < 1024; ++column) two.at(row, column) = one.at(row, column % 512);
  const testing::TempDir folder;
  WriteImage(folder / "one.png", one);
  WriteImage(folder / "two.png", two);
  const Drawing alone = ReadDrawings(folder / "one.png").at(0), both = ReadDrawings(folder / "two.png").at(0);
  EXPECT_EQ(both.width, 1024);
  EXPECT_EQ(both.strokes.size(), 2 * alone.strokes.size());
  const auto faces = FacesOnSheet(both);
  ASSERT_EQ(faces.size(), 2U);
  const double error = MeanDistance(alone.strokes, face, 2.0, 0.0);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_LT(MeanDistance(faces[i].strokes, face, 2.0, 512.0 * double(i)), error + 0.1) << i;
    EXPECT_LT(error, 1.0);
  }
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
