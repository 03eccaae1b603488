#include "render/svg_css.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

/// The value of `fill` that the rules of a sheet give the element with the id "it"; empty if none matches.
std::string FillBy(const std::string& css, const std::string& markup) {
  pugi::xml_document document;
  document.load_string(markup.c_str());
  CssStyleSheet sheet;
  sheet.Add(css);
  std::string fill;
  const auto element = document.find_node(
      [](const pugi::xml_node& node) { return std::string_view(node.attribute("id").value()) == "it"; });
  for (const auto* declaration : sheet.Match(element))
    if (declaration->name == "fill") fill = declaration->value;
  return fill;
}

const std::string kMarkup =
    "<svg><g class='layer ink' id='outer'><g><title/><path class='thin  st0' id='it' data-kind='eye left'/></g></g>"
    "</svg>";

TEST(SvgCss, SelectorsMatch) {
  for (const std::string selector : {"*",
                                     "path",
                                     "svg|path",
                                     ".st0",
                                     ".thin.st0",
                                     "#it",
                                     "path.st0#it",
                                     "g path",
                                     "svg>g>g>path",
                                     "svg > g path",
                                     ".layer .st0",
                                     "g.ink #it",
                                     "title + path",
                                     "[data-kind]",
                                     "[data-kind~=left]",
                                     "[data-kind^='eye']",
                                     "[data-kind $= \"left\"]",
                                     "[data-kind*='e l']",
                                     "path[id=it]",
                                     ":root path",
                                     "rect, .none , .st0",
                                     "\\.x, .s\\74 0",
                                     "g>g *"}) {
    EXPECT_EQ(FillBy(selector + "{fill:red}", kMarkup), "red") << selector;
  }
  for (const std::string selector :
       {"rect", ".St0", ".st", "#outer", "svg > path", "path g", "path + path", ".layer > .st0", "[data-none]",
        "[data-kind=eye]", ":root", "path:hover", "path::before", "g + path"}) {
    EXPECT_EQ(FillBy(selector + "{fill:red}", kMarkup), "") << selector;
  }
}

TEST(SvgCss, DescendantsAreFoundBehindAnyMatch) {
  // The nearest .a is no child of .b; a farther one is.
  EXPECT_EQ(FillBy(".b > .a path{fill:red}",
                   "<svg class='b'><g class='a'><g class='c'><g class='a'><path id='it'/></g></g></g></svg>"),
            "red");
}

TEST(SvgCss, SpecificityThenOrderDecide) {
  EXPECT_EQ(FillBy(".st0{fill:red} path{fill:blue}", kMarkup), "red");
  EXPECT_EQ(FillBy("#it{fill:red} g .thin.st0{fill:blue}", kMarkup), "red");
  EXPECT_EQ(FillBy(".st0{fill:red} .thin{fill:blue}", kMarkup), "blue");
  EXPECT_EQ(FillBy("g path{fill:red} path{fill:blue}", kMarkup), "red");
  EXPECT_EQ(FillBy("path,#it{fill:red} .st0{fill:blue}", kMarkup), "red");
}

TEST(SvgCss, CommentsAtRulesAndMarksAreSkipped) {
  EXPECT_EQ(FillBy("<!-- @charset 'x'; /* } */ @font-face{src:url('a{};b')} @media print{path{fill:blue}}"
                   "@media (prefers-color-scheme:dark){path{fill:blue}} @keyframes k{from{fill:blue}}"
                   "@media screen{path{fill:red}} -->",
                   kMarkup),
            "red");
  EXPECT_EQ(FillBy("path{fill:red", kMarkup), "red");
}

TEST(SvgCss, NamesWhatIsNotUnderstood) {
  CssStyleSheet sheet;
  sheet.Add("@import url(a.css); path:nth-child(2){fill:red} g ~ path{fill:red} .a{} .b,{fill:red} nonsense");
  ASSERT_EQ(sheet.ignored().size(), 4U);
  EXPECT_EQ(sheet.ignored()[0], "@import url(a.css)");
  EXPECT_EQ(sheet.ignored()[1], "path:nth-child(2)");
  EXPECT_EQ(sheet.ignored()[3], "nonsense");
}

TEST(SvgCss, DeclarationsAreSplitOutsideQuotesAndParentheses) {
  const auto declarations = ParseCssDeclarations(
      "FILL : Red ! important; /* a;b */ background:url(data:x;base64,a); ;nothing; --Name: 'a;b'");
  ASSERT_EQ(declarations.size(), 3U);
  EXPECT_EQ(declarations[0].name, "fill");
  EXPECT_EQ(declarations[0].value, "Red");
  EXPECT_TRUE(declarations[0].important);
  EXPECT_EQ(declarations[1].value, "url(data:x;base64,a)");
  EXPECT_FALSE(declarations[1].important);
  EXPECT_EQ(declarations[2].name, "--Name");
}

TEST(SvgCss, SurvivesAnyPrefixOfASheet) {
  const std::string css = "@media screen{a>b,#c[d='e'].f\\66 :root{fill:url('x');stroke:red!important}}/* x */}{";
  for (size_t size = 0; size <= css.size(); ++size) CssStyleSheet().Add(css.substr(0, size));
  CssStyleSheet().Add(std::string(100000, '{') + std::string(100000, '}') + std::string(100000, '('));
}

}  // namespace
}  // namespace daumier::render
