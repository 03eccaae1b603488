#include "datasets/styles/style_options.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(StyleOptions, SurviveARoundTrip) {
  StyleOptions options;
  options.features.mouth.teeth = 0.9;
  options.doodle_features.eyes.dot = 7;
  options.hand.width = 3;
  EXPECT_EQ(ToJson(ParseOptions<StyleOptions>(ToJson(options))), ToJson(options));
}

TEST(StyleOptions, DoodlesHaveStylesOfTheirOwn) {
  const Json options = ToJson(StyleOptions());
  EXPECT_NE(options.at("features"), options.at("doodle_features"));
  EXPECT_GT(StyleOptions().doodle_features.eyes.dot, StyleOptions().features.eyes.dot);
}

TEST(StyleOptions, AWrongShareIsRefusedWithItsName) {
  testing::ExpectError(
      [] {
        ParseOptions<StyleOptions>({{"features", {{"hair", {{"solid", 2}}}}}});
      },
      "features.hair.solid");
}

}  // namespace
}  // namespace daumier::datasets
