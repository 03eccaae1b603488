#include "render/styles/style_choice.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <map>

namespace daumier::render {
namespace {

TEST(DrawStyleChoice, DrawsStylesByTheirShares) {
  StyleOptions options = ParseOptions<StyleOptions>({{"smooth", 0.5},
                                                     {"toon", 0.25},
                                                     {"flat", 0},
                                                     {"ink", 0},
                                                     {"painterly", 0},
                                                     {"pencil", 0.25},
                                                     {"watercolour", 0},
                                                     {"halftone", 0},
                                                     {"clay", 0},
                                                     {"grey", 0.1}});
  std::map<std::string, int> counts;
  int num_grey = 0;
  Rng rng(1);
  for (int i = 0; i < 4000; ++i) {
    const StyleChoice choice = DrawStyleChoice(rng, options);
    ++counts[std::string(NameOf(choice.style))];
    num_grey += StyleName(choice) == std::string(NameOf(choice.style)) + "_grey" ? 1 : 0;
  }
  EXPECT_EQ(counts.size(), 3u);
  EXPECT_NEAR(counts["smooth"], 2000, 130);
  EXPECT_NEAR(counts["toon"], 1000, 130);
  EXPECT_NEAR(num_grey, 400, 80);
}

TEST(DrawStyleChoice, LinesAreDrawnByTheirShare) {
  for (const double share : {0.0, 1.0}) {
    StyleOptions options{.smooth = 0,
                         .flat = 0,
                         .ink = 0,
                         .painterly = 0,
                         .pencil = 0,
                         .watercolour = 0,
                         .halftone = 0,
                         .clay = 0,
                         .lines = share,
                         .strokes = 1};
    Rng rng(1);
    for (int i = 0; i < 50; ++i) EXPECT_EQ(UsesStrokes(DrawStyleChoice(rng, options)), share == 1);
  }
}

TEST(DrawStyleChoice, RefusesSharesThatAreAll0) {
  const StyleOptions options{.smooth = 0,
                             .toon = 0,
                             .flat = 0,
                             .ink = 0,
                             .painterly = 0,
                             .pencil = 0,
                             .watercolour = 0,
                             .halftone = 0,
                             .clay = 0};
  Rng rng(1);
  daumier::testing::ExpectError([&] { DrawStyleChoice(rng, options); }, "all shares of styles are 0");
}

}  // namespace
}  // namespace daumier::render
