#include "fitting/texture_fill.h"

#include "geometry/topology.h"
#include "tests/fitting/small_atlas.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::fitting {
namespace {

constexpr int kFilledSize = 128;

/// Colours that are a function of the place on the sheet, known where `known` says so.
TexelColours ColoursOf(const Sheet& sheet, const rig::TexelMap& texels,
                       const std::function<Eigen::Vector3f(double, double)>& colour,
                       const std::function<bool(double, double)>& known) {
  TexelColours colours{std::vector<Eigen::Vector3f>(size_t(texels.num_texels()), Eigen::Vector3f::Zero()),
                       std::vector<float>(size_t(texels.num_texels()), 0.0F)};
  for (size_t i = 0; i < colours.weights.size(); ++i) {
    if (texels.triangles[i] < 0) continue;
    geometry::Vector3 point = geometry::Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      point +=
          double(texels.weights[i][k]) * sheet.vertices.row(sheet.space.triangles(texels.triangles[i], k)).transpose();
    if (!known(point.x(), point.y())) continue;
    colours.weights[i] = 1;
    colours.colours[i] = colour(point.x(), point.y());
  }
  return colours;
}

TEST(MeansAtVertices, AreThoseOfTheTexelsAroundThem) {
  const Sheet sheet = Sheet::Make(8, 4);
  const rig::TexelMap texels = sheet.space.Rasterise(kFilledSize);
  const TexelColours colours = ColoursOf(
      sheet, texels, [](double x, double y) { return Eigen::Vector3f(float(x), float(y), 1); },
      [](double x, double) { return x < 0; });
  const VertexValues means =
      MeansAtVertices(sheet.space.triangles, int(sheet.vertices.rows()), texels.triangles, texels.weights, colours);
  for (Eigen::Index v = 0; v < sheet.vertices.rows(); ++v) {
    const double x = sheet.vertices(v, 0), y = sheet.vertices(v, 1);
    if (x >= 0.5) {
      EXPECT_EQ(means.weights[v], 0) << x;
    }
    if (x >= 0 || std::abs(x) > 3.9 || std::abs(y) > 3.9) continue;
    EXPECT_NEAR(means.values(v, 0), x, x < -0.5 ? 0.05 : 0.5);
    EXPECT_NEAR(means.values(v, 1), y, 0.05);
    EXPECT_NEAR(means.values(v, 2), 1, 1e-5);
  }
}

TEST(FillSurface, GivesAnUnknownVertexTheMeanOfItsNeighbours) {
  const Sheet sheet = Sheet::Make(10, 5);
  const Eigen::Index n = sheet.vertices.rows();
  VertexValues known{Eigen::MatrixXf::Zero(n, 1), Eigen::VectorXf::Zero(n)};
  for (Eigen::Index v = 0; v < n; ++v) {
    if (std::abs(sheet.vertices(v, 0)) < 4.9) continue;
    known.weights[v] = 1e5F, known.values(v, 0) = sheet.vertices(v, 0) > 0 ? 1.0F : 0.0F;
  }
  const Eigen::MatrixXf filled =
      FillSurface(sheet.space.triangles, known, Eigen::MatrixXf::Zero(n, 1), {.stiffness = 1, .rest_weight = 1e-7});
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(sheet.space.triangles, int(n));
  for (int v = 0; v < n; ++v) {
    if (known.weights[v] > 0) {
      EXPECT_NEAR(filled(v, 0), known.values(v, 0), 1e-3);
      continue;
    }
    double mean = 0;
    for (const int other : neighbours[v]) mean += double(filled(other, 0)) / double(neighbours[v].size());
    EXPECT_NEAR(filled(v, 0), mean, 1e-5);
  }
}

TEST(SurfaceFill, AgreesWithTheEquationsOfItsMinimum) {
  const Sheet sheet = Sheet::Make(5, 5);
  const int n = int(sheet.vertices.rows());
  VertexValues known{Eigen::MatrixXf(n, 2), Eigen::VectorXf(n)};
  Eigen::MatrixXf rest(n, 2);
  for (int v = 0; v < n; ++v) {
    known.weights[v] = float(v % 3);
    known.values.row(v) << float(v % 5), float(v % 7);
    rest.row(v) << float(v % 2), 1;
  }
  const SurfaceFillOptions options = {.stiffness = 2, .rest_weight = 0.1};
  const Eigen::MatrixXf x = SurfaceFill(sheet.space.triangles, n).Solve(known, rest, options);
  // (W + stiffness L + rest_weight) x = W value + rest_weight rest, without an order and without sparseness.
  Eigen::MatrixXd system = 2 * Eigen::MatrixXd(geometry::UniformLaplacian(sheet.space.triangles, n));
  system.diagonal() += known.weights.cast<double>();
  system.diagonal().array() += 0.1;
  const Eigen::MatrixXd right =
      known.weights.cast<double>().asDiagonal() * known.values.cast<double>() + 0.1 * rest.cast<double>();
  EXPECT_TRUE((system * x.cast<double>()).isApprox(right, 1e-5));
}

TEST(FillSurface, IsAtRestWhereNothingIsKnown) {
  const Sheet sheet = Sheet::Make(4, 5);
  const Eigen::Index n = sheet.vertices.rows();
  const Eigen::MatrixXf rest = Eigen::RowVector2f(0.3F, 0.7F).replicate(n, 1);
  const VertexValues none{Eigen::MatrixXf::Zero(n, 2), Eigen::VectorXf::Zero(n)};
  EXPECT_TRUE(FillSurface(sheet.space.triangles, none, rest).isApprox(rest, 1e-4F));
  testing::ExpectError([&] { FillSurface(sheet.space.triangles, none, rest, {.rest_weight = 0}); }, "rest_weight 0");
  testing::ExpectError([&] { FillSurface(sheet.space.triangles, none, rest.topRows(3)); }, "a rest of 3 x 2");
}

TEST(MirrorTexels, ShowsTheOtherSide) {
  const Sheet sheet = Sheet::Make(6, 3);
  const rig::TexelMap texels = sheet.space.Rasterise(kFilledSize);
  const MirroredCorners mirrored = FindMirroredCorners(sheet.space, sheet.mirror);
  const TexelColours colours = ColoursOf(
      sheet, texels, [](double x, double y) { return Eigen::Vector3f(float(x), float(y), 0); },
      [](double x, double) { return x < -0.2; });
  const TexelColours images = MirrorTexels(texels, mirrored, colours);
  const auto right = size_t(sheet.TexelAt(texels, 1.5, 0.7)), left = size_t(sheet.TexelAt(texels, -1.5, 0.7));
  EXPECT_NEAR(images.weights[right], 1, 1e-5);
  EXPECT_NEAR(images.colours[right].x(), -1.5, 0.05);
  EXPECT_NEAR(images.colours[right].y(), 0.7, 0.05);
  EXPECT_EQ(images.weights[left], 0) << "the right side is unknown";
}

TEST(MirrorTexels, TwiceShowsTheSameSide) {
  const Sheet sheet = Sheet::Make(6, 3);
  const rig::TexelMap texels = sheet.space.Rasterise(kFilledSize);
  const MirroredCorners mirrored = FindMirroredCorners(sheet.space, sheet.mirror);
  const TexelColours colours = ColoursOf(
      sheet, texels, [](double x, double y) { return Eigen::Vector3f(float(x), float(y), 0); },
      [](double, double) { return true; });
  const TexelColours twice = MirrorTexels(texels, mirrored, MirrorTexels(texels, mirrored, colours));
  for (size_t i = 0; i < colours.weights.size(); ++i)
    if (twice.weights[i] > 0.99F) {
      EXPECT_NEAR((twice.colours[i] - colours.colours[i]).norm(), 0, 0.06);
    }
}

TEST(FindMirroredCorners, OfVerticesWithoutAnImageAreNowhere) {
  const Sheet sheet = Sheet::Make(2, 3);
  std::vector<int> mirror = sheet.mirror;
  mirror[0] = -1;
  const MirroredCorners mirrored = FindMirroredCorners(sheet.space, mirror);
  EXPECT_FALSE(mirrored.uv[0][0].allFinite());
  EXPECT_TRUE(mirrored.uv[3][0].allFinite());
  testing::ExpectError([&] { FindMirroredCorners(sheet.space, {0, 1}); }, "2 vertices");
}

TEST(FindMirroredCorners, OnASeamAreThoseOfOneTriangle) {
  // The image of the last vertex of triangle 0 has a second place in the atlas, far from its neighbours.
  Sheet sheet = Sheet::Make(2, 3);
  const int seam = sheet.mirror[size_t(sheet.space.triangles(0, 2))];
  sheet.space.uv.conservativeResize(sheet.space.uv.rows() + 1, 2);
  sheet.space.uv.bottomRows(1) << 0.01, 0.99;
  bool is_moved = false;
  for (Eigen::Index t = sheet.space.triangles.rows(); t-- > 0 && !is_moved;)
    for (int k = 0; k < 3; ++k)
      if (sheet.space.triangles(t, k) == seam)
        sheet.space.uv_triangles(t, k) = int(sheet.space.uv.rows()) - 1, is_moved = true;
  const MirroredCorners mirrored = FindMirroredCorners(sheet.space, sheet.mirror);
  EXPECT_TRUE(mirrored.uv[0][2].isApprox(sheet.space.uv.row(seam).transpose().cast<float>()));
}

}  // namespace
}  // namespace daumier::fitting
