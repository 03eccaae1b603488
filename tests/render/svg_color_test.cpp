#include "render/svg_color.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

void ExpectColor(std::string_view text, double r, double g, double b, double alpha = 1.0) {
  const auto color = ParseSvgColor(text);
  ASSERT_TRUE(color) << text;
  EXPECT_LT((color->rgb * 255 - Eigen::Vector3d(r, g, b)).cwiseAbs().maxCoeff(), 0.51)
      << text << ": " << color->rgb.transpose() * 255;
  EXPECT_NEAR(color->alpha, alpha, 0.003) << text;
}

TEST(SvgColor, NotationsOfOneColorAgree) {
  for (const char* text :
       {"#36c", "#36CF", "#3366cc", "#3366ccff", "rgb(51,102,204)", "rgb(51 102 204)", "RGB( 20% , 40%, 80% )",
        "rgba(51, 102, 204, 1)", "rgb(51 102 204 / 100%)", "hsl(220, 60%, 50%)", "hsl(220deg 60% 50%)",
        "hsla(220,60%,50%,1)", "hsl(0.6111111turn 60% 50%)", "hsl(-140 60% 50%)", "hwb(220 20% 20%)",
        "color(srgb 0.2 0.4 0.8)", " #3366cc icc-color(a, 1)", "color(display-p3 0.2 0.4 0.8 / 1)"}) {
    ExpectColor(text, 51, 102, 204);
  }
}

TEST(SvgColor, AlphaIsRead) {
  ExpectColor("#3368", 51, 51, 102, 0.533);
  ExpectColor("#33336680", 51, 51, 102, 0.502);
  ExpectColor("rgba(51,51,102,.25)", 51, 51, 102, 0.25);
  ExpectColor("rgb(51 51 102 / 25%)", 51, 51, 102, 0.25);
  ExpectColor("transparent", 0, 0, 0, 0);
}

TEST(SvgColor, NamesAreFoundFromTheFirstToTheLast) {
  ExpectColor("aliceblue", 240, 248, 255);
  ExpectColor("RebeccaPurple", 102, 51, 153);
  ExpectColor("white", 255, 255, 255);
  ExpectColor("yellowgreen", 154, 205, 50);
  ExpectColor("grey", 128, 128, 128);
}

TEST(SvgColor, ValuesOutOfRangeAreClamped) {
  ExpectColor("rgb(300, -20, 0)", 255, 0, 0);
  ExpectColor("hwb(0 80% 80%)", 127.5, 127.5, 127.5);
}

TEST(SvgColor, RefusesEverythingElse) {
  for (const char* text : {"", "#", "#12", "#12345", "#1g1", "none", "url(#a)", "rgb(1,2)", "rgb(1,2,3", "rgb(a,b,c)",
                           "rgb(1e999,0,0)", "lab(1 2 3)", "whiter", "zzz", "color(xyz 1 1 1)", "currentColor"}) {
    EXPECT_FALSE(ParseSvgColor(text)) << text;
  }
}

}  // namespace
}  // namespace daumier::render
