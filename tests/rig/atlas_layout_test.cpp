#include "rig/atlas_layout.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

AtlasPiece Box(double width, double height, double size) {
  AtlasPiece piece{geometry::TextureCoordinates(3, 2), size};
  piece.uv << 5, -3, 5 + width, -3, 5, -3 + height;
  return piece;
}

TEST(LayOut, KeepsShapesSizesAndGutters) {
  constexpr double kGutter = 0.02;
  const std::vector<AtlasPiece> pieces = {Box(2, 2, 1), Box(1, 3, 0.5), Box(4, 1, 0.5), Box(1, 1, 0.2), Box(1, 1, 0.2)};
  const auto placed = LayOut(pieces, kGutter);
  ASSERT_EQ(placed.size(), pieces.size());
  const auto extent = [&](size_t i) {
    return (placed[i].colwise().maxCoeff() - placed[i].colwise().minCoeff()).eval();
  };
  const double factor = extent(0).x();
  EXPECT_GT(factor, 0.5);
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Eigen::RowVector2d before = pieces[i].uv.colwise().maxCoeff() - pieces[i].uv.colwise().minCoeff();
    EXPECT_NEAR(extent(i).maxCoeff(), factor * pieces[i].size, 1e-9);
    EXPECT_NEAR(extent(i).x() / extent(i).y(), before.x() / before.y(), 1e-9) << "not turned";
    EXPECT_GE(placed[i].minCoeff(), kGutter / 2 - 1e-12);
    EXPECT_LE(placed[i].maxCoeff(), 1 - kGutter / 2 + 1e-12);
    for (size_t j = 0; j < i; ++j) {
      const Eigen::Array2d gap = (placed[i].colwise().minCoeff() - placed[j].colwise().maxCoeff())
                                     .cwiseMax(placed[j].colwise().minCoeff() - placed[i].colwise().maxCoeff());
      EXPECT_GE(gap.maxCoeff(), kGutter - 1e-12) << i << " " << j;
    }
  }
}

TEST(LayOut, FillsTheAtlasWithOnePiece) {
  EXPECT_NEAR(LayOut({Box(1, 1, 3)}, 0.1).front().maxCoeff(), 0.95, 2e-3);
}

TEST(LayOut, RefusesPiecesWithoutExtentAndWideGutters) {
  testing::ExpectError([] { LayOut({Box(1, 0, 1)}, 0.01); }, "no extent");
  testing::ExpectError([] { LayOut({Box(1, 1, 1), Box(1, 1, 1)}, 0.8); }, "fill the atlas");
}

}  // namespace
}  // namespace daumier::rig
