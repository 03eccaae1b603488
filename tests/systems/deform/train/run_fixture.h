#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "datasets/read/splits.h"
#include "systems/deform/train/run.h"
#include "tensor/eigen.h"
#include "tensor/module_state.h"
#include "tests/support/small_deform.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

namespace daumier::deform {

/// An untrained deformable model of six synthetic persons, in a run folder as a training leaves it.
class DeformRunFixture : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    WriteRun(*folder_ / "run");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void WriteRun(const std::filesystem::path& run) {
    const faces::FaceDatabase faces(*folder_ / "faces");
    const datasets::SplitOptions split_options{.validation = 0.2, .test = 0.3};
    const datasets::Split split = datasets::MakeSplit(faces, split_options, 7);
    const faces::ModelFrame frame = faces::HeadFrame(faces.face_template(), 2.1);
    const geometry::Points vertices = frame.FromCm(faces.face_template().neutral);
    AutoDecoder decoder(
        testing::SmoothDeformNetwork("hypernetwork", tensor::CopyToTensor(vertices).to(torch::kFloat32), frame),
        int64_t(split.train.size()));
    const Json config = {{"system", kSystem},
                         {"data", {{"faces", (*folder_ / "faces").string()}, {"points", ""}}},
                         {"split", ToJson(split_options)},
                         {"network", ToJson(decoder.network()->options())},
                         {"loss", {{"data_weight", 3e3}, {"code_weight", 1.0}}},
                         {"seed", 7}};
    MakeDirectory(run / "best");
    WriteFileAtomically(run / "resolved.toml", ToToml(config));
    tensor::SaveModule(run / "best" / "model.safetensors", decoder);
    Manifest manifest;
    manifest.kind = "run";
    manifest.verb = "train";
    manifest.seed = 7;
    manifest.counts = {{"training_faces", split.train.size()}};
    manifest.details = {{"system", kSystem},
                        {"data", {{"faces", DataHash(*folder_ / "faces")}}},
                        {"split", datasets::SplitToJson(faces, split)}};
    manifest.sources = faces.manifest().sources;
    manifest.checksums = faces::WriteFaceTemplate(run, faces.face_template());
    WriteManifest(run, manifest);
  }

  inline static std::unique_ptr<testing::TempDir> folder_;
};

}  // namespace daumier::deform
