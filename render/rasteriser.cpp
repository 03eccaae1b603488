#include "render/rasteriser.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace daumier::render {
namespace {

constexpr double kSubpixels = 1024.0;
constexpr double kNearDepth = 1e-3;
constexpr double kFarthestPixel = 1 << 30;

/// A projected vertex on the subpixel grid.
struct Corner {
  double x, y, depth;
};

/// e(x, y) = (to - from) x ((x, y) - from), positive on the inner side of a triangle's edge.
struct Edge {
  double step_x, step_y;  ///< Change of e a pixel to the right and a pixel down.
  double from_x, from_y;
  bool top_left;

  Edge(const Corner& from, const Corner& to)
      : step_x(from.y - to.y),
        step_y(to.x - from.x),
        from_x(from.x),
        from_y(from.y),
        // With e > 0 inside and y down, an edge runs clockwise: a top edge to the right, a left edge upwards.
        top_left(to.y < from.y || (to.y == from.y && to.x > from.x)) {}
  double at(double x, double y) const { return step_y * (y - from_y) + step_x * (x - from_x); }
  bool covers(double value) const { return value > 0.0 || (value == 0.0 && top_left); }
};

/// First and one past the last pixel whose centre is in [low, high], cut at the picture.
std::pair<int, int> Centres(double low, double high, int size) {
  const double limit = size;
  return {static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, limit)),
          static_cast<int>(std::clamp(std::floor(high - 0.5) + 1.0, 0.0, limit))};
}

void RasteriseTriangle(int id, const std::array<Corner, 3>& given, const RasterOptions& options, bool perspective,
                       Raster& raster) {
  // Counter-clockwise from outside is e < 0 in a picture whose y points down: such a front face is turned, to have e >
  // 0 inside.
  std::array<int, 3> order = {0, 1, 2};
  double area = Edge(given[0], given[1]).at(given[2].x, given[2].y);
  if (area == 0.0 || (options.cull_back_faces && area > 0.0)) return;
  if (area < 0.0) {
    std::swap(order[1], order[2]);
    area = -area;
  }
  const Corner &a = given[order[0]], &b = given[order[1]], &c = given[order[2]];
  const Edge opposite_a(b, c), opposite_b(c, a), opposite_c(a, b);
  const auto [first_row, last_row] = Centres(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), raster.height);
  const auto [first_column, last_column] = Centres(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), raster.width);

  for (int row = first_row; row < last_row; ++row) {
    const double y = row + 0.5, x = first_column + 0.5;
    double at_a = opposite_a.at(x, y), at_b = opposite_b.at(x, y), at_c = opposite_c.at(x, y);
    for (int column = first_column; column < last_column; ++column) {
      if (opposite_a.covers(at_a) && opposite_b.covers(at_b) && opposite_c.covers(at_c)) {
        double wa = at_a / area, wb = at_b / area, wc = at_c / area;
        double depth = wa * a.depth + wb * b.depth + wc * c.depth;
        if (perspective) {
          // 1 / depth is linear in the picture, and so is each barycentric over depth.
          wa /= a.depth, wb /= b.depth, wc /= c.depth;
          depth = 1.0 / (wa + wb + wc);
          wa *= depth, wb *= depth, wc *= depth;
        }
        const size_t pixel = raster.index(row, column);
        if (depth < raster.depth[pixel]) {
          raster.depth[pixel] = depth;
          raster.triangle[pixel] = id;
          auto& barycentric = raster.barycentric[pixel];
          barycentric[order[0]] = static_cast<float>(wa);
          barycentric[order[1]] = static_cast<float>(wb);
          barycentric[order[2]] = static_cast<float>(wc);
        }
      }
      at_a += opposite_a.step_x, at_b += opposite_b.step_x, at_c += opposite_c.step_x;
    }
  }
}

}  // namespace

Raster Rasterise(const Camera& camera, const geometry::TriangleMesh& mesh, const RasterOptions& options) {
  DAUMIER_CHECK(camera.width > 0 && camera.height > 0, "a camera of {} x {} pixels, expected positive sizes",
                camera.height, camera.width);
  const int num_vertices = static_cast<int>(mesh.vertices.rows());
  DAUMIER_CHECK(
      mesh.triangles.size() == 0 || (mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < num_vertices),
      "the triangles to draw name vertices that are not among the {} given", num_vertices);

  const geometry::Points projected = Project(camera, mesh.vertices);
  Raster raster{.height = camera.height, .width = camera.width};
  const size_t num_pixels = size_t(camera.height) * camera.width;
  raster.triangle.assign(num_pixels, -1);
  raster.barycentric.assign(num_pixels, {0.0f, 0.0f, 0.0f});
  raster.depth.assign(num_pixels, std::numeric_limits<double>::infinity());

  for (int id = 0; id < mesh.triangles.rows(); ++id) {
    std::array<Corner, 3> corners;
    bool behind = false;
    for (int k = 0; k < 3; ++k) {
      const int vertex = mesh.triangles(id, k);
      const auto point = projected.row(vertex);
      behind = behind || (camera.perspective && point(2) < kNearDepth);
      if (behind) break;
      DAUMIER_CHECK(
          std::abs(point(0)) < kFarthestPixel && std::abs(point(1)) < kFarthestPixel && std::isfinite(point(2)),
          "vertex {} is projected to ({}, {}) at depth {}", vertex, point(0), point(1), point(2));
      corners[k] = {std::round(point(0) * kSubpixels) / kSubpixels, std::round(point(1) * kSubpixels) / kSubpixels,
                    point(2)};
    }
    if (!behind) RasteriseTriangle(id, corners, options, camera.perspective, raster);
  }
  return raster;
}

}  // namespace daumier::render
