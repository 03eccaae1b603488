#include "datasets/build/portrait_buffers.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "render/rasteriser.h"

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

/// Of each vertex in the world's frame, in camera space with y up and z to the viewer.
Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> ViewNormals(const faces::PortraitHead& head,
                                                                     const render::Camera& camera) {
  const geometry::Points normals = geometry::VertexNormals({head.vertices, head.triangles});
  const Eigen::Matrix3d view = Eigen::Vector3d(1, -1, -1).asDiagonal() * camera.camera_from_world;
  return (normals * view.transpose()).cast<float>();
}

}  // namespace

render::PictureBuffers DrawBuffers(const faces::PortraitHead& head, const render::Camera& camera,
                                   const SphericalLight& light, int supersampling) {
  const render::Camera enlarged = render::Enlarged(camera, supersampling);
  const render::Raster raster = render::Rasterise(enlarged, {head.vertices, head.triangles});
  const auto normals = ViewNormals(head, camera);

  render::PictureBuffers buffers = render::EmptyPictureBuffers(enlarged.height, enlarged.width, supersampling);
  buffers.pixels_per_cm = static_cast<float>(enlarged.scale / camera.translation.z());
  for (size_t pixel = 0; pixel < buffers.size(); ++pixel) {
    const int triangle = raster.triangle[pixel];
    if (triangle < 0) continue;
    Eigen::Vector3f colour = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::Zero();
    for (int k = 0; k < 3; ++k) {
      const int vertex = head.triangles(triangle, k);
      const float weight = raster.barycentric[pixel][size_t(k)];
      colour += weight * head.colours.row(vertex).transpose();
      normal += weight * normals.row(vertex).transpose();
    }
    const float length = normal.norm();
    normal = length > 1e-6f ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
    // Surfaces that are seen from inside are lit as if they had two sides.
    if (normal.z() < -0.1f) normal = -normal;
    for (int c = 0; c < 3; ++c) {
      buffers.albedo[3 * pixel + size_t(c)] = std::clamp(colour[c], 0.0f, 1.0f);
      buffers.normal[3 * pixel + size_t(c)] = normal[c];
    }
    buffers.shade[pixel] = std::max(0.0f, LightOn(light, normal));
    buffers.depth[pixel] = static_cast<float>(raster.depth[pixel]);
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
