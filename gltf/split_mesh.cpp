#include "gltf/split_mesh.h"

#include "core/error.h"
#include "geometry/corner_uv.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <compare>
#include <limits>

namespace daumier::gltf {
namespace {

/// What distinguishes vertices of the file.
struct CornerKey {
  int vertex;
  float u = 0, v = 0;
  faces::HeadMaterial material = faces::HeadMaterial::kSkin;
  auto operator<=>(const CornerKey&) const = default;
};

std::vector<CornerKey> CornerKeys(const geometry::TriangleMesh& mesh,
                                  const std::vector<faces::HeadMaterial>& materials) {
  std::vector<CornerKey> keys;
  keys.reserve(static_cast<size_t>(mesh.triangles.size()));
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      CornerKey key{.vertex = mesh.triangles(t, c)};
      DAUMIER_CHECK(key.vertex >= 0 && key.vertex < mesh.vertices.rows(), "triangle {} names vertex {}, there are {}",
                    t, key.vertex, mesh.vertices.rows());
      if (mesh.has_uv()) {
        const auto uv = mesh.uv.row(mesh.uv_triangles(t, c));
        key.u = static_cast<float>(uv.x());
        key.v = static_cast<float>(uv.y());
      }
      if (!materials.empty()) key.material = materials[size_t(t)];
      keys.push_back(key);
    }
  }
  return keys;
}

bool Precedes(const CornerKey& a, const CornerKey& b) {
  return std::is_lt(a <=> b);
}

/// `values` in the order of `remap`: value i moves to remap[i].
template <class T>
std::vector<T> Remapped(const std::vector<T>& values, const std::vector<unsigned>& remap) {
  std::vector<T> moved(values.size());
  for (size_t i = 0; i < values.size(); ++i) moved[remap[i]] = values[i];
  return moved;
}

}  // namespace

SplitMesh SplitAtSeams(const geometry::TriangleMesh& mesh, const std::vector<faces::HeadMaterial>& materials) {
  geometry::CheckUv(mesh);
  DAUMIER_CHECK(materials.empty() || std::ssize(materials) == mesh.triangles.rows(),
                "{} materials for {} triangles, expected one each", materials.size(), mesh.triangles.rows());
  const std::vector<CornerKey> corners = CornerKeys(mesh, materials);
  std::vector<CornerKey> vertices = corners;
  std::sort(vertices.begin(), vertices.end(), Precedes);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  SplitMesh split;
  split.uv.resize(mesh.has_uv() ? std::ssize(vertices) : 0, 2);
  for (size_t n = 0; n < vertices.size(); ++n) {
    split.source_vertices.push_back(vertices[n].vertex);
    if (mesh.has_uv()) split.uv.row(Eigen::Index(n)) << double(vertices[n].u), double(vertices[n].v);
    if (!materials.empty()) split.materials.push_back(vertices[n].material);
  }
  for (const CornerKey& corner : corners) {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), corner, Precedes);
    split.indices.push_back(static_cast<uint32_t>(found - vertices.begin()));
  }
  return split;
}

SplitMesh OrderForCompression(const SplitMesh& mesh) {
  SplitMesh ordered;
  ordered.indices.resize(mesh.indices.size());
  const size_t num_vertices = mesh.source_vertices.size();
  meshopt_optimizeVertexCacheStrip(ordered.indices.data(), mesh.indices.data(), mesh.indices.size(), num_vertices);
  std::vector<unsigned> remap(num_vertices);
  meshopt_optimizeVertexFetchRemap(remap.data(), ordered.indices.data(), ordered.indices.size(), num_vertices);
  for (uint32_t& index : ordered.indices) index = remap[index];
  ordered.source_vertices = Remapped(mesh.source_vertices, remap);
  if (!mesh.materials.empty()) ordered.materials = Remapped(mesh.materials, remap);
  ordered.uv.resize(mesh.uv.rows(), 2);
  for (Eigen::Index n = 0; n < mesh.uv.rows(); ++n) ordered.uv.row(remap[size_t(n)]) = mesh.uv.row(n);
  return ordered;
}

}  // namespace daumier::gltf
