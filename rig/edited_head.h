#pragma once
#include "rig/edited_match.h"
#include "rig/rigged_head.h"

#include <string>

namespace daumier::rig {

/// How an edit changed a head.
struct EditedHead {
  RiggedHead head;
  int num_matched = 0;                        ///< Vertices of the head and its eyes.
  int num_expected = 0;                       ///< Vertices of those parts of RiggedHead::mesh that have any match.
  int num_missing = 0;                        ///< Of these, without a match.
  double mean_edit_mm = 0, most_edit_mm = 0;  ///< Over the matched vertices of RiggedHead::mesh.
  double most_target_change_mm = 0;           ///< Of all displacements.
  std::string most_changed_target = {};       ///< Empty if none changed.
};

/// A head with the shape of an edited mesh: targets by TransferredTargets; UV, materials, names and triangles unchanged.
/// - Parts of the mesh that are not matched move by the MeanMotion of the vertices that are nearest to them; vertices that
///   are not matched in a part that is, and attachments, as the nearest matched vertex did.
/// - Eyes with a match for 9 of 10 vertices get these, and their centre moves by the MeanMotion of them; others are moved
///   and scaled as a whole by the MeanMotion of the matched vertices within 1.3 radii of their centre, of lids;
///   where these are less than 6, as pivots.
/// - Pivots move by the MeanMotion of the twentieth of the matched vertices that is nearest, at least 6.
/// Promise: an unedited mesh gives the head itself.
EditedHead ApplyEdit(const RiggedHead& head, const EditedMatch& match);

}  // namespace daumier::rig
