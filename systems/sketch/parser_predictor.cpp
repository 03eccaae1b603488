#include "systems/sketch/parser_predictor.h"

#include "core/error.h"
#include "systems/open_network.h"
#include "systems/predict_each.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/input_drawing.h"
#include "systems/sketch/parsed_face.h"
#include "systems/sketch/parser_overlay.h"
#include "systems/sketch/parser_run_folder.h"

namespace daumier::sketch {
namespace {

constexpr int kPictureSide = 512;

template <size_t N>
Json ClassesToJson(const std::array<double, N>& probabilities, const std::array<std::string_view, N>& names) {
  Json json = Json::object();
  for (size_t i = 0; i < N; ++i) json[std::string(names[i])] = probabilities[i];
  return json;
}

std::filesystem::path NamedParser(const std::string& name, std::span<const systems::ShippedWeights> shipped,
                                  std::span<const std::filesystem::path> places) {
  try {
    return systems::WeightsNamed(name, shipped, places);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("parser={} is no folder of a run or weights, and no name of shipped weights: {}", name,
                                 error.what()));
  }
}

}  // namespace

Json ParsedToJson(const ParsedDrawing& drawing) {
  Json points = Json::object();
  for (size_t i = 0; i < drawing.points.size(); ++i)
    points[std::string(faces::kFacePointNames[i])] = {{"at", {drawing.points[i].x(), drawing.points[i].y()}},
                                                      {"confidence", drawing.confidences[i]}};
  return {{"points", points},
          {"mouth", ClassesToJson(drawing.mouth, faces::kMouthStateNames)},
          {"eye_right", ClassesToJson(drawing.eyes[0], faces::kEyeStateNames)},
          {"eye_left", ClassesToJson(drawing.eyes[1], faces::kEyeStateNames)},
          {"view", ClassesToJson(drawing.view, faces::kDrawnViewNames)}};
}

std::vector<systems::FaceResult> ParserPredictor::Predict(std::span<const systems::Input> inputs,
                                                          const Task& task) const {
  return systems::PredictEach(inputs, task, "drawings", [&](const systems::Input& input) {
    const render::Drawing drawing = DrawingOf(input);
    const ParsedDrawing parsed = parser_.Parse(drawing.strokes);
    systems::FaceResult result;
    result.record = ParsedToJson(parsed);
    result.warnings = ParseWarnings(parsed);
    if (drawing.picture_from_sheet)
      result.record["picture_from_sheet"] = render::HomographyToJson(*drawing.picture_from_sheet);
    result.files = {{".json", result.record.dump(1) + "\n"}};
    result.pictures = {{ParsedPicture(parsed, FrameOfWhole(parsed.strokes), kPictureSide), "parsing"}};
    return result;
  });
}

std::filesystem::path ParserFolder(const std::string& name) {
  if (!name.empty() && std::filesystem::is_directory(name)) return name;
  const std::vector<std::filesystem::path> places = systems::WeightsPlaces();
  const std::vector<systems::ShippedWeights> shipped = systems::ListWeights(places);
  if (!name.empty()) return NamedParser(name, shipped, places);
  for (const systems::ShippedWeights& weights : shipped)
    if (weights.system == kParserSystem) return weights.directory;
  throw UsageError(fmt::format(
      "drawings are read by a parser, and there are no shipped weights of one in {}. Set DAUMIER_WEIGHTS to "
      "their folder, give parser=RUN (configs/sketch/parser.toml), or predict sketches of the training's "
      "own frame by --keep-frame",
      places.empty() ? std::string("any folder") : places.front().string()));
}

DrawingParser OpenDrawingParser(const std::filesystem::path& run_or_weights, const Device& device,
                                const DrawingParserOptions& options) {
  const ParserNetworkOptions network_options = ReadParserNetworkOptions(run_or_weights);
  return {network_options, systems::OpenNetwork(run_or_weights, device), options};
}

std::unique_ptr<systems::Predictor> OpenParserPredictor(const std::filesystem::path& run, const Device& device,
                                                        const Json& options) {
  const auto parsed = ParseOptions<ParserPredictOptions>(options, "options of predict");
  return std::make_unique<ParserPredictor>(OpenDrawingParser(run, device, parsed.parser));
}

}  // namespace daumier::sketch
