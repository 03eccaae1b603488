#include "datasets/gestures/glyph_strokes.h"

#include "datasets/gestures/stroke_form.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

TEST(Glyphs, AreNamedAndNoneIsALine) {
  std::set<std::string> names;
  for (const Glyph& glyph : Glyphs()) {
    names.insert(glyph.name);
    ASSERT_GE(glyph.points.size(), 3u) << glyph.name;
    EXPECT_FALSE(FormOf(glyph.points).is_nearly_straight()) << glyph.name;
  }
  EXPECT_EQ(names.size(), Glyphs().size());
  EXPECT_GE(names.size(), 50u);
}

TEST(DrawGlyph, WritesTheSameEachTimeAndDifferentOnes) {
  Rng one(4), again(4);
  const Polyline first = DrawGlyph(one);
  EXPECT_EQ(first, DrawGlyph(again));
  EXPECT_NE(first, DrawGlyph(one));
}

}  // namespace
}  // namespace daumier::datasets
