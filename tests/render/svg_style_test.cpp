#include "render/svg_style.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

/// The style of the innermost first child of a document, and what was reported on the way.
struct Computed {
  SvgStyle style;
  std::vector<std::string> problems;
};
Computed ComputedOf(const std::string& markup, const std::string& css = "") {
  pugi::xml_document document;
  document.load_string(markup.c_str());
  CssStyleSheet sheet;
  sheet.Add(css);
  Computed computed;
  const SvgCascade cascade(sheet, [&](const std::string& problem) { computed.problems.push_back(problem); });
  for (auto node = document.document_element(); node; node = node.first_child())
    computed.style = cascade.Compute(node, computed.style);
  return computed;
}
std::string FillOf(const std::string& markup, const std::string& css = "") {
  return ComputedOf(markup, css).style.Get(SvgProperty::kFill);
}

TEST(SvgStyle, SheetsAreAboveAttributesAndBelowStyleAttributes) {
  EXPECT_EQ(FillOf("<a/>"), "black");
  EXPECT_EQ(FillOf("<a fill='red'/>"), "red");
  EXPECT_EQ(FillOf("<a fill='red'/>", "a{fill:blue}"), "blue");
  EXPECT_EQ(FillOf("<a fill='red' style='fill: green'/>", "a{fill:blue}"), "green");
  EXPECT_EQ(FillOf("<a fill='red' style='fill: green'/>", "a{fill:blue!important}"), "blue");
  EXPECT_EQ(FillOf("<a style='fill: green !important'/>", "a{fill:blue!important}"), "green");
  EXPECT_EQ(FillOf("<a style='fill:green;fill:color(display-p3 1 0 0)'/>"), "color(display-p3 1 0 0)");
}

TEST(SvgStyle, KnowsWhatTheFileGives) {
  const auto is_given = [](const std::string& markup, const std::string& css = "") {
    return ComputedOf(markup, css).style.IsGiven(SvgProperty::kStroke);
  };
  EXPECT_FALSE(is_given("<a/>"));
  EXPECT_FALSE(is_given("<a fill='red'/>"));
  EXPECT_FALSE(is_given("<a stroke='nonsense'/>"));
  EXPECT_FALSE(is_given("<a><b stroke='inherit'/></a>"));
  EXPECT_TRUE(is_given("<a stroke='none'/>"));
  EXPECT_TRUE(is_given("<a stroke='none'><b><c/></b></a>"));
  EXPECT_TRUE(is_given("<a/>", "a{stroke:black}"));
  EXPECT_TRUE(is_given("<a style='stroke: initial'/>"));
}

TEST(SvgStyle, InheritsWhatIsInherited) {
  const auto computed = ComputedOf("<a fill='red' opacity='0.5' display='none' visibility='hidden'><b/></a>");
  EXPECT_EQ(computed.style.Get(SvgProperty::kFill), "red");
  EXPECT_EQ(computed.style.Share(SvgProperty::kOpacity), 1.0);
  EXPECT_TRUE(computed.style.IsDisplayed());
  EXPECT_FALSE(computed.style.IsVisible());
  EXPECT_EQ(FillOf("<a fill='red'><b fill='blue'><c fill='inherit'/></b></a>"), "blue");
  EXPECT_EQ(FillOf("<a fill='red'><b style='fill:initial'/></a>"), "black");
  EXPECT_EQ(FillOf("<a fill='red'><b style='fill:unset'/></a>"), "red");
  EXPECT_EQ(ComputedOf("<a opacity='0.5'><b opacity='inherit'/></a>").style.Share(SvgProperty::kOpacity), 0.5);
}

TEST(SvgStyle, InvalidValuesAreIgnoredAndReported) {
  const auto computed = ComputedOf("<a fill='red' style='fill:#12; stroke-width:wide; opacity:x'/>");
  EXPECT_EQ(computed.style.Get(SvgProperty::kFill), "red");
  EXPECT_EQ(computed.style.Get(SvgProperty::kStrokeWidth), "1");
  ASSERT_EQ(computed.problems.size(), 3U);
  EXPECT_EQ(computed.problems[0], "fill '#12' is not understood");
}

TEST(SvgStyle, SharesAreClampedAndTakePercentages) {
  EXPECT_EQ(ComputedOf("<a opacity='40%'/>").style.Share(SvgProperty::kOpacity), 0.4);
  EXPECT_EQ(ComputedOf("<a opacity='3'/>").style.Share(SvgProperty::kOpacity), 1.0);
  EXPECT_EQ(ComputedOf("<a opacity='-1'/>").style.Share(SvgProperty::kOpacity), 0.0);
}

TEST(SvgStyle, VariablesAndLightColorsAreReplaced) {
  EXPECT_EQ(FillOf("<a style='--ink: navy'><b style='fill: var(--ink)'/></a>"), "navy");
  EXPECT_EQ(FillOf("<a style='fill: var(--none, teal)'/>"), "teal");
  EXPECT_EQ(FillOf("<a style='fill: light-dark(rgb(1, 2, 3), var(--dark, #121212))'/>"), "rgb(1, 2, 3)");
  EXPECT_EQ(FillOf("<a fill='red' style='fill: var(--none)'/>"), "red");
  EXPECT_EQ(FillOf("<a fill='red' style='--a: var(--a) var(--a); fill: var(--a)'/>"), "red") << "it never ends";
}

TEST(SvgStyle, FontSizesAreRelativeToTheParents) {
  EXPECT_EQ(ComputedOf("<a/>").style.font_size(), 16.0);
  EXPECT_EQ(ComputedOf("<a font-size='20'><b style='font-size:1.5em'><c/></b></a>").style.font_size(), 30.0);
  EXPECT_EQ(ComputedOf("<a font-size='50%'/>").style.font_size(), 8.0);
}

TEST(SvgStyle, ShorthandsSetTheirProperties) {
  const auto computed = ComputedOf("<a style='marker: url(#m); background: #fff'/>");
  EXPECT_EQ(computed.style.Get(SvgProperty::kMarkerEnd), "url(#m)");
  EXPECT_EQ(computed.style.Get(SvgProperty::kBackgroundColor), "#fff");
  EXPECT_EQ(SvgReference(" url( '#m' ) none"), "m");
  EXPECT_EQ(SvgReference("url(other.svg#m)"), std::nullopt);
  EXPECT_EQ(SvgReference("none"), std::nullopt);
  EXPECT_EQ(SvgReference("url(#m"), "m");
}

}  // namespace
}  // namespace daumier::render
