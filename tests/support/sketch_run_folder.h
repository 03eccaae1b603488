#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "faces/face_database.h"
#include "render/camera_json.h"
#include "systems/sketch/train/run.h"
#include "tensor/module_state.h"
#include "tests/support/plain_gaussian.h"
#include "tests/support/sketch_networks.h"
#include "tests/support/synthetic_face.h"

#include <torch/utils.h>

namespace daumier::testing {

/// Writes the run folder of a small, untrained sketch network on the synthetic face, a compact one of 32 x 32 sketches
/// or another of SmallSketchNetworks, with 6 identity and 3 expression weights. Its batch norms have moved, so that no
/// buffer has its starting value.
inline sketch::SketchNetwork WriteSketchRun(const std::filesystem::path& directory,
                                            const std::string& kind = "compact") {
  const auto face_template = SyntheticFace();
  const sketch::SketchNetworkOptions options = SmallSketchNetworks().at(kind);
  sketch::FittedModels models = RandomModels(face_template.num_vertices(), options.residual);
  models.gaussian = PlainGaussian(face_template);
  torch::manual_seed(7);
  sketch::SketchNetwork network(options, models);
  network->forward(RandomSketchInput(options, 16));
  network->eval();

  MakeDirectory(directory / "best");
  WriteFileAtomically(directory / "resolved.toml", ToToml({{"network", ToJson(options)}}));
  Manifest manifest;
  manifest.kind = "run";
  manifest.verb = "train";
  manifest.seed = 7;
  manifest.config = {{"network", ToJson(options)}};
  manifest.sources =
      Json::array({{{"name", "synthetic"}, {"version", "1"}, {"checksum", "0"}, {"licence", "CC0-1.0"}}});
  manifest.counts = {{"train", 16}};
  manifest.details = {{"sketches",
                       {{"camera", render::CameraToJson(render::FrontalCamera({0, 0, 0}, 12, 256))},
                        {"feature_curves", {"upper_mouth"}}}}};
  manifest.checksums = faces::WriteFaceTemplate(directory, face_template);
  manifest.checksums.merge(sketch::WriteFittedModels(directory, models));
  WriteManifest(directory, manifest);
  tensor::SaveModule(directory / "best" / "model.safetensors", *network);
  return network;
}

}  // namespace daumier::testing
