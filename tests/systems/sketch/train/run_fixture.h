#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "datasets/read/sketch_variation.h"
#include "datasets/read/training_fit.h"
#include "render/camera_json.h"
#include "systems/sketch/train/run.h"
#include "tensor/module_state.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <filesystem>
#include <memory>

namespace daumier::sketch {

/// An untrained network on six synthetic persons, in a run folder as a training leaves it.
class SketchRunFixture : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
    WriteRun(*folder_ / "run");
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void WriteRun(const std::filesystem::path& run,
                       const SketchNetworkOptions& network_options = {
                           .resolution = 32, .width = 8, .hidden = 16, .branch = 16}) {
    const faces::FaceDatabase faces(*folder_ / "faces");
    const datasets::SplitOptions split_options;
    const datasets::Split split = datasets::MakeSplit(faces, split_options, 7);
    const faces::BilinearOptions bilinear{.num_identity = 6, .num_expression = 4};
    const datasets::SketchDatabase sketches(*folder_ / "sketches");
    const datasets::FittedBilinear fitted = datasets::FitOnTraining(faces, split, bilinear);
    const FittedModels models{
        fitted.model,
        datasets::FitCurvesOnTraining(faces, sketches, split, bilinear).model,
        {},
        datasets::FitGaussianOnTraining(faces, split, {.num_symmetric = 12, .num_asymmetric = 4})};
    torch::manual_seed(7);
    SketchNetwork network(network_options, models);
    std::vector<std::string> curves;
    for (const int curve : sketches.feature_curves()) curves.push_back(sketches.curve_names()[size_t(curve)]);
    const Json config = {
        {"data", {{"faces", (*folder_ / "faces").string()}, {"sketches", (*folder_ / "sketches").string()}}},
        {"split", ToJson(split_options)},
        {"bilinear", ToJson(bilinear)},
        {"sketch", ToJson(datasets::SketchVariation())},
        {"network", ToJson(network_options)},
        {"seed", 7}};
    MakeDirectory(run / "best");
    WriteFileAtomically(run / "resolved.toml", ToToml(config));
    Manifest manifest;
    manifest.kind = "run";
    manifest.verb = "train";
    manifest.seed = 7;
    manifest.details = {
        {"data", {{"faces", DataHash(*folder_ / "faces")}, {"sketches", DataHash(*folder_ / "sketches")}}},
        {"split", datasets::SplitToJson(faces, split)},
        {"bilinear", fitted.proof},
        {"sketches", {{"camera", render::CameraToJson(sketches.camera())}, {"feature_curves", curves}}}};
    manifest.sources = faces.manifest().sources;
    manifest.checksums = faces::WriteFaceTemplate(run, faces.face_template());
    manifest.checksums.merge(WriteFittedModels(run, models));
    WriteManifest(run, manifest);
    tensor::SaveModule(run / "best" / "model.safetensors", *network);
  }

  inline static std::unique_ptr<testing::TempDir> folder_;
};

}  // namespace daumier::sketch
