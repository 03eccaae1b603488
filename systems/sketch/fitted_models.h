#pragma once
#include "faces/bilinear_model.h"
#include "faces/face_basis.h"
#include "faces/face_gaussian.h"

#include <filesystem>
#include <map>
#include <string>

namespace daumier::sketch {

/// The models whose coefficients a network reads and predicts, fitted on training faces.
struct FittedModels {
  faces::BilinearModel bilinear;      ///< Of faces: what u and v mean.
  faces::BilinearModel curves;        ///< Of 2-D feature curves: what the shape-level numbers mean.
  faces::FaceBasis basis;             ///< Of networks with a residual alone; else empty.
  faces::FaceGaussian gaussian = {};  ///< What a fit to a drawing starts from; of runs before 0.3.0 empty.
};

/// Files of the fitted models in a folder of a run, as names and checksums.
std::map<std::string, std::string> WriteFittedModels(const std::filesystem::path& directory,
                                                     const FittedModels& models);
/// Undoes WriteFittedModels; basis and Gaussian are empty where there is none. @throws Error naming file and cause.
FittedModels ReadFittedModels(const std::filesystem::path& directory);

}  // namespace daumier::sketch
