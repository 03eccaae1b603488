#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "faces/face_database.h"
#include "models/sketch_network.h"
#include "tensor/module_state.h"
#include "tests/support/random_bilinear.h"
#include "tests/support/synthetic_face.h"

#include <torch/torch.h>

namespace daumier::testing {

/// Writes the run folder of a small, untrained sketch network on the synthetic face: 32 x 32 sketches, 6 identity and 3
/// expression weights. Its batch norms have moved, so that no buffer has its starting value.
inline models::SketchNetwork WriteSketchRun(const std::filesystem::path& directory) {
  const auto face_template = SyntheticFace();
  const auto bilinear = RandomBilinear(face_template.num_vertices(), 6, 3, 1);
  const models::PixelCnnOptions options{.resolution = 32, .width = 4, .hidden = 16};
  torch::manual_seed(7);
  models::SketchNetwork network(options, bilinear);
  network->forward((torch::rand({16, 1, 32, 32}) < 0.1).to(torch::kFloat32));
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
  manifest.checksums = faces::WriteFaceTemplate(directory, face_template);
  manifest.checksums["bilinear.safetensors"] = faces::WriteBilinearModel(directory / "bilinear.safetensors", bilinear);
  WriteManifest(directory, manifest);
  tensor::SaveModule(directory / "best" / "model.safetensors", *network);
  return network;
}

}  // namespace daumier::testing
