#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier::geometry {

/// A material that an OBJ file uses: of its MTL files, or without any but its name where they lack it.
struct UsedMaterial {
  std::string name;
  std::array<float, 3> diffuse = {0.8f, 0.8f, 0.8f};  ///< Kd, linear light, 0 .. 1.
  float opacity = 1;                                  ///< d, or 1 - Tr.
  std::filesystem::path picture = {};                 ///< map_Kd, next to the MTL file; empty without one.
};

struct UsedMaterials {
  std::vector<UsedMaterial> materials;  ///< In the order of their first use.
  std::vector<int> of_polygons;         ///< One an `f` line: a row of materials, -1 before the first `usemtl`.
};

/// Which material each polygon of an OBJ file has: lines `usemtl`, and the files of `mtllib` next to it. A library that is
/// not there leaves its materials grey, with a warning. Options of map_Kd are skipped. No materials without `usemtl`.
/// @throws Error if a file cannot be read.
UsedMaterials ReadUsedMaterials(const std::filesystem::path& obj);

}  // namespace daumier::geometry
