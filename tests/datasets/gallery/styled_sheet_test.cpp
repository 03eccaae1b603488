#include "datasets/gallery/styled_sheet.h"

#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

TEST(StyledSheet, ShowsTheSameDrawingsWithPensAndWithLabels) {
  const testing::TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 2);
  testing::BuildSyntheticSketches(folder / "faces", folder / "sketches");
  const SketchDatabase sketches(folder / "sketches");
  EXPECT_EQ(DrawingsOfSheet(sketches, 5), DrawingsOfSheet(sketches, 5));
  const render::Image drawn = StyledSheet(sketches), labels = StyledLabelSheet(sketches);
  EXPECT_GT(drawn.width, 8 * 200);
  EXPECT_EQ(drawn.width, labels.width);
  const auto is_coloured = [](const render::Image& image) {
    for (size_t i = 0; i + 2 < image.pixels.size(); i += 3)
      if (std::abs(image.pixels[i] - image.pixels[i + 1]) > 60) return true;
    return false;
  };
  EXPECT_FALSE(is_coloured(drawn));
  EXPECT_TRUE(is_coloured(labels));
}

}  // namespace
}  // namespace daumier::datasets
