#include "systems/sketch/train/gesture_export.h"

#include "datasets/gestures/gesture_strokes.h"
#include "export/onnx_graph.h"
#include "systems/sketch/gesture_recogniser.h"
#include "systems/sketch/train/gesture_network.h"
#include "systems/sketch/train/gesture_run.h"

namespace daumier::sketch {
namespace {

/// Pictures of generated gestures.
torch::Tensor GesturePictures(int64_t batch, const datasets::GestureRaster& raster, Rng& rng) {
  torch::Tensor pictures = torch::empty({batch, 1, raster.side, raster.side});
  const auto strokes = datasets::StrokesOfHand({}, {.per_gesture = 1, .none = 10}, rng.Bits() >> 12, 0);
  for (int64_t b = 0; b < batch; ++b)
    datasets::RasteriseGesture(strokes[rng.Below(strokes.size())].points, raster,
                               {pictures[b].data_ptr<float>(), size_t(raster.side) * size_t(raster.side)});
  return pictures;
}

std::string GestureNames() {
  std::string text;
  for (int i = 0; i < kNumGestureClasses; ++i) text += (i > 0 ? ", " : "") + NameOf(datasets::Gesture(i));
  return text;
}

std::string GestureInputsAndOutputs(const datasets::GestureRaster& raster) {
  return fmt::format(
      "| name | shape | meaning |\n|---|---|---|\n"
      "| `pictures` | ({0}, 1, {1}, {1}) float32 | one stroke, ink 1, paper 0, row 0 on top; its bounding box centred, "
      "the longer side {2:g} of the picture's; line {3:g} pixels wide, {4} |\n"
      "| `scores` | ({0}, {5}) float32 | scores without softmax of {6} |\n\n"
      "{0} is any batch size.\n\n",
      exporting::kBatchDimension, raster.side, 1 - 2 * datasets::kRasterMargin, raster.width,
      raster.binary ? "not antialiased" : "antialiased", kNumGestureClasses, GestureNames());
}

}  // namespace

exporting::ExportedFunction GestureFunction(torch::nn::Sequential network, const GestureNetworkOptions& options) {
  const datasets::GestureRaster raster = options.raster();
  return {.name = kGestureSystem,
          .inputs = {{"pictures",
                      {1, raster.side, raster.side},
                      [raster](int64_t batch, Rng& rng) { return GesturePictures(batch, raster, rng); },
                      /*batched=*/true,
                      "generated strokes"}},
          .output_names = {"scores"},
          .forward = [network](const std::vector<torch::Tensor>& inputs) mutable {
            return std::vector<torch::Tensor>{network->forward(inputs[0])};
          }};
}

exporting::NetworkFunction MakeGestureFunction(const Json& network) {
  const auto options = ParseOptions<GestureNetworkOptions>(network, "the network of shipped weights");
  const torch::nn::Sequential module = MakeGestureNetwork(options);
  return {module.ptr(), GestureFunction(module, options)};
}

exporting::RunExport DescribeGestureExport(const std::filesystem::path& run_directory) {
  const GestureRun run = LoadGestureRun(run_directory);
  const int64_t num_parameters = NumParameters(*run.network);
  const Json rejection = run.manifest.details.value("rejection", Json());
  return {.run_directory = run_directory,
          .run_manifest = run.manifest,
          .module = run.network.ptr(),
          .function = GestureFunction(run.network, run.network_options),
          .card = {.title = "Classifier of pen gestures",
                   .summary = fmt::format(
                       "A convolutional network ({}) with {} parameters that reads the picture of one stroke: which of "
                       "ten gestures it is, or none; trained and exported by Daumier.",
                       run.network_options.kind, num_parameters),
                   .inputs_and_outputs = GestureInputsAndOutputs(run.network_options.raster()),
                   .limits = {"It was trained on strokes that a program made, not on strokes by people.",
                              "A stroke counts as none where the likeliest gesture has a probability below the "
                              "threshold of `details.rejection`."}},
          .counts = {{"parameters", num_parameters}},
          .details = {{"rejection", rejection}},
          .for_weights = exporting::RunExport::ForWeights{
              .network = ToJson(run.network_options),
              .write_rest = [rejection](const std::filesystem::path&, const std::filesystem::path&) {
                return WeightsParts{.details = {{"rejection", rejection}}};
              }}};
}

}  // namespace daumier::sketch
