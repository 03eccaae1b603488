#include "cli/weights_model.h"

#include "core/error.h"
#include "core/weights_folder.h"
#include "faces/face_model_file.h"

namespace daumier::cli {

faces::FaceModel FaceModelNextTo(const std::filesystem::path& weights, const std::string& source) {
  const std::filesystem::path folder = WeightsNextTo(weights, "face-" + source);
  if (!IsWeightsFolder(folder))
    throw Error(fmt::format("{}: there is no face model of '{}' with its expressions (expected shipped weights in {})",
                            weights.string(), source, folder.string()));
  return faces::ReadFaceModelWeights(folder, source);
}

}  // namespace daumier::cli
