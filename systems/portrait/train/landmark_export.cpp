#include "systems/portrait/train/landmark_export.h"

#include "export/onnx_graph.h"
#include "systems/portrait/landmark_crop.h"
#include "systems/portrait/landmark_sample.h"
#include "systems/portrait/train/export_samples.h"
#include "systems/portrait/train/landmark_network.h"
#include "systems/portrait/train/landmark_run.h"

#include <algorithm>
#include <memory>

namespace daumier::portrait {
namespace {

/// Flat squares and noise: numbers of a picture.
torch::Tensor RandomPictures(int64_t batch, int resolution, Rng& rng) {
  torch::Tensor pictures = torch::empty({batch, 3, resolution, resolution});
  float* const numbers = pictures.data_ptr<float>();
  constexpr int64_t kSquare = 8;
  double value = 0;
  for (int64_t i = 0; i < pictures.numel(); ++i) {
    if (i % kSquare == 0) value = rng.Uniform();
    numbers[i] = float(std::clamp(value + 0.1 * rng.Normal(), 0.0, 1.0));
  }
  return pictures;
}

std::string LandmarkInputsAndOutputs(int resolution) {
  return fmt::format(
      "| name | shape | meaning |\n|---|---|---|\n"
      "| `pictures` | ({0}, 3, {1}, {1}) float32 | square crops, RGB of 0..1 as stored (sRGB), row 0 on top; the box "
      "of "
      "the face's 68 landmarks centred, its longer side 1/{2} of the crop's |\n"
      "| `heat_maps` | ({0}, {3}, {4}, {4}) float32 | scores of each landmark (iBUG order); the softmax over a map is "
      "the distribution of its place, cells of 4 pixels |\n"
      "| `labels` | ({0}, {5}, {6}, {6}) float32 | scores of classes: background, skin, brows, eyes, lips, mouth "
      "inside, ears, hair; cells of 2 pixels |\n"
      "| `states` | ({0}, {7}) float32 | scores of no and yes: is a face, right eye closed, left eye closed, mouth "
      "open "
      "|\n"
      "| `boxes` | ({0}, 5, {8}, {8}) float32 | search, also in pictures of which faces are a small part: score (its "
      "sigmoid is the confidence), centre's offset from the cell's centre and logarithms of width and height, in cells "
      "of 8 pixels |\n\n"
      "{0} is any batch size. All scores are without softmax or sigmoid.\n\n",
      exporting::kBatchDimension, resolution, kCropSide, kNumLandmarks, resolution / 4, kNumPictureClasses,
      resolution / 2, 2 * kNumFaceStates, resolution / 8);
}

}  // namespace

exporting::ExportedFunction LandmarkFunction(models::HeatMapUnet network, int resolution) {
  return {.name = "landmarks",
          .inputs = {{"pictures",
                      {3, resolution, resolution},
                      [resolution](int64_t batch, Rng& rng) { return RandomPictures(batch, resolution, rng); },
                      /*batched=*/true,
                      "random squares and noise"}},
          .output_names = {"heat_maps", "labels", "states", "boxes"},
          .forward = [network](const std::vector<torch::Tensor>& inputs) mutable {
            const models::HeatMapOutputs outputs = network->forward(inputs[0]);
            return std::vector<torch::Tensor>{outputs.heat_maps, outputs.labels, outputs.states, outputs.boxes};
          }};
}

exporting::NetworkFunction MakeLandmarkFunction(const Json& network) {
  const auto options = ParseOptions<LandmarkNetworkOptions>(network, "the network of shipped weights");
  const models::HeatMapUnet module = MakeLandmarkNetwork(options);
  return {module.ptr(), LandmarkFunction(module, options.resolution)};
}

exporting::RunExport DescribeLandmarkExport(const std::filesystem::path& run_directory) {
  const LandmarkRun run = LoadLandmarkRun(run_directory);
  const int resolution = run.network_options.resolution;
  const auto folder = std::make_shared<const LandmarkRunFolder>(run);
  return {
      .run_directory = run_directory,
      .run_manifest = run.manifest,
      .module = run.network.ptr(),
      .function = LandmarkFunction(run.network, resolution),
      .card = {.title = "Landmarks and parsing of portraits",
               .summary = fmt::format(
                   "A U-Net with {} parameters that finds faces in pictures, 68 landmarks of each, the class of each "
                   "pixel, and whether eyes and mouth are open; trained and exported by Daumier.",
                   run.network->num_parameters()),
               .inputs_and_outputs = LandmarkInputsAndOutputs(resolution),
               .limits = {"It was trained on portraits that a program rendered, not on pictures by people.",
                          "Faces in full profile and upside down are not among its training data.",
                          "It must not be used to identify or to judge people."}},
      .counts = {{"parameters", run.network->num_parameters()}},
      .for_weights = exporting::RunExport::ForWeights{.network = ToJson(run.network_options), .write_rest = {}},
      .find_samples = [folder](exporting::ExportedFunction& function) { SampleLandmarkCrops(*folder, function); }};
}

}  // namespace daumier::portrait
