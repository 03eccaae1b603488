#include "render/contour_drawing.h"

#include "core/files.h"
#include "render/contour_strokes.h"
#include "render/svg.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

std::vector<Stroke> Line(int kind) {
  Stroke stroke;
  stroke.kind = kind;
  stroke.points = {{10, 10}, {20, 30}};
  return {stroke};
}

TEST(IsContourDrawing, IsTrueOfWhatDrawWrites) {
  const testing::TempDir folder;
  for (int kind = 0; kind < std::ssize(ContourKinds()); ++kind) {
    WriteSvg(folder / "a.svg", Line(kind), ContourKinds());
    EXPECT_TRUE(IsContourDrawing(folder / "a.svg"));
  }
  WriteSvg(folder / "a.svg", {}, ContourKinds());
  EXPECT_TRUE(IsContourDrawing(folder / "a.svg"));
}

TEST(IsContourDrawing, IsFalseOfEverythingElse) {
  const testing::TempDir folder;
  const auto is_one = [&](const std::string& bytes) {
    WriteFileAtomically(folder / "a.svg", bytes);
    return IsContourDrawing(folder / "a.svg");
  };
  WriteSvg(folder / "ours.svg", Line(0), ContourKinds());
  const std::string ours = ReadFile(folder / "ours.svg");
  ASSERT_TRUE(is_one(ours));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bytes = ours;
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  EXPECT_FALSE(is_one(with("<path", "<circle r=\"3\"/><path")));
  EXPECT_FALSE(is_one(with("<path", "<!-- mine --><path")));
  EXPECT_FALSE(is_one(with("<path", "<path id=\"nose\"")));
  EXPECT_FALSE(is_one(with("class=\"occluding\"", "class=\"line\"")));
  EXPECT_FALSE(is_one(with("xmlns=", "xmlns:inkscape=\"x\" xmlns=")));
  EXPECT_FALSE(is_one("v 0 0 0\n"));
  EXPECT_FALSE(is_one(""));
  WriteSvg(folder / "a.svg", Line(0), {"line"});
  EXPECT_FALSE(IsContourDrawing(folder / "a.svg")) << "of a prediction";
  EXPECT_FALSE(IsContourDrawing(folder / "absent.svg"));
  EXPECT_FALSE(IsContourDrawing(folder.path()));
}

}  // namespace
}  // namespace daumier::render
