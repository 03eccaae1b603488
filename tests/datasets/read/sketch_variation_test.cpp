#include "datasets/read/sketch_variation.h"

#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::datasets {
namespace {

class SketchVariationTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 1);
    SketchesOptions options;
    options.faces = (*folder_ / "faces").string();
    options.num_views = 3;
    BuildSketches(options, *folder_ / "sketches");
    sketches_ = new SketchDatabase(*folder_ / "sketches");
  }
  static void TearDownTestSuite() {
    delete sketches_;
    delete folder_;
  }

  static bool Equal(const std::vector<render::Stroke>& a, const std::vector<render::Stroke>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return x.points == y.points; });
  }
  static AugmentedSketch Styled(double share, int face, uint64_t seed, int64_t epoch, double strength = 0) {
    SketchVariation variation;
    variation.augmentation.strength = strength;
    variation.styled.share = share;
    return VariedSketch(*sketches_, face, variation, seed, epoch);
  }

  static inline testing::TempDir* folder_ = nullptr;
  static inline SketchDatabase* sketches_ = nullptr;
};

TEST_F(SketchVariationTest, ByDefaultTheSketchIsTheDatabasesInEachEpoch) {
  const SketchVariation none;
  EXPECT_FALSE(none.varies(*sketches_));
  for (const int64_t epoch : {0, 5})
    EXPECT_TRUE(Equal(VariedSketch(*sketches_, 2, none, 1, epoch).strokes, sketches_->strokes(2)));
}

TEST_F(SketchVariationTest, AllViewsComeInTurn) {
  SketchVariation variation;
  variation.all_views = true;
  EXPECT_TRUE(variation.varies(*sketches_));
  std::set<int> seen;
  for (int64_t epoch = 0; epoch < 30; ++epoch) {
    const auto strokes = VariedSketch(*sketches_, 1, variation, 4, epoch).strokes;
    for (int view = 0; view < 3; ++view) {
      if (Equal(strokes, sketches_->strokes(1, view))) seen.insert(view);
    }
  }
  EXPECT_EQ(seen.size(), 3u);
}

TEST_F(SketchVariationTest, WrinklesAreLeftOutOfWhatIsDrawnAlone) {
  SketchVariation variation;
  variation.wrinkles = false;
  const AugmentedSketch sketch = VariedSketch(*sketches_, 3, variation, 1, 0);
  for (const auto& stroke : sketch.strokes) EXPECT_FALSE(IsWrinkleKind(sketches_->kinds()[size_t(stroke.kind)]));
  EXPECT_TRUE(Equal(sketch.moved, sketches_->strokes(3))) << "curves keep their numbers";
  EXPECT_LT(sketch.strokes.size(), sketch.moved.size()) << "the lips at least are left out";
}

TEST_F(SketchVariationTest, AugmentationIsAFunctionOfSeedFaceAndEpoch) {
  SketchVariation variation;
  variation.augmentation.strength = 1;
  const auto at = [&](int face, uint64_t seed, int64_t epoch) {
    return VariedSketch(*sketches_, face, variation, seed, epoch).strokes;
  };
  EXPECT_TRUE(Equal(at(1, 7, 2), at(1, 7, 2)));
  EXPECT_FALSE(Equal(at(1, 7, 2), at(1, 8, 2)));
  EXPECT_FALSE(Equal(at(1, 7, 2), at(1, 7, 3)));
}

TEST_F(SketchVariationTest, AStyledSketchHasOtherLinesWhichAreAFunctionOfSeedFaceAndEpoch) {
  SketchVariation variation;
  variation.styled.share = 1;
  EXPECT_TRUE(variation.varies(*sketches_));
  const AugmentedSketch sketch = Styled(1, 1, 7, 2);
  EXPECT_FALSE(sketch.strokes.empty());
  EXPECT_FALSE(Equal(sketch.strokes, sketches_->strokes(1)));
  EXPECT_TRUE(Equal(sketch.moved, sketches_->strokes(1))) << "the strokes alone are styled";
  EXPECT_TRUE(Equal(sketch.strokes, Styled(1, 1, 7, 2).strokes));
  EXPECT_FALSE(Equal(sketch.strokes, Styled(1, 1, 8, 2).strokes));
  EXPECT_FALSE(Equal(sketch.strokes, Styled(1, 1, 7, 3).strokes));
}

TEST_F(SketchVariationTest, TheShareOfSketchesIsStyledAndTheOthersAreAsWithoutStyles) {
  int num_styled = 0;
  for (int64_t epoch = 0; epoch < 60; ++epoch) {
    const auto plain = Styled(0, 2, 5, epoch, 1).strokes, mixed = Styled(0.5, 2, 5, epoch, 1).strokes;
    if (Equal(mixed, plain)) continue;
    ++num_styled;
    EXPECT_TRUE(Equal(mixed, Styled(1, 2, 5, epoch, 1).strokes)) << epoch;
  }
  EXPECT_NEAR(num_styled, 30, 12);
}

}  // namespace
}  // namespace daumier::datasets
