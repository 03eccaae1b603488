#include "render/svg_document.h"

#include "tests/render/gzipped.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExpectError;

TEST(SvgDocument, NamesAreThoseOfSvgsNamespace) {
  const SvgDocument document("a.svg",
                             "<s:svg xmlns:s='http://www.w3.org/2000/svg' xmlns:i='http://i' xmlns='http://h'>"
                             "<s:g/><i:g/><g/><g xmlns='http://www.w3.org/2000/svg'/></s:svg>");
  std::vector<std::string_view> names;
  for (const auto& child : document.root().children()) names.push_back(document.SvgName(child));
  EXPECT_EQ(names, (std::vector<std::string_view>{"g", "", "", "g"}));
  const SvgDocument plain("b.svg", "<svg><g/><x:g/></svg>");
  EXPECT_EQ(plain.SvgName(plain.root().first_child()), "g");
  EXPECT_EQ(plain.SvgName(plain.root().last_child()), "");
}

TEST(SvgDocument, FindsElementsByIdAndReference) {
  const SvgDocument document(
      "a.svg", "<svg><g id='a'/><path id='a'/><use href='#a'/><use x:href=' #a'/><use href='b.svg#a'/></svg>");
  auto node = document.root().first_child();
  EXPECT_EQ(document.ById("a"), node) << "the first counts";
  EXPECT_FALSE(document.ById("b"));
  node = node.next_sibling().next_sibling();
  EXPECT_EQ(document.Referenced(node), document.ById("a"));
  EXPECT_EQ(document.Referenced(node.next_sibling()), document.ById("a"));
  EXPECT_FALSE(document.Referenced(document.root().last_child()));
  EXPECT_EQ(document.Where(node), "a.svg:1: <use>");
}

TEST(SvgDocument, CollectsStyleSheets) {
  const SvgDocument document("a.svg",
                             "<svg><style>a{x:1}</style><g><style type='text/css'><![CDATA[a{y:2}]]></style></g>"
                             "<style media='print'>a{z:3}</style><style type='text/x'>a{z:3}</style><a/></svg>");
  const auto declarations = document.sheet().Match(document.root().last_child());
  ASSERT_EQ(declarations.size(), 2U);
  EXPECT_EQ(declarations[1]->value, "2");
}

TEST(SvgDocument, EntitiesAreReplaced) {
  const SvgDocument document("a.svg",
                             "<!DOCTYPE svg [ <!ENTITY ns 'http://www.w3.org/2000/svg'>\n<!ENTITY a \"fill:none\">"
                             "<!ENTITY b '&a;;x:1'> ]><svg xmlns='&ns;'><g style='&b;' id='&lt;&unknown;'/></svg>");
  EXPECT_EQ(document.SvgName(document.root().first_child()), "g");
  EXPECT_STREQ(document.root().first_child().attribute("style").value(), "fill:none;x:1");
}

TEST(SvgDocument, RefusesEntitiesThatMultiply) {
  std::string text = "<!DOCTYPE svg [<!ENTITY e0 '" + std::string(1000, 'x') + "'>";
  for (int i = 1; i < 7; ++i) {
    text += fmt::format("<!ENTITY e{} '", i);
    for (int k = 0; k < 30; ++k) text += fmt::format("&e{};", i - 1);
    text += "'>";
  }
  ExpectError([&] { SvgDocument("a.svg", text + "]><svg>&e6;</svg>"); },
              "a.svg: its entities expand to more than 64 MB");
  ExpectError([&] { SvgDocument("a.svg", "<!DOCTYPE svg [<!ENTITY a '&a;'>]><svg>&a;</svg>"); }, "nested more than 8");
}

TEST(SvgDocument, IsUnpackedWhateverItsName) {
  EXPECT_TRUE(SvgDocument("a.svg", testing::Gzipped("<svg id='a'/>")).ById("a"));
  ExpectError([] { SvgDocument("a.svg", testing::Gzipped("<svg/>").substr(0, 12)); }, "a.svg: the gzip data");
}

TEST(SvgDocument, RefusesWhatIsNoSvg) {
  ExpectError([] { SvgDocument("a.svg", "<html/>"); }, "a.svg: the outermost element is <html>");
  ExpectError([] { SvgDocument("a.svg", "<svg>\n<g></svg>"); }, "a.svg:2: not XML, or truncated");
  std::string nested = "<svg>";
  for (int i = 0; i < 300; ++i) nested += "<g>";
  for (int i = 0; i < 300; ++i) nested += "</g>";
  ExpectError([&] { SvgDocument("a.svg", nested + "</svg>"); }, "nested more than 200 deep");
}

}  // namespace
}  // namespace daumier::render
