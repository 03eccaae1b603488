#pragma once

#include "faces/expression_transfer.h"
#include "faces/face_model.h"
#include "rig/face_contact.h"
#include "rig/morph_targets.h"
#include "rig/source_shapes.h"

#include <string>
#include <vector>

namespace daumier::rig {

/// Makes the 52 expressions of ArkitNames() for any face of a source's topology, by deformation transfer from the
/// source's own [Pan et al. 2024, section 3.3], with lids that close and lips that meet (FaceContact). Made once for a
/// source.
class ExpressionTargets {
 public:
  /// @throws Error as ArkitShapesOf and FaceContact.
  explicit ExpressionTargets(const faces::FaceModel& model);
  ExpressionTargets(const faces::FaceTemplate& face_template, const SourceShapes& source);

  /// 52 targets in the order and spelling of ArkitNames(), for the V vertices of the topology. `neutral`: V x 3, cm.
  /// Targets that the source cannot make are zero; so are transferred displacements of up to 0.05 mm, and up to 0.1 mm
  /// they are smaller, continuously. On up to `threads` cores, whose number changes
  /// nothing. Thread-safe.
  /// @throws Error as faces::ExpressionTransfer::Offsets.
  MorphTargets On(const geometry::Points& neutral, unsigned threads = 8) const;

  /// Some of them (places in ArkitNames()), which takes less time: the columns of others are zero. A column is equal to that
  /// of On. @throws Error as On, or if a place is out of range.
  MorphTargets OnlyOn(const geometry::Points& neutral, const std::vector<int>& wanted, unsigned threads = 8) const;

  /// What the source cannot make, a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  const FaceContact& contact() const { return contact_; }

 private:
  MorphTargets Make(const geometry::Points& neutral, const std::vector<bool>& needed, unsigned threads) const;

  std::vector<std::string> warnings_;
  faces::ExpressionTransfer transfer_;
  FaceContact contact_;
};

}  // namespace daumier::rig
