#pragma once
#include "faces/bilinear_projector.h"
#include "faces/face_database.h"

#include <vector>

namespace daumier::sketch {

/// The u and v that the second step of training learns [Han et al. 2017, section 4.4]: of a face of the grid the
/// factors of its identity and its expression in the fitted model; of an interpolated face the factors of both parents,
/// interpolated by its shares (datasets/build/interpolation.h). An interpolated face with a parent whose identity was
/// not fitted has the nearest u and v (faces::BilinearProjector) instead, which takes longer.
class CoefficientTargets {
 public:
  /// identities: datasets::TrainingIdentities, the rows of the model's identity factors. Keeps references to database
  /// and model.
  CoefficientTargets(const faces::FaceDatabase& database, std::vector<int> identities,
                     const faces::BilinearModel& model);

  /// Without vertices, but for a projection. @throws Error if there is no such face, or if it is one of the grid and
  /// its identity was not fitted.
  faces::BilinearProjection Of(int face) const;

 private:
  /// Row of the identity factors, or -1.
  Eigen::Index Row(const faces::FaceId& face) const;

  const faces::FaceDatabase& database_;
  std::vector<int> identities_;
  const faces::BilinearModel& model_;
  faces::BilinearProjector projector_;
};

}  // namespace daumier::sketch
