#include "geometry/stl.h"

#include "core/error.h"
#include "geometry/normals.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>

namespace daumier::geometry {
namespace {

constexpr size_t kHeaderBytes = 80, kTriangleBytes = 50;
static_assert(std::endian::native == std::endian::little);

template <class T>
void AppendBytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

std::string EncodeStl(const TriangleMesh& mesh, std::string_view header) {
  DAUMIER_CHECK(header.size() <= kHeaderBytes && !header.starts_with("solid"),
                "'{}' is no header of a binary STL file: more than {} bytes, or it begins with 'solid'", header,
                kHeaderBytes);
  const Eigen::Index count = mesh.triangles.rows();
  DAUMIER_CHECK(count == 0 || (mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.vertices.rows()),
                "a triangle names a vertex that is not there: there are {}", mesh.vertices.rows());
  const Points normals = TriangleNormals(mesh);
  std::string bytes(header);
  bytes.resize(kHeaderBytes, '\0');
  bytes.reserve(kHeaderBytes + 4 + kTriangleBytes * size_t(count));
  AppendBytes(bytes, uint32_t(count));
  for (Eigen::Index f = 0; f < count; ++f) {
    AppendBytes(bytes, std::array<float, 3>{float(normals(f, 0)), float(normals(f, 1)), float(normals(f, 2))});
    for (const int v : mesh.triangles.row(f)) {
      DAUMIER_CHECK(mesh.vertices.row(v).allFinite(), "vertex {} is not finite", v);
      AppendBytes(bytes, std::array<float, 3>{float(mesh.vertices(v, 0)), float(mesh.vertices(v, 1)),
                                              float(mesh.vertices(v, 2))});
    }
    AppendBytes(bytes, uint16_t(0));
  }
  return bytes;
}

TriangleMesh DecodeStl(std::string_view bytes) {
  uint32_t count = 0;
  DAUMIER_CHECK(bytes.size() >= kHeaderBytes + sizeof(count), "{} bytes are too few for a binary STL file",
                bytes.size());
  std::memcpy(&count, bytes.data() + kHeaderBytes, sizeof(count));
  const size_t expected = kHeaderBytes + sizeof(count) + kTriangleBytes * size_t(count);
  DAUMIER_CHECK(bytes.size() == expected, "a binary STL file of {} triangles has {} bytes, expected {}", count,
                bytes.size(), expected);
  TriangleMesh mesh;
  mesh.triangles.resize(Eigen::Index(count), 3);
  std::map<std::array<float, 3>, int> places;
  for (uint32_t f = 0; f < count; ++f) {
    for (int k = 0; k < 3; ++k) {
      std::array<float, 3> corner;
      std::memcpy(corner.data(), bytes.data() + kHeaderBytes + 4 + kTriangleBytes * f + 12 * size_t(k + 1), 12);
      DAUMIER_CHECK(Eigen::Map<const Eigen::Array3f>(corner.data()).isFinite().all(),
                    "triangle {} has a corner that is not finite", f);
      mesh.triangles(Eigen::Index(f), k) = places.try_emplace(corner, int(places.size())).first->second;
    }
  }
  mesh.vertices.resize(std::ssize(places), 3);
  for (const auto& [corner, v] : places)
    mesh.vertices.row(v) << double(corner[0]), double(corner[1]), double(corner[2]);
  return mesh;
}

}  // namespace daumier::geometry
