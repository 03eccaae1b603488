#include "render/area_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::render {
namespace {

std::vector<Eigen::Vector2d> BoxOutline(double left, double top, double right, double bottom) {
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

TEST(AreaPieces, EachConnectedPieceHasItsShapeAndOutlines) {
  const PaintedArea area{.shape = {{BoxOutline(0, 0, 100, 5), BoxOutline(0, 20, 30, 50)}, FillRule::kNonzero},
                         .paint = Paint::kInk,
                         .kind = 0,
                         .drawn_lines = {}};
  const auto pieces = FindAreaPieces({&area}, 15.0);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].shape, PieceShape::kLine);
  EXPECT_NEAR(pieces[0].pen_width, 5.0, 0.6);
  EXPECT_NEAR(pieces[0].length, 100.0, 8.0);
  EXPECT_EQ(pieces[1].shape, PieceShape::kCompact);
  for (const AreaPiece& piece : pieces) {
    EXPECT_EQ(piece.outlines.size(), 1U);
    EXPECT_EQ(piece.areas, std::vector{&area});
  }
}

TEST(AreaPieces, ThereIsNoneWithoutAnInside) {
  const PaintedArea line{
      .shape = {{{{0, 0}, {50, 0}}}, FillRule::kNonzero}, .paint = Paint::kInk, .kind = 0, .drawn_lines = {}};
  EXPECT_TRUE(FindAreaPieces({&line}, 15.0).empty());
  EXPECT_EQ(NumPixelsFor(line.shape), 0.0);
}

}  // namespace
}  // namespace daumier::render
