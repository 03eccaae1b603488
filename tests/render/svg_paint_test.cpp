#include "render/svg_paint.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using Eigen::Vector3d;

/// The fill of the last element of a document, and what was reported.
struct PaintOfLast {
  std::optional<SvgColor> color;
  std::string problem;
};
PaintOfLast FillOfLast(const std::string& elements) {
  const SvgDocument document("a.svg", "<svg>" + elements + "</svg>");
  PaintOfLast paint;
  const SvgCascade cascade(document.sheet(), [](const std::string& problem) { ADD_FAILURE() << problem; });
  const SvgStyle style = cascade.Compute(document.root().last_child(), SvgStyle());
  paint.color = SvgPaint(document, style, SvgProperty::kFill, [&](const auto& problem) { paint.problem = problem; });
  return paint;
}

TEST(SvgPaint, ColorsAndOpacitiesAreMultiplied) {
  EXPECT_FALSE(FillOfLast("<a fill='none'/>").color);
  EXPECT_EQ(FillOfLast("<a fill='red' fill-opacity='0.5' opacity='0.5'/>").color->alpha, 0.5);
  EXPECT_EQ(FillOfLast("<a fill='#ff000080' fill-opacity='50%'/>").color->alpha, 0.5 * 128 / 255);
  EXPECT_EQ(FillOfLast("<a fill='currentColor' color='lime'/>").color->rgb, Vector3d(0, 1, 0));
}

TEST(SvgPaint, GradientsAreTheMeanOfTheirStops) {
  const std::string gradient =
      "<linearGradient id='a'><stop stop-color='#fff'/><stop style='stop-color:black' offset='1'/></linearGradient>";
  EXPECT_EQ(FillOfLast(gradient + "<a fill='url(#a)'/>").color->rgb, Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(FillOfLast(gradient + "<radialGradient id='b' href='#a'/><a fill='url(#b)'/>").color->rgb,
            Vector3d(0.5, 0.5, 0.5));
  // What is transparent has no weight in the colour.
  const auto faded = FillOfLast(
      "<linearGradient id='a'><stop stop-color='red'/><stop stop-opacity='0'/></linearGradient>"
      "<a fill='url(#a)'/>");
  EXPECT_EQ(faded.color->rgb, Vector3d(1, 0, 0));
  EXPECT_EQ(faded.color->alpha, 0.5);
  EXPECT_FALSE(FillOfLast("<linearGradient id='a' href='#a'/><a fill='url(#a)'/>").color) << "it has no stops";
}

TEST(SvgPaint, ReferencesFallBackAndAreReported) {
  EXPECT_EQ(FillOfLast("<a fill='url(#none) blue'/>").color->rgb, Vector3d(0, 0, 1));
  EXPECT_FALSE(FillOfLast("<a fill='url(#none) none'/>").color);
  EXPECT_EQ(FillOfLast("<a fill='url(#none)'/>").problem, "'url(#none)' leads to no paint");
  const auto pattern = FillOfLast("<pattern id='a'/><a fill='url(#a)'/>");
  EXPECT_EQ(pattern.color->rgb, Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(pattern.problem, "it is painted with a <pattern>, read as grey");
}

}  // namespace
}  // namespace daumier::render
