#pragma once
#include "core/config.h"
#include "datasets/read/run_data.h"
#include "systems/portrait/train/portrait_loss.h"
#include "systems/portrait/train/portrait_prediction.h"
#include "systems/portrait/train/portrait_training.h"
#include "tests/support/small_portraits.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <memory>

/// What tests of portrait networks share: portraits of the synthetic face, a batch of them, and a finished run.
namespace daumier::testing {

/// `faces`: four persons; `portraits`: two portraits of each. Made once a program.
inline const TempDir& SmallPortraitFolder() {
  static const std::unique_ptr<TempDir> folder = [] {
    auto made = std::make_unique<TempDir>();
    BuildSyntheticFaces(*made / "faces", 4);
    WriteSmallPortraits(*made / "faces", *made / "portraits", 2);
    return made;
  }();
  return *folder;
}

/// The coefficients (239) by which those portraits were drawn.
inline std::vector<std::vector<float>> TrueCoefficients() {
  const faces::MorphableModel model = SyntheticMorphable();
  Rng rng(kSmallPortraitSeed);
  std::vector<std::vector<float>> coefficients;
  for (int i = 0; i < 8; ++i) coefficients.push_back(DrawPortrait(model, rng));
  return coefficients;
}

/// A small network, and pictures as they are: neither cropped nor changed.
inline portrait::PortraitTrainingOptions SmallPortraitOptions() {
  portrait::PortraitTrainingOptions options;
  options.network = {.depth = 18, .resolution = 64, .width = 8};
  options.pictures.crop = "none";
  options.pictures.shift = options.pictures.scale = options.pictures.rotation = options.pictures.colour = 0;
  return options;
}

inline Json SmallPortraitConfig(const std::filesystem::path& faces, const std::filesystem::path& portraits) {
  return {{"system", portrait::kPortraitSystem},
          {"data", {{"faces", faces.string()}, {"portraits", portraits.string()}}},
          {"network", {{"depth", 18}, {"resolution", 32}, {"width", 8}}},
          {"epochs", 1},
          {"batch", 2}};
}

/// Trains on SmallPortraitFolder for an epoch, in `run`. No source that has a name holds the synthetic face; so the folder
/// is at first that of a training that was stopped before its first step, with its 3DMM, and is then resumed.
inline TrainingSummary TrainSmallPortrait(const std::filesystem::path& run) {
  const std::filesystem::path data = SmallPortraitFolder().path();
  const Json config = SmallPortraitConfig(data / "faces", data / "portraits");
  FolderCache databases;
  if (!std::filesystem::exists(run / "manifest.json")) {
    const auto options = ParseTraining<portrait::PortraitTrainingOptions>(config, "config");
    Json stored = ToJson(options);
    for (const char* key : {"data", "real"}) stored.erase(key);
    for (const char* key : {"path", "annotation", "template_mesh"}) stored.at("source").erase(key);
    const auto& people = databases.Open<faces::FaceDatabase>(data / "faces");
    Manifest manifest = datasets::ManifestOfTraining(stored, options.seed, people,
                                                     datasets::MakeSplit(people, options.split, options.seed));
    manifest.details["system"] = portrait::kPortraitSystem;
    manifest.details["data"] = {{"faces", DataHash(data / "faces")}, {"portraits", DataHash(data / "portraits")}};
    MakeDirectory(run);
    manifest.checksums = faces::WriteMorphableFiles(run, SyntheticMorphable());
    WriteFileAtomically(run / "resolved.toml", ToToml(ToJson(options)));
    WriteManifest(run, manifest);
  }
  return portrait::TrainPortrait(config, {run, true, {}}, databases, {});
}

/// The folder of a finished run of TrainSmallPortrait, trained once a program. It is not to be changed.
inline std::filesystem::path SmallPortraitRun() {
  static const std::unique_ptr<TempDir> folder = [] {
    auto made = std::make_unique<TempDir>();
    TrainSmallPortrait(*made / "run");
    return made;
  }();
  return *folder / "run";
}

inline torch::Tensor AsTensor(const std::vector<float>& numbers, std::vector<int64_t> shape) {
  return torch::tensor(numbers).view(shape);
}

/// Two faces that the model itself drew, with guesses of their coefficients. Of the first the face is known.
struct LossProblem {
  faces::MorphableModel model = SyntheticMorphable();
  torch::Tensor truth, guess;
  train::Batch batch;
};

inline LossProblem MakeLossProblem(torch::ScalarType type) {
  LossProblem problem;
  const portrait::FacePainter painter(problem.model);
  Rng rng(21);
  std::vector<torch::Tensor> truth, guess, landmarks, pictures, skin, vertices;
  for (int b = 0; b < 2; ++b) {
    const std::vector<float> x = DrawPortrait(problem.model, rng);
    std::vector<float> y = x;
    const std::vector<float> other = DrawPortrait(problem.model, rng);
    for (size_t k = 0; k < y.size(); ++k) y[k] += 0.15F * (other[k] - x[k]);
    const portrait::FacePicture face = painter.Paint(x);
    truth.push_back(AsTensor(x, {1, faces::kNumCoefficients}));
    guess.push_back(AsTensor(y, {1, faces::kNumCoefficients}));
    landmarks.push_back(AsTensor(face.landmarks, {1, 68, 2}));
    const torch::Tensor rgba = AsTensor(face.colours, {1, 224, 224, 4}).permute({0, 3, 1, 2});
    pictures.push_back(rgba.narrow(1, 0, 3));
    skin.push_back((rgba.narrow(1, 3, 1) > 0.999).to(torch::kFloat32));
    const geometry::Points points = faces::Reconstruct(problem.model, x).vertices;
    vertices.push_back(AsTensor({points.data(), points.data() + points.size()}, {1, points.rows(), 3}));
  }
  problem.truth = torch::cat(truth).to(type);
  problem.guess = torch::cat(guess).to(type);
  problem.batch.tensors = {{"landmarks", torch::cat(landmarks)},
                           {"landmark_weights", torch::ones({2, 68})},
                           {"picture", torch::cat(pictures).contiguous()},
                           {"skin", torch::cat(skin).contiguous()},
                           {"vertices", torch::cat(vertices)},
                           {"known", torch::tensor({1.F, 0.F})},
                           {"expression", problem.truth.slice(1, 80, 144)},
                           {"albedo", problem.truth.slice(1, 144, 224)},
                           {"light", problem.truth.slice(1, 224, 233)},
                           {"angles", problem.truth.slice(1, 233, 236)}};
  for (auto& [name, tensor] : problem.batch.tensors) tensor = tensor.to(type).contiguous();
  return problem;
}

}  // namespace daumier::testing
