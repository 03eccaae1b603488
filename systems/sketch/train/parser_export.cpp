#include "systems/sketch/train/parser_export.h"

#include "core/weights_folder.h"
#include "datasets/styles/styled_dataset.h"
#include "export/onnx_graph.h"
#include "export/torch_runner.h"
#include "export/weights.h"
#include "render/strokes.h"
#include "systems/sketch/stroke_network.h"
#include "systems/sketch/train/parser_network.h"
#include "systems/sketch/train/parser_run.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace daumier::sketch {
namespace {

/// Pictures of random polylines.
torch::Tensor RandomDrawings(int64_t batch, int side, Rng& rng) {
  constexpr int kStrokes = 24, kPoints = 8;
  torch::Tensor pictures = torch::empty({batch, 1, side, side});
  for (int64_t b = 0; b < batch; ++b) {
    std::vector<render::Stroke> strokes(kStrokes);
    for (render::Stroke& stroke : strokes) {
      float x = float(rng.Uniform(20, 236)), y = float(rng.Uniform(20, 236));
      for (int p = 0; p < kPoints; ++p) {
        stroke.points.push_back({x, y});
        x += float(8 * rng.Normal());
        y += float(8 * rng.Normal());
      }
    }
    std::ranges::copy(InkOf(strokes, side), pictures[b].data_ptr<float>());
  }
  return pictures;
}

template <class Names>
std::string Joined(const Names& names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::string InputsAndOutputs(const ParserNetworkOptions& options) {
  return fmt::format(
      "| name | shape | meaning |\n|---|---|---|\n"
      "| `pictures` | ({0}, 1, {1}, {1}) float32 | drawings of one face, ink 1, paper 0, row 0 on top; lines {2:.1f} "
      "pixels wide, antialiased |\n"
      "| `heat_maps` | ({0}, {3}, {4}, {4}) float32 | scores of each point; the softmax over a map is the distribution "
      "of its place, cells of 4 pixels: {5} |\n"
      "| `labels` | ({0}, {6}, {7}, {7}) float32 | scores of what a line shows, cells of 2 pixels, to be read where "
      "there is ink: {8} |\n"
      "| `states` | ({0}, 11) float32 | scores of the mouth ({9}), the right eye and the left eye ({10} each), the "
      "view ({11}) |\n\n"
      "{0} is any batch size. All scores are without softmax.\n\n",
      exporting::kBatchDimension, options.resolution,
      render::StrokeStyle().width * options.resolution / render::kSketchCanvas, faces::kNumFacePoints,
      options.map_side(), Joined(faces::kFacePointNames), faces::kNumLineLabels, options.label_side(),
      Joined(faces::kLineLabelNames), Joined(faces::kMouthStateNames), Joined(faces::kEyeStateNames),
      Joined(faces::kDrawnViewNames));
}

}  // namespace

exporting::ExportedFunction ParserFunction(models::HeatMapUnet network, const ParserNetworkOptions& options) {
  const int side = options.resolution;
  return {.name = "drawing_parser",
          .inputs = {{"pictures",
                      {1, side, side},
                      [side](int64_t batch, Rng& rng) { return RandomDrawings(batch, side, rng); },
                      /*batched=*/true,
                      "random polylines"}},
          .output_names = {"heat_maps", "labels", "states"},
          .forward = [network](const std::vector<torch::Tensor>& inputs) mutable {
            const models::HeatMapOutputs outputs = network->forward(inputs[0]);
            return std::vector<torch::Tensor>{outputs.heat_maps, outputs.labels, outputs.states};
          }};
}

exporting::NetworkFunction MakeParserFunction(const Json& network) {
  const auto options = ParseOptions<ParserNetworkOptions>(network, "the network of shipped weights");
  const models::HeatMapUnet module = MakeParserNetwork(options);
  return {module.ptr(), ParserFunction(module, options)};
}

exporting::RunExport DescribeParserExport(const std::filesystem::path& run_directory) {
  const ParserRun run = LoadParserRun(run_directory);
  return {.run_directory = run_directory,
          .run_manifest = run.manifest,
          .module = run.network.ptr(),
          .function = ParserFunction(run.network, run.network_options),
          .card = {.title = "Parser of face drawings",
                   .summary = fmt::format(
                       "A U-Net with {} parameters that reads a line drawing of a face: 26 points, what each line "
                       "shows, whether mouth and eyes are open, and the view; trained and exported by Daumier.",
                       run.network->num_parameters()),
                   .inputs_and_outputs = InputsAndOutputs(run.network_options),
                   .limits = {"It was trained on drawings that a program made of synthetic faces, not on drawings by "
                              "people.",
                              "It expects one face; a drawing of something else is parsed as if it were one.",
                              "It must not be used to identify or to judge people."}},
          .counts = {{"parameters", run.network->num_parameters()}},
          .for_weights = exporting::RunExport::ForWeights{.network = ToJson(run.network_options), .write_rest = {}}};
}

DrawingParser OpenParserOfRun(const std::filesystem::path& run_or_weights) {
  const ParserNetworkOptions options = ReadParserNetworkOptions(run_or_weights);
  exporting::NetworkFunction network =
      IsWeightsFolder(run_or_weights)
          ? exporting::ReadWeightsNetwork(run_or_weights, ReadManifest(run_or_weights, kWeightsKind).details,
                                          MakeParserFunction)
          : NetworkOf(DescribeParserExport(run_or_weights));
  return {options, std::make_shared<exporting::TorchRunner>(std::move(network), torch::kCPU)};
}

}  // namespace daumier::sketch
