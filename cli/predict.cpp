#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "systems/predict_files.h"
#include "systems/shipped_weights.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace daumier::cli {
namespace {

struct PredictArguments {
  std::string run, weights;  ///< run: also the first input, where no run is named.
  std::filesystem::path out;
  std::vector<std::string> inputs;  ///< Files, and key=value.
  bool keep_frame = false, all = false, no_refine = false, deform = false;
  std::string device = "cpu";
};

bool IsOption(const std::string& word) {
  return word.find('=') != std::string::npos && !std::filesystem::exists(word);
}

/// Whether the first word is an input and not a run: a path with the extension of an input of any task, or a folder that
/// holds one and no manifest.
bool IsInput(const std::string& word) {
  std::error_code ignored;
  if (std::filesystem::is_directory(word, ignored)) {
    if (std::filesystem::exists(std::filesystem::path(word) / "manifest.json")) return false;
    return std::ranges::any_of(std::filesystem::directory_iterator(word), [](const auto& entry) {
      return std::ranges::any_of(Systems(),
                                 [&](const systems::System& system) { return IsInputFile(system, entry.path()); });
    });
  }
  return std::ranges::any_of(Systems(), [&](const systems::System& system) { return IsInputFile(system, word); });
}

/// The run or weights by which files are predicted. @throws UsageError where there are none.
std::filesystem::path FolderFor(const PredictArguments& arguments, const std::vector<std::filesystem::path>& files) {
  const std::vector<std::filesystem::path> places = systems::WeightsPlaces();
  const std::vector<systems::ShippedWeights> shipped = systems::ListWeights(places);
  const std::filesystem::path folder = arguments.weights.empty() ? WeightsFor(files, Systems(), shipped, places)
                                                                 : WeightsNamed(arguments.weights, shipped, places);
  log::Info("Predicting by the weights {}", folder.string());
  return folder;
}

void Predict(const PredictArguments& arguments) {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> overrides;
  const bool names_run = arguments.weights.empty() && !IsOption(arguments.run) && !IsInput(arguments.run);
  std::vector<std::string> words = arguments.inputs;
  if (!names_run) words.insert(words.begin(), arguments.run);
  for (const std::string& word : words) {
    if (IsOption(word)) overrides.push_back(word);
    if (!IsOption(word)) files.emplace_back(word);
  }
  if (files.empty()) throw UsageError("predict needs at least one input file");
  if (arguments.keep_frame) overrides.push_back("framing=keep");
  if (arguments.all) overrides.push_back("faces=all");
  if (arguments.no_refine) overrides.push_back("refine=false");
  if (arguments.deform) overrides.push_back("deform=true");
  const std::filesystem::path run = names_run ? std::filesystem::path(arguments.run) : FolderFor(arguments, files);
  const systems::System& system = SystemOfRunOrWeights(run);
  if (system.open == nullptr) {
    std::vector<std::string_view> names;
    for (const systems::System& other : Systems())
      if (other.open != nullptr) names.push_back(other.name);
    throw Error(fmt::format("{}: this is a run of the task '{}', which predicts nothing (expected a run of '{}')",
                            run.string(), system.name, fmt::join(names, "' or '")));
  }
  const Json options = system.resolve_prediction(ConfigArguments{{}, overrides}.Load(), "predict");
  const Device device = ParseDevice(arguments.device);
  CheckOutputFolder(arguments.out, systems::PredictionOutput(), {run});  // Before files are read.
  const Task task = TaskOfProcess();
  auto inputs = systems::ReadPredictionInputs(system, systems::ExpandInputFolders(system, files), task);
  systems::CheckPredictionFolder(system, arguments.out, run, inputs);
  systems::PredictionSummary summary{0, inputs.failures};
  if (!inputs.inputs.empty()) {  // Otherwise the network is not needed.
    const auto predictor = system.open(run, device, options);
    inputs = systems::SeparateInputs(*predictor, std::move(inputs));
    summary = systems::PredictFiles(system, *predictor, run, inputs, arguments.out, options, task);
  }
  if (summary.num_results > 0)
    fmt::print("predictions: {} ({} of {})\n", arguments.out.string(), summary.num_results,
               summary.num_results + summary.failures.size());
  systems::ThrowIfFailed(summary, arguments.out);
}

}  // namespace

Verb PredictVerb() {
  return {"predict", "Drawings to meshes, portraits to meshes or to landmarks and masks, with pictures",
          [](CLI::App& command) {
            auto arguments = std::make_shared<PredictArguments>();
            command
                .add_option("run", arguments->run,
                            "Run folder, or weights. Without it the shipped weights that read the inputs are used")
                ->required();
            command.add_option(
                "inputs", arguments->inputs,
                "Of a sketch run: frontal face drawings: SVG, Xournal++, InkML, Quick, Draw! ndjson, or pictures "
                "of lines (PNG, "
                "JPEG, WebP, BMP, TIFF). Of a landmarks or portrait run: pictures of faces. A folder of them; and "
                "key=value");
            command.add_option("--weights", arguments->weights,
                               "Shipped weights: their name (landmarks, portrait), or their folder. Without it the "
                               "choice follows from the inputs. Searched in $DAUMIER_WEIGHTS, else in `weights` of the "
                               "program's folder and of those above it");
            command.add_flag(
                "--keep-frame", arguments->keep_frame,
                "Use the sheet as the canvas of the training sketches; without it, scale and shift are searched");
            command.add_flag("--all", arguments->all,
                             "Predict every face on a sheet, as NAME_1, NAME_2, ...; without it, the largest face is "
                             "predicted, and a warning counts the faces");
            command.add_flag(
                "--no-refine", arguments->no_refine,
                "Write the face of the network as it is; without it, its contours are matched with the strokes");
            command.add_flag(
                "--deform", arguments->deform,
                "Also move the surface of the face onto the strokes, beyond what the model of faces can show");
            command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
            command.add_option("-o,--out", arguments->out, "Folder to write")->required();
            return [arguments] { Predict(*arguments); };
          },
          /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
