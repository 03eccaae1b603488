#pragma once

#include <string>
#include <vector>

#include "faces/head_material.h"
#include "geometry/mesh.h"
#include "rig/morph_targets.h"
#include "rig/own_material.h"

namespace daumier::rig {

/// An eyeball that turns about its own centre.
struct RiggedEye {
  geometry::TriangleMesh mesh;                 ///< cm, about its centre, looking to +z; UV in the head's atlas.
  std::vector<faces::HeadMaterial> materials;  ///< One a triangle.
  geometry::Vector3 centre;                    ///< cm, in the head's frame.
  std::vector<int> own = {};                   ///< One a triangle, a row of RiggedHead::own_materials, or none.
};

/// A surface that turns with a head and has no targets, such as hair.
struct HeadAttachment {
  std::string name;             ///< Of letters: "Hair".
  geometry::TriangleMesh mesh;  ///< cm, in the head's frame, without UV.
  Eigen::MatrixXf colours;      ///< N x 3, a vertex a row, display RGB in [0, 1].
};

/// A head that a game or a web page animates: one closed mesh with what is behind its lips, morph targets, and two
/// eyeballs. Every corner has UV in one atlas (TextureSpace).
struct RiggedHead {
  geometry::TriangleMesh mesh;                 ///< Skin, rims of the lids and inside of the mouth; cm, y up, facing +z.
  std::vector<faces::HeadMaterial> materials;  ///< One a triangle of `mesh`.
  MorphTargets targets;                        ///< Of the vertices of `mesh`.
  std::vector<RiggedEye> eyes;                 ///< The head's right one (-x), then its left one.
  geometry::Vector3 head_pivot;                ///< About which a head nods, cm: between the ears.
  geometry::Vector3 jaw_pivot;                 ///< About which a jaw opens, cm.
  std::string source;                          ///< FaceTemplate::source
  std::string licence;                         ///< Of the source, for the written file.
  /// Of a head of another topology that has any: `own` of each triangle of `mesh`; the materials above are not shown then.
  std::vector<OwnMaterial> own_materials = {};
  std::vector<int> own = {};
  std::vector<HeadAttachment> attachments = {};
  /// Triangles of `mesh` that close the neck, ascending; of heads of a face model alone.
  std::vector<int> neck_cap = {};
};

}  // namespace daumier::rig
