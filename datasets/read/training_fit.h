#pragma once
#include "core/json.h"
#include "datasets/read/sketch_database.h"
#include "datasets/read/splits.h"
#include "faces/bilinear_model.h"
#include "faces/face_database.h"

#include <span>
#include <vector>

namespace daumier::datasets {

struct FittedBilinear {
  faces::BilinearModel model;
  /// person * num_levels + level of each row of model.identity_factors, ascending.
  std::vector<int> identities;
  /// Which faces were read: {num_faces, num_persons, persons, faces_checksum} as in SplitToJson, and num_identities.
  Json proof;
};

/// Fits the bilinear model to all coordinates of the split's training faces of the grid; no other face is read.
/// Identities are the pairs of person and level that have a training face; faces of theirs that are held out (split
/// "random") are imputed as FitBilinear tells.
/// @throws Error as FitBilinear.
FittedBilinear FitOnTraining(const faces::FaceDatabase& database, const Split& split,
                             const faces::BilinearOptions& options);

/// The same of the 2-D points on silhouette and feature lines, SketchDatabase::feature_curves, in pixels of the 256
/// canvas: the model behind the shape-level input [Han et al. 2017, section 4.3], which faces::CurveEncoder encodes.
/// @throws Error as FitBilinear, or if the sketches belong to other faces.
FittedBilinear FitCurvesOnTraining(const faces::FaceDatabase& database, const SketchDatabase& sketches,
                                   const Split& split, const faces::BilinearOptions& options);

}  // namespace daumier::datasets
