#pragma once
#include "rig/texture_space.h"

#include <cmath>
#include <functional>
#include <vector>

/// Surfaces whose atlas is known: for tests of textures.
namespace daumier::fitting {

/// A square sheet of n x n cells over x, y in -half .. half cm, z = height(x, y), seen from +z, whose atlas is the sheet
/// seen from the front with a border of a tenth. Its own mirror image in x if height is.
struct Sheet {
  rig::TextureSpace space;
  geometry::Points vertices;
  std::vector<int> mirror;
  double half;

  static Sheet Make(int n, double half, const std::function<double(double, double)>& height = {}) {
    Sheet sheet{{}, geometry::Points((n + 1) * (n + 1), 3), std::vector<int>(size_t((n + 1) * (n + 1))), half};
    sheet.space.uv.resize(sheet.vertices.rows(), 2);
    sheet.space.triangles.resize(2 * n * n, 3);
    const auto at = [&](int row, int column) { return row * (n + 1) + column; };
    for (int row = 0; row <= n; ++row) {
      for (int column = 0; column <= n; ++column) {
        const double x = half * (2.0 * column / n - 1), y = half * (2.0 * row / n - 1);
        sheet.vertices.row(at(row, column)) << x, y, height ? height(x, y) : 0;
        sheet.space.uv.row(at(row, column)) << sheet.UvOf(x), sheet.UvOf(y);
        sheet.mirror[size_t(at(row, column))] = at(row, n - column);
      }
    }
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        const int t = 2 * (row * n + column);
        sheet.space.triangles.row(t) << at(row, column), at(row, column + 1), at(row + 1, column + 1);
        sheet.space.triangles.row(t + 1) << at(row, column), at(row + 1, column + 1), at(row + 1, column);
      }
    }
    sheet.space.uv_triangles = sheet.space.triangles;
    sheet.space.charts.assign(size_t(2 * n * n), rig::TextureChart::kSkin);
    return sheet;
  }

  double UvOf(double x) const { return 0.5 + 0.4 * x / half; }
  /// The texel at a place of the sheet.
  int TexelAt(const rig::TexelMap& texels, double x, double y) const {
    return texels.index(int((1 - UvOf(y)) * texels.size), int(UvOf(x) * texels.size));
  }
};

}  // namespace daumier::fitting
