#pragma once
#include "geometry/mesh.h"
#include "rig/rigged_head.h"

#include <string>
#include <vector>

namespace daumier::rig {

/// How vertices of an edited mesh were found on the head that it was made of.
enum class MatchedBy { kUv, kOrder };

/// An edited mesh on the places of a head: the vertices of RiggedHead::mesh, then those of its eyes.
struct EditedMatch {
  geometry::Points
      places;  ///< P x 3, cm, in the head's frame: as edited; where nothing is matched, as the head has it.
  std::vector<bool> is_matched;  ///< P
  MatchedBy by = MatchedBy::kUv;
  int num_vertices = 0;    ///< Of the edited mesh, in polygons.
  std::string axes, unit;  ///< Of the edited mesh: "y up"; "metres".
};

/// What the file of a head says beyond the head.
struct HeadNumbering {
  std::vector<int> of_file_vertices;                   ///< Of each vertex of the file's head, that of RiggedHead::mesh.
  std::vector<std::vector<int>> of_eye_vertices = {};  ///< Likewise of each eye, in the order of RiggedHead::eyes.
  double height_cm = 0;                                ///< At which other programs show the head's origin.
};

/// Matches a mesh that another program wrote of a head after an edit: vertices may be split, welded and reordered, axes be
/// turned by whole axes, units be mm, cm or m, and it may be moved.
/// By UV where it has any: a corner is the vertex of the head whose UV is nearest, within 1e-4; of several with the same UV
/// the one nearest in space, once the others have placed the mesh. Else by the order of vertices, if their number is that
/// of the file's head, alone or with its left and right eye, or of RiggedHead::mesh, and 9 of 10 edges are the head's.
/// Vertices within 5 um of where they were are unchanged. Parts that the mesh lacks are not matched.
/// @throws Error without the file: vertices without a match, another topology, a turn that is not by whole axes, another
/// unit, or less than half of the vertices that targets move.
EditedMatch MatchEdited(const RiggedHead& head, const HeadNumbering& numbering, const geometry::PolygonMesh& edited);

/// The places of a head: P x 3, cm.
geometry::Points PlacesOf(const RiggedHead& head);

}  // namespace daumier::rig
