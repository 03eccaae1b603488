#pragma once
#include "faces/archive.h"
#include "geometry/obj.h"
#include "geometry/triangulate.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace daumier::testing {

/// Face and head of ICT-FaceKit Light as its files have them, nothing cropped: 11,248 vertices, 22,288 triangles. For
/// tests and benchmarks of rendering; faces::LoadIct cuts the neck.
struct IctHead {
  geometry::TriangleMesh neutral;
  std::map<std::string, geometry::Points> shapes;  ///< Displacements in cm, by name of the file.
};

inline constexpr int kIctHeadVertices = 11248;

/// `names` without ".obj", for example "identity003", "jawOpen". @throws Error as ForEachFile and ParseObj.
inline IctHead LoadIctHead(const std::filesystem::path& archive, const std::vector<std::string>& names) {
  const std::string neutral_name = "generic_neutral_mesh";
  IctHead head;
  std::map<std::string, geometry::Points> meshes;
  faces::ForEachFile(
      archive,
      [&](const std::string& path) {
        const std::string stem = std::filesystem::path(path).stem().string();
        return path.ends_with(".obj") &&
               (stem == neutral_name || std::find(names.begin(), names.end(), stem) != names.end());
      },
      [&](const std::string& path, std::string_view text) {
        const std::string stem = std::filesystem::path(path).stem().string();
        const geometry::PolygonMesh mesh = geometry::ParseObj(text, path);
        meshes[stem] = mesh.vertices.topRows(kIctHeadVertices);
        if (stem != neutral_name) return;
        geometry::PolygonMesh polygons{.vertices = meshes[stem]};
        for (int p = 0; p < mesh.num_polygons(); ++p) {
          const auto begin = mesh.corners.begin() + mesh.offsets[p], end = mesh.corners.begin() + mesh.offsets[p + 1];
          if (*std::max_element(begin, end) >= kIctHeadVertices) continue;
          polygons.corners.insert(polygons.corners.end(), begin, end);
          polygons.offsets.push_back(static_cast<int>(polygons.corners.size()));
        }
        head.neutral = geometry::TriangulateMesh(polygons);
      });
  for (const std::string& name : names) head.shapes[name] = meshes.at(name) - head.neutral.vertices;
  return head;
}

}  // namespace daumier::testing
