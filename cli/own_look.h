#pragma once
#include "cli/rig_face.h"
#include "rig/own_material.h"

#include <vector>

namespace daumier::cli {

/// The materials that a mesh file brings along.
struct OwnLook {
  std::vector<rig::OwnMaterial> materials;  ///< Empty where the file has none.
  std::vector<int> of_triangles;            ///< One a triangle of geometry::TriangulateMesh: a row of materials.
};

/// Of an OBJ file: colours, opacities and pictures of its MTL files. Pictures that are neither PNG nor JPEG become PNG; of a
/// mesh without UV they are left out. Warns of pictures that cannot be read, and of files of which polygons were skipped:
/// these have no materials.
OwnLook ReadOwnLook(const GivenFace& given);

}  // namespace daumier::cli
