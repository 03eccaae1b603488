#pragma once
#include "core/json.h"
#include "datasets/read/sketch_database.h"
#include "datasets/read/splits.h"
#include "faces/bilinear_model.h"
#include "faces/face_basis.h"
#include "faces/face_database.h"
#include "faces/face_gaussian.h"

#include <span>
#include <vector>

namespace daumier::datasets {

struct FittedBilinear {
  faces::BilinearModel model;
  std::vector<int> identities;  ///< TrainingIdentities.
  /// Which faces were read: {num_faces, num_persons, persons, faces_checksum} as in SplitToJson, and num_identities.
  Json proof;
};

/// person * num_levels + level of every pair that has a training face in the grid, ascending: the rows of the identity
/// factors that are fitted below.
std::vector<int> TrainingIdentities(const faces::FaceDatabase& database, const Split& split);

/// Fits the bilinear model to all coordinates of the split's training faces of the grid; no other face is read.
/// Identities are the pairs of person and level that have a training face; faces of theirs that are held out (split
/// "random") are imputed as FitBilinear describes.
/// @throws Error as FitBilinear, Cancelled as well.
FittedBilinear FitOnTraining(const faces::FaceDatabase& database, const Split& split,
                             const faces::BilinearOptions& options, const Task& task = {});

/// The same of the 2-D points on silhouette and feature lines, SketchDatabase::feature_curves, in pixels of the 256
/// canvas: the model behind the shape-level input [Han et al. 2017, section 4.3], which faces::CurveEncoder encodes.
/// @throws Error as FitBilinear, or if the sketches belong to other faces.
FittedBilinear FitCurvesOnTraining(const faces::FaceDatabase& database, const SketchDatabase& sketches,
                                   const Split& split, const faces::BilinearOptions& options, const Task& task = {});

/// A linear basis of at most 600 training faces of the grid, drawn by a stream of the seed, and their distance from the
/// faces that the bilinear model of FitOnTraining makes of their own u and v. @throws Error as faces::FitFaceBasis.
faces::FaceBasis FitBasisOnTraining(const faces::FaceDatabase& database, const Split& split,
                                    const faces::BilinearModel& bilinear, int size, uint64_t seed,
                                    const Task& task = {});

/// The basis of all faces of a normal distribution (faces::BasisOf), and the distance of such faces from those of the
/// bilinear model.
faces::FaceBasis GaussianBasisOnTraining(const faces::FaceDatabase& database, const Split& split,
                                         const faces::BilinearModel& bilinear, const faces::FaceGaussian& gaussian,
                                         uint64_t seed, const Task& task = {});

/// The normal distribution of at most 1,200 training faces, evenly spaced. @throws Error as faces::FitFaceGaussian.
faces::FaceGaussian FitGaussianOnTraining(const faces::FaceDatabase& database, const Split& split,
                                          const faces::FaceGaussianOptions& options, const Task& task = {});

}  // namespace daumier::datasets
