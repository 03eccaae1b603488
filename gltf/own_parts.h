#pragma once
#include "gltf/glb_builder.h"
#include "rig/rigged_head.h"

#include <string>
#include <vector>

namespace daumier::gltf {

/// The triangles of a mesh that have one of a head's own materials.
struct OwnPart {
  int material;                 ///< A row of RiggedHead::own_materials.
  std::vector<int> triangles;   ///< Rows of the mesh.
  geometry::TriangleMesh mesh;  ///< With all vertices.
  double motion;                ///< Sum of the lengths of all displacements of its vertices, cm: 0 without targets.
};

/// Parts with triangles, ascending by material, but the one that moves most first. `own`: a row a triangle.
std::vector<OwnPart> PartsByMaterial(const geometry::TriangleMesh& mesh, const std::vector<int>& own,
                                     const rig::MorphTargets& targets);

/// Adds a material with its colour, picture and opacity, seen from both sides. Returns its index.
int AddOwnMaterial(GlbBuilder& builder, const rig::OwnMaterial& material);

/// A name of letters, digits and "_": others become "_".
std::string NodeName(const std::string& name);

}  // namespace daumier::gltf
