#include "render/svg_picture.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

Rgb ColourAt(const Image& picture, int row, int column) {
  return {picture.at(row, column, 0), picture.at(row, column, 1), picture.at(row, column, 2)};
}

class SvgPicture : public ::testing::Test {
 protected:
  Image Paint(const std::string& body, double* scale = nullptr) const {
    const auto file = folder_.path() / "drawing.svg";
    WriteFileAtomically(file, R"(<svg xmlns="http://www.w3.org/2000/svg" width="100" height="50">)" + body + "</svg>");
    return PaintSvg(file, 200, scale);
  }

  const daumier::testing::TempDir folder_;
};

TEST_F(SvgPicture, HasAreasAndStrokesInTheirOrderAndColours) {
  double scale = 0;
  const Image picture = Paint(
      R"(<rect x="10" y="10" width="40" height="30" fill="#ff0000"/>
         <rect x="30" y="10" width="40" height="30" fill="#0000ff" fill-opacity="0.5"/>
         <path d="M5 45 L95 45" stroke="#00ff00" stroke-width="4" fill="none"/>)",
      &scale);
  ASSERT_EQ(picture.width, 200);
  ASSERT_EQ(picture.height, 100);
  EXPECT_EQ(scale, 2);
  EXPECT_EQ(ColourAt(picture, 4, 4), (Rgb{255, 255, 255}));
  EXPECT_EQ(ColourAt(picture, 50, 40), (Rgb{255, 0, 0}));
  EXPECT_EQ(ColourAt(picture, 50, 80), (Rgb{128, 0, 128})) << "half of blue over red";
  EXPECT_EQ(ColourAt(picture, 50, 120), (Rgb{128, 128, 255})) << "half of blue over white";
  EXPECT_EQ(ColourAt(picture, 90, 100), (Rgb{0, 255, 0}));
  EXPECT_EQ(ColourAt(picture, 96, 100), (Rgb{255, 255, 255}));
}

TEST_F(SvgPicture, CutsOffWhatLiesBeyondTheSheet) {
  const Image picture = Paint(R"(<rect x="-1e7" y="-10" width="2e7" height="20" fill="red"/>
                                 <path d="M-1e8 30 L1e8 30" stroke="blue" stroke-width="6"/>)");
  EXPECT_EQ(ColourAt(picture, 10, 100), (Rgb{255, 0, 0}));
  EXPECT_EQ(ColourAt(picture, 60, 100), (Rgb{0, 0, 255}));
}

TEST_F(SvgPicture, RefusesWhatIsNoSvg) {
  const auto file = folder_.path() / "none.svg";
  WriteFileAtomically(file, "no xml");
  daumier::testing::ExpectError([&] { PaintSvg(file); }, "none.svg");
}

}  // namespace
}  // namespace daumier::render
