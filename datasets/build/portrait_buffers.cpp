#include "datasets/build/portrait_buffers.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "raster/rasterise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::datasets {
namespace {

using faces::PortraitPart;
using render::PicturePart;

// Rooms below faces/ number parts and classes alike.
static_assert(int(PortraitPart::kSkin) == int(PicturePart::kSkin) &&
              int(PortraitPart::kHair) == int(PicturePart::kHair) &&
              int(PortraitPart::kLens) == int(PicturePart::kLens) &&
              faces::kNumMaskClasses == render::kNumPictureClasses);

/// What is interpolated over triangles: colour, and the normal in camera space with y up and z to the viewer.
struct VertexLook {
  std::array<float, 3> colour, normal;
};

std::vector<VertexLook> LooksOfVertices(const faces::PortraitHead& head, const render::Camera& camera) {
  const geometry::Points normals = geometry::VertexNormals({head.vertices, head.triangles});
  const Eigen::Matrix3d view = Eigen::Vector3d(1, -1, -1).asDiagonal() * camera.camera_from_world;
  std::vector<VertexLook> looks(static_cast<size_t>(head.vertices.rows()));
  for (Eigen::Index v = 0; v < head.vertices.rows(); ++v) {
    const Eigen::Vector3d normal = view * normals.row(v).transpose();
    VertexLook& look = looks[size_t(v)];
    for (int c = 0; c < 3; ++c) {
      look.colour[size_t(c)] = head.colours(v, c);
      look.normal[size_t(c)] = static_cast<float>(normal[c]);
    }
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

raster::Raster<float> RasteriseHead(const faces::PortraitHead& head, const render::Camera& camera) {
  raster::MeshTopology topology;  // Edges are not used.
  topology.num_vertices = static_cast<int>(head.vertices.rows());
  topology.triangles.resize(size_t(head.triangles.rows()));
  std::copy_n(head.triangles.data(), head.triangles.size(), topology.triangles.front().data());
  raster::Raster<float> raster;
  raster::Rasterise(topology, HomogeneousPixels(camera, head.vertices).data(), camera.height, camera.width,
                    raster::Facing::kBoth, raster);
  return raster;
}

}  // namespace

render::PictureBuffers DrawBuffers(const faces::PortraitHead& head, const render::Camera& camera,
                                   const SphericalLight& light, int supersampling) {
  DAUMIER_CHECK(camera.perspective && head.triangles.rows() > 0, "portraits are of triangles, in perspective");
  const render::Camera enlarged = render::Enlarged(camera, supersampling);
  const raster::Raster<float> raster = RasteriseHead(head, enlarged);
  const std::vector<VertexLook> looks = LooksOfVertices(head, camera);

  render::PictureBuffers buffers = render::EmptyPictureBuffers(enlarged.height, enlarged.width, supersampling);
  buffers.pixels_per_cm = static_cast<float>(enlarged.scale / camera.translation.z());
  for (size_t pixel = 0; pixel < buffers.size(); ++pixel) {
    const int triangle = raster.triangle[pixel];
    if (triangle < 0) continue;
    const float b0 = raster.barycentric[2 * pixel], b1 = raster.barycentric[2 * pixel + 1], b2 = 1 - b0 - b1;
    const int* const corners = head.triangles.data() + 3 * size_t(triangle);
    const VertexLook &l0 = looks[size_t(corners[0])], &l1 = looks[size_t(corners[1])], &l2 = looks[size_t(corners[2])];
    Eigen::Vector3f normal;
    for (int c = 0; c < 3; ++c) {
      const auto k = static_cast<size_t>(c);
      buffers.albedo[3 * pixel + k] = std::clamp(b0 * l0.colour[k] + b1 * l1.colour[k] + b2 * l2.colour[k], 0.0f, 1.0f);
      normal[c] = b0 * l0.normal[k] + b1 * l1.normal[k] + b2 * l2.normal[k];
    }
    const float length = normal.norm();
    normal = length > 1e-6f ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
    // Surfaces that are seen from inside are lit as if they had two sides.
    if (normal.z() < -0.1f) normal = -normal;
    for (int c = 0; c < 3; ++c) buffers.normal[3 * pixel + size_t(c)] = normal[c];
    buffers.shade[pixel] = std::max(0.0f, LightOn(light, normal));
    buffers.depth[pixel] = -1 / raster.depth[pixel];
    buffers.classes[pixel] = head.classes[size_t(triangle)];
    buffers.parts[pixel] = head.parts[size_t(triangle)];
  }
  return buffers;
}

render::Image MaskOf(const render::PictureBuffers& buffers) {
  const int factor = buffers.supersampling, height = buffers.height / factor, width = buffers.width / factor;
  render::Image mask(height, width, 1, 0);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      std::array<int, faces::kNumMaskClasses> counts{};
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
