#include "rig/head_charts.h"

#include "faces/eyeball.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

void ExpectCounterClockwise(const ChartPiece& piece) {
  for (const auto& t : piece.uv_triangles.rowwise()) {
    const Eigen::RowVector2d a = piece.uv.row(t[0]), b = piece.uv.row(t[1]) - a, c = piece.uv.row(t[2]) - a;
    EXPECT_GT(b.x() * c.y() - b.y() * c.x(), 0);
  }
}

TEST(ClosureChart, IsADiscWithItsApexInTheMiddle) {
  const faces::HoleClosure closure{{4, 2, 7, 1, 9}, 20, 2};
  const ChartPiece piece = ClosureChart(closure, TextureChart::kMouth, 0.3);
  EXPECT_EQ(piece.chart, TextureChart::kMouth);
  EXPECT_EQ(piece.size, 0.3);
  ASSERT_EQ(piece.triangles.rows(), 25);
  ExpectCounterClockwise(piece);
  EXPECT_EQ(NumOverlappingTexels(AssembleCharts({piece}), 256), 0);
  for (Eigen::Index i = 0; i < piece.triangles.size(); ++i) {
    const int vertex = piece.triangles.data()[i];
    const double radius = (piece.uv.row(piece.uv_triangles.data()[i]) - Eigen::RowVector2d::Constant(0.5)).norm() / 0.5;
    const double expected = vertex < 20 ? 1 : vertex == closure.apex() ? 0 : vertex < 25 ? 2.0 / 3 : 1.0 / 3;
    EXPECT_NEAR(radius, expected, 1e-9) << vertex;
  }
}

TEST(EyeChart, IsADiscWithTheIrisInTheMiddle) {
  const ChartPiece piece = EyeChart(TextureChart::kLeftEye, 100);
  EXPECT_EQ(piece.triangles.minCoeff(), 100);
  EXPECT_EQ(piece.triangles.maxCoeff(), 99 + faces::NumEyeballVertices());
  ExpectCounterClockwise(piece);
  EXPECT_EQ(NumOverlappingTexels(AssembleCharts({piece}), 512), 0);
  const auto& materials = faces::EyeballTopology().materials;
  for (Eigen::Index t = 0; t < piece.triangles.rows(); ++t)
    for (const int row : piece.uv_triangles.row(t)) {
      const double radius = (piece.uv.row(row) - Eigen::RowVector2d::Constant(0.5)).norm();
      const bool is_white = materials[size_t(t)] == faces::HeadMaterial::kSclera;
      EXPECT_LT(radius, is_white ? 0.5 + 1e-9 : 0.25);
    }
}

TEST(SkinChart, IsOnePieceOfAllTriangles) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const ChartPiece piece = SkinChart({face.neutral, face.triangles}, face.annotation);
  EXPECT_EQ(piece.triangles, face.triangles);
  EXPECT_EQ(piece.size, 1);
  EXPECT_EQ(NumOverlappingTexels(AssembleCharts({piece}), 512), 0);
}

TEST(AssembleCharts, KeepsPiecesApartAndInTheirOrder) {
  const std::vector<ChartPiece> pieces = {EyeChart(TextureChart::kRightEye, 0),
                                          ClosureChart({{0, 1, 2, 3}, 4, 1}, TextureChart::kMouth, 0.1),
                                          EyeChart(TextureChart::kLeftEye, 500)};
  const TextureSpace space = AssembleCharts(pieces);
  const Eigen::Index of_eye = pieces[0].triangles.rows(), of_mouth = pieces[1].triangles.rows();
  ASSERT_EQ(space.triangles.rows(), 2 * of_eye + of_mouth);
  EXPECT_EQ(space.triangles.middleRows(of_eye, of_mouth), pieces[1].triangles);
  EXPECT_EQ(space.charts[0], TextureChart::kRightEye);
  EXPECT_EQ(space.charts[size_t(of_eye)], TextureChart::kMouth);
  EXPECT_EQ(space.charts.back(), TextureChart::kLeftEye);
  EXPECT_GE(space.uv.minCoeff(), 0);
  EXPECT_LE(space.uv.maxCoeff(), 1);
  EXPECT_EQ(NumOverlappingTexels(space, 512), 0);
  // Texels of different charts are not nearer to each other than the gutter.
  constexpr int kSize = 256;
  const TexelMap texels = space.Rasterise(kSize);
  const auto chart_at = [&](int row, int column) {
    const int triangle = texels.triangles[size_t(texels.index(row, column))];
    return triangle < 0 ? -1 : int(space.charts[size_t(triangle)]);
  };
  for (int row = 0; row < kSize; ++row)
    for (int column = 0; column + 1 < kSize; ++column)
      for (int next = column + 1; next < std::min(kSize, column + int(kGutter * kSize)); ++next) {
        const int a = chart_at(row, column), b = chart_at(row, next);
        EXPECT_TRUE(a < 0 || b < 0 || a == b);
      }
}

}  // namespace
}  // namespace daumier::rig
