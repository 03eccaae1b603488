#pragma once
#include "render/image.h"
#include "rig/rigged_head.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace daumier::gltf {

/// A head that was read from a file of HeadToGlb.
struct HeadInFile {
  /// cm about the pivot of the head, which is 0. Vertices that seams of UV split are one again: vertices of a part that
  /// follow each other at one place with one motion, and vertices of other parts there. UV rows of `mesh` and of eyes are
  /// the vertices of the file. Names and order of targets are the file's.
  rig::RiggedHead head;
  std::shared_ptr<const render::Image> texture;   ///< The atlas; null: none.
  std::vector<int> of_file_vertices;              ///< Of each vertex of the file's head, in order, that of `head.mesh`.
  std::vector<std::vector<int>> of_eye_vertices;  ///< Likewise of each eye, in the order of RiggedHead::eyes.
  double pivot_height_cm = 0;                     ///< The node's: where other programs show the head.
  bool has_normals = false;                       ///< Targets change normals.
};

/// Reads a plain .glb with the nodes of HeadNodeNames::kDaumier, of this program alone. Materials of triangles and the cap
/// of the neck come from `extras.triangles` of the nodes; files without it have skin and eyeballs. The animation is not
/// read.
/// @throws Error naming the file, the cause and the repair: no .glb, cut off, damaged, compressed, of another program, or
/// with the nodes of VRM or Ready Player Me.
HeadInFile ReadHead(const std::filesystem::path& path);
/// ReadHead of bytes.
HeadInFile ParseHead(std::string bytes, const std::string& name);

}  // namespace daumier::gltf
