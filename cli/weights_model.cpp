#include "cli/weights_model.h"

#include "core/error.h"
#include "core/weights_folder.h"
#include "faces/face_model_file.h"

#include <algorithm>
#include <string>

namespace daumier::cli {

faces::FaceModel FaceModelOfWeights(const std::filesystem::path& weights) {
  const Manifest manifest = ReadWeightsManifest(weights);
  const Json needs = manifest.details.value("needs", Json::object());
  for (const auto& [name, hash] : needs.items())
    if (name.starts_with("face-")) return faces::ReadFaceModelWeights(NeededWeights(weights, manifest, name));
  throw Error(fmt::format("{}: these weights name no face model (details.needs of manifest.json)", weights.string()));
}

}  // namespace daumier::cli
