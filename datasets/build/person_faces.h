#pragma once
#include "datasets/build/faces.h"
#include "datasets/build/faces_plan.h"
#include "faces/expression_transfer.h"

#include <vector>

namespace daumier::datasets {

/// The levels of a person's neutral face as specified by options.levels; strengths of parts are drawn from Stream(seed,
/// "parts", person) and appended to arrays.part_strengths. With gamma 0 alone, exaggerated as a whole, it is the face
/// itself, which needs no region of the annotation. `parts` is ignored unless levels are by parts.
std::vector<geometry::Points> MakeLevels(const faces::FaceTemplate& face_template, const faces::FaceParts& parts,
                                         const geometry::Points& neutral, const FacesOptions& options, int person,
                                         PersonArrays& arrays);

/// Makes all faces of a person as BuildFaces describes. Keeps references to the model and the options.
class PersonFacesMaker {
 public:
  /// @throws Error as faces::ExpressionTransfer, or faces::MakeFaceParts where levels are exaggerated by parts.
  PersonFacesMaker(const faces::FaceModel& model, const std::vector<faces::Expression>& expressions,
                   const FacesOptions& options);

  /// The same for the same seed and person. May be called from several threads at once.
  PersonArrays Make(int person) const;

 private:
  const faces::FaceModel& model_;
  const FacesOptions& options_;
  faces::ExpressionTransfer transfer_;
  faces::FaceParts parts_;
};

}  // namespace daumier::datasets
