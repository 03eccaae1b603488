#pragma once
#include "datasets/build/faces.h"
#include "datasets/build/faces_plan.h"
#include "faces/expression_transfer.h"

#include <vector>

namespace daumier::datasets {

/// Makes all faces of a person as BuildFaces tells. Keeps references to the model and the options.
class PersonFacesMaker {
 public:
  /// @throws Error as faces::ExpressionTransfer, or faces::MakeFaceParts where levels are exaggerated by parts.
  PersonFacesMaker(const faces::FaceModel& model, const std::vector<faces::Expression>& expressions,
                   const FacesOptions& options);

  /// The same for the same seed and person. May be called from several threads at once.
  PersonArrays Make(int person) const;

 private:
  std::vector<geometry::Points> Levels(const geometry::Points& neutral, int person, PersonArrays& arrays) const;

  const faces::FaceModel& model_;
  const FacesOptions& options_;
  faces::ExpressionTransfer transfer_;
  faces::FaceParts parts_;
};

}  // namespace daumier::datasets
