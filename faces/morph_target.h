#pragma once
#include "geometry/mesh.h"

#include <filesystem>

namespace daumier::faces {

/// Reads a morph target of MakeHuman, a text of lines "vertex dx dy dz" and comments (#), as the displacement of each of
/// num_vertices vertices, in the file's unit; vertices without a line stay. @throws Error naming file and line: numbers
/// that are missing, too many or not finite, a vertex out of range or with two lines.
geometry::Points ReadMorphTarget(const std::filesystem::path& file, int num_vertices);

}  // namespace daumier::faces
