#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "faces/face_database.h"
#include "systems/deform/train/run.h"
#include "tensor/eigen.h"
#include "tensor/module_state.h"
#include "tests/support/deform_networks.h"
#include "tests/support/synthetic_face.h"

#include <filesystem>
#include <memory>
#include <string>
#include <torch/utils.h>

namespace daumier::testing {

/// Writes the run folder of a small, untrained deformable model on the synthetic face, as a training leaves it, with
/// codes of three faces.
inline std::shared_ptr<deform::AutoDecoder> WriteDeformRun(const std::filesystem::path& run, const std::string& kind) {
  const faces::FaceTemplate face_template = SyntheticFace();
  const faces::ModelFrame frame = faces::HeadFrame(face_template, 2.1);
  torch::manual_seed(2);
  const auto decoder = std::make_shared<deform::AutoDecoder>(
      deform::MakeDeformNetwork(SmallDeformOptions(kind), tensor::CopyToTensor(frame.FromCm(face_template.neutral)),
                                frame),
      3);
  MakeDirectory(run / "best");
  WriteFileAtomically(run / "resolved.toml", ToToml({{"system", "deform"},
                                                     {"network", ToJson(decoder->network()->options())},
                                                     {"loss", {{"data_weight", 2e3}, {"code_weight", 5e5}}}}));
  Manifest manifest;
  manifest.kind = "run";
  manifest.verb = "train";
  manifest.sources = {{{"name", "synthetic"}, {"licence", "CC0"}}};
  manifest.counts = {{"training_faces", 3}};
  manifest.details = {{"product", "deform"}};
  manifest.checksums = faces::WriteFaceTemplate(run, face_template);
  manifest.checksums["best/model.safetensors"] = tensor::SaveModule(run / "best/model.safetensors", *decoder);
  WriteManifest(run, manifest);
  return decoder;
}

}  // namespace daumier::testing
