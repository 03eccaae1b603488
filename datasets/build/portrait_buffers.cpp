#include "datasets/build/portrait_buffers.h"

#include "core/error.h"
#include "raster/rasterise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::datasets {
namespace {

/// Cloth is cloth, on the head or below it.
PicturePart ShownPart(PicturePart part) {
  return part == PicturePart::kClothes ? PicturePart::kHat : part;
}

constexpr float kTurnedAway = -0.1f;  // z of normals that point away from the viewer.

/// What is interpolated over triangles: colour, the normal in camera space with y up and z to the viewer, and the light
/// on its front and on its back.
struct VertexLook {
  std::array<float, 3> colour, normal;
  float front, back;
};

/// N x 3: unit normals in camera space (y up, z to the viewer), the sum of the areas of a vertex's triangles.
Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> ViewNormals(const faces::PortraitHead& head,
                                                                     const render::Camera& camera) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Eigen::Matrix3d view = Eigen::Vector3d(1, -1, -1).asDiagonal() * camera.camera_from_world;
  const Rows points = (head.vertices * view.transpose()).cast<float>();
  Rows normals = Rows::Zero(points.rows(), 3);
  for (Eigen::Index t = 0; t < head.triangles.rows(); ++t) {
    const int* const corner = head.triangles.data() + 3 * t;
    const float *const a = points.data() + 3 * size_t(corner[0]), *const b = points.data() + 3 * size_t(corner[1]),
                       *const c = points.data() + 3 * size_t(corner[2]);
    const float ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const float vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const float x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (int k = 0; k < 3; ++k) {
      float* const normal = normals.data() + 3 * size_t(corner[k]);
      normal[0] += x, normal[1] += y, normal[2] += z;
    }
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const float length = normals.row(v).norm();
    if (length > 0) normals.row(v) /= length;
  }
  return normals;
}

std::vector<VertexLook> LooksOfVertices(const faces::PortraitHead& head, const render::Camera& camera,
                                        const SphericalLight& light) {
  const auto normals = ViewNormals(head, camera);
  std::vector<VertexLook> looks(static_cast<size_t>(head.vertices.rows()));
  for (Eigen::Index v = 0; v < head.vertices.rows(); ++v) {
    const Eigen::Vector3f normal = normals.row(v);
    VertexLook& look = looks[size_t(v)];
    for (int c = 0; c < 3; ++c) {
      look.colour[size_t(c)] = head.colours(v, c);
      look.normal[size_t(c)] = normal[c];
    }
    look.front = LightOn(light, normal);
    look.back = LightOn(light, -normal);
  }
  return looks;
}

/// Homogeneous pixel coordinates (X, Y, Z, w) as raster/camera.h has them, but with Z = -1, so that the depth Z / w is
/// -1 over the distance from the viewer along its axis, cm.
std::vector<float> HomogeneousPixels(const render::Camera& camera, const geometry::Points& vertices) {
  const geometry::Points pixels = render::Project(camera, vertices);
  std::vector<float> positions;
  positions.reserve(size_t(pixels.rows()) * 4);
  for (const auto& pixel : pixels.rowwise()) {
    const double w = pixel[2];
    for (const double value : {pixel[0] * w, pixel[1] * w, -1.0, w}) positions.push_back(static_cast<float>(value));
  }
  return positions;
}

/// Whether a part shows its outside alone: closed surfaces, and the face, whose openings have something behind them.
bool IsSolid(PicturePart part) {
  return part == PicturePart::kSkin || part == PicturePart::kEyeball || part == PicturePart::kTeeth ||
         part == PicturePart::kClothes;
}

/// Triangles that may be seen: all but those of solid parts that face away.
struct FacingTriangles {
  raster::MeshTopology topology;  ///< Without edges, which nothing here reads.
  std::vector<int> rows;          ///< Of the head, of each triangle of the topology.
};

FacingTriangles FindFacing(const faces::PortraitHead& head, const std::vector<float>& positions) {
  FacingTriangles facing;
  facing.topology.num_vertices = static_cast<int>(head.vertices.rows());
  facing.topology.triangles.reserve(size_t(head.triangles.rows()));
  const auto x = [&](int v) { return positions[4 * size_t(v)] / positions[4 * size_t(v) + 3]; };
  const auto y = [&](int v) { return positions[4 * size_t(v) + 1] / positions[4 * size_t(v) + 3]; };
  for (int t = 0; t < head.triangles.rows(); ++t) {
    const int* const corner = head.triangles.data() + 3 * size_t(t);
    if (IsSolid(PicturePart(head.parts[size_t(t)]))) {
      const float x0 = x(corner[0]), y0 = y(corner[0]);
      // With y downwards, a triangle that is counter-clockwise for the viewer has a negative area.
      if ((x(corner[1]) - x0) * (y(corner[2]) - y0) - (x(corner[2]) - x0) * (y(corner[1]) - y0) > 0) continue;
    }
    facing.topology.triangles.push_back({corner[0], corner[1], corner[2]});
    facing.rows.push_back(t);
  }
  return facing;
}

}  // namespace

render::PictureBuffers DrawBuffers(const faces::PortraitHead& head, const render::Camera& camera,
                                   const SphericalLight& light, int supersampling) {
  DAUMIER_CHECK(camera.perspective && head.triangles.rows() > 0, "portraits are of triangles, in perspective");
  const render::Camera enlarged = render::Enlarged(camera, supersampling);
  const std::vector<float> positions = HomogeneousPixels(enlarged, head.vertices);
  const FacingTriangles facing = FindFacing(head, positions);
  raster::Raster<float> raster;
  raster::Rasterise(facing.topology, positions.data(), enlarged.height, enlarged.width, raster::Facing::kBoth, raster);
  const std::vector<VertexLook> looks = LooksOfVertices(head, camera, light);

  render::PictureBuffers buffers = render::EmptyPictureBuffers(enlarged.height, enlarged.width, supersampling);
  buffers.pixels_per_cm = static_cast<float>(enlarged.scale / camera.translation.z());
  for (size_t pixel = 0; pixel < buffers.size(); ++pixel) {
    if (raster.triangle[pixel] < 0) continue;
    const int triangle = facing.rows[size_t(raster.triangle[pixel])];
    const float b0 = raster.barycentric[2 * pixel], b1 = raster.barycentric[2 * pixel + 1], b2 = 1 - b0 - b1;
    const int* const corners = head.triangles.data() + 3 * size_t(triangle);
    const VertexLook &l0 = looks[size_t(corners[0])], &l1 = looks[size_t(corners[1])], &l2 = looks[size_t(corners[2])];
    const auto mix = [&](float v0, float v1, float v2) { return b0 * v0 + b1 * v1 + b2 * v2; };
    float* const colour = buffers.albedo.data() + 3 * pixel;
    std::array<float, 3> normal;
    for (size_t k = 0; k < 3; ++k) {
      colour[k] = std::clamp(mix(l0.colour[k], l1.colour[k], l2.colour[k]), 0.0f, 1.0f);
      normal[k] = mix(l0.normal[k], l1.normal[k], l2.normal[k]);
    }
    const float square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    // Surfaces that are seen from inside are lit as if they had two sides.
    const bool is_back = normal[2] < kTurnedAway * std::sqrt(square);
    if (square > 1e-12f) {
      const float scale = (is_back ? -1 : 1) / std::sqrt(square);
      for (size_t k = 0; k < 3; ++k) buffers.normal[3 * pixel + k] = scale * normal[k];
    }
    buffers.shade[pixel] = std::max(0.0f, is_back ? mix(l0.back, l1.back, l2.back) : mix(l0.front, l1.front, l2.front));
    buffers.depth[pixel] = -1 / raster.depth[pixel];
    buffers.classes[pixel] = head.classes[size_t(triangle)];
    buffers.parts[pixel] = static_cast<uint8_t>(ShownPart(PicturePart(head.parts[size_t(triangle)])));
  }
  return buffers;
}

render::Image MaskOf(const render::PictureBuffers& buffers) {
  const int factor = buffers.supersampling, height = buffers.height / factor, width = buffers.width / factor;
  render::Image mask(height, width, 1, 0);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      std::array<int, kNumPictureClasses> counts{};
      for (int i = 0; i < factor; ++i) {
        const size_t begin = size_t(row * factor + i) * buffers.width + size_t(column) * factor;
        for (int j = 0; j < factor; ++j) ++counts[buffers.classes[begin + j]];
      }
      mask.at(row, column) = static_cast<uint8_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
    }
  }
  return mask;
}

std::vector<uint8_t> SeenPoints(const render::PictureBuffers& buffers, const render::Camera& camera,
                                const geometry::Points& points, double tolerance) {
  const geometry::Points pixels = render::Project(camera, points);
  std::vector<uint8_t> seen(static_cast<size_t>(points.rows()));
  const int factor = buffers.supersampling;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const double x = pixels(p, 0), y = pixels(p, 1);
    if (!(x >= 0 && x < camera.width && y >= 0 && y < camera.height)) continue;
    const int column = static_cast<int>(x * factor), row = static_cast<int>(y * factor);
    float farthest = 0;
    for (int r = std::max(0, row - 1); r <= std::min(buffers.height - 1, row + 1); ++r)
      for (int c = std::max(0, column - 1); c <= std::min(buffers.width - 1, column + 1); ++c)
        farthest = std::max(farthest, buffers.depth[size_t(r) * buffers.width + size_t(c)]);
    seen[size_t(p)] = pixels(p, 2) <= farthest + tolerance;
  }
  return seen;
}

}  // namespace daumier::datasets
