#pragma once
#include "datasets/build/face_levels.h"
#include "faces/expression_repair.h"
#include "faces/expression_transfer.h"

#include <optional>
#include <vector>

namespace daumier::datasets {

/// Makes all faces of a person as BuildFaces describes. Keeps references to the model and the options.
class PersonFacesMaker {
 public:
  /// @throws Error as faces::ExpressionTransfer and LevelMaker.
  PersonFacesMaker(const faces::FaceModel& model, const std::vector<faces::Expression>& expressions,
                   const FacesOptions& options);

  Json Details() const { return levels_.Details(); }

  /// Where levels are by controls, expressions are repaired where triangles flip or lips or lids cross
  /// (faces::ExpressionRepair). The same for the same seed and person. May be called from several threads at once.
  PersonArrays Make(int person) const;

 private:
  const faces::FaceModel& model_;
  const FacesOptions& options_;
  faces::ExpressionTransfer transfer_;
  LevelMaker levels_;
  std::optional<faces::ExpressionRepair> repair_;  ///< Where levels are by controls.
};

}  // namespace daumier::datasets
