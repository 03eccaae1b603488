#pragma once
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "faces/annotation_file.h"
#include "tests/support/synthetic_face.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

/// The synthetic head as an external topology: quads and a small annotation of the user's.
namespace daumier::testing {

inline const SyntheticGrid& ForeignGrid() {
  static const SyntheticGrid grid;
  return grid;
}

/// Landmarks, hairline, and the regions that no hole determines; `regions` false: landmarks and hairline alone.
inline Json ForeignAnnotationJson(bool regions = true) {
  Json json = {
      {"format", 1}, {"landmarks", SyntheticFace().annotation.landmarks}, {"hairline", ForeignGrid().at(0, 21)}};
  if (regions) {
    json["regions"] = {{"nose", {{"vertices", ForeignGrid().Block(0, 2, 9, 13)}}},
                       {"ears", {{"vertices", ForeignGrid().Block(11, 14, 8, 16)}}}};
  }
  return json;
}

inline faces::AnnotationFile ForeignAnnotation(bool regions = true) {
  return faces::ParseAnnotationFile(ForeignAnnotationJson(regions).dump(), "foreign.json");
}

/// A face of the foreign topology: the head stretched by `k` percent in height, in units of `unit_cm`.
inline geometry::PolygonMesh ForeignMesh(double k = 0, double unit_cm = 1) {
  geometry::PolygonMesh mesh = ForeignGrid().mesh();
  mesh.vertices.col(1) *= 1 + 0.01 * k;
  mesh.vertices /= unit_cm;
  return mesh;
}

/// The corners of every triangle, the lowest first.
inline std::vector<std::array<int, 3>> LowestFirst(const geometry::Triangles& triangles) {
  std::vector<std::array<int, 3>> result;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<int, 3> corners = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.push_back(corners);
  }
  return result;
}

/// An OBJ file with texture coordinates and normals in its corners, as FaceWarehouse has them.
inline void WriteForeignObj(const std::filesystem::path& path, const geometry::PolygonMesh& mesh) {
  std::string text;
  for (const auto& p : mesh.vertices.rowwise()) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  text += "vt 0 0\nvn 0 0 1\n";
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    text += "f";
    for (int c = mesh.offsets[p]; c < mesh.offsets[p + 1]; ++c) text += fmt::format(" {}/1/1", mesh.corners[c] + 1);
    text += "\n";
  }
  MakeDirectory(path.parent_path());
  WriteFileAtomically(path, text);
}

}  // namespace daumier::testing
