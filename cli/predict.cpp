#include "cli/predict_session.h"
#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/output_place.h"
#include "core/process_task.h"
#include "core/weights_folder.h"
#include "systems/predict_files.h"
#include "systems/prediction_folder.h"
#include "systems/prediction_options.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/run_folder.h"
#include "systems/weights_choice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <set>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct PredictArguments {
  std::string run, weights;  ///< run: also the first input, where no run is named.
  std::filesystem::path out, session;
  std::vector<std::string> inputs;  ///< Files, and key=value.
  bool keep_frame = false, all = false, no_refine = false, no_fit = false;
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

/// What to say where no input is named besides `word`, which is none.
std::string WithoutInput(const std::string& word) {
  const fs::path path(word);
  if (word.empty()) return "predict needs at least one input file";
  if (!fs::exists(path)) return fmt::format("{} does not exist. Name a file, or a folder of files", word);
  if (fs::exists(path / "manifest.json")) return fmt::format("predict needs at least one input file besides {}", word);
  std::set<std::string> extensions;
  for (const systems::System& system : Systems())
    extensions.insert(system.input_extensions.begin(), system.input_extensions.end());
  return fmt::format("{} {} (expected {}). Name other files, or convert it", word,
                     fs::is_directory(path) ? "holds no file that predict reads" : "is no file that predict reads",
                     fmt::join(extensions, ", "));
}

/// What a run or weights predict, and where to.
struct Prediction {
  fs::path run;
  std::vector<fs::path> files;
  fs::path out;
};

bool MakesMeshes(const systems::System& system) {
  return std::ranges::count(system.result_files, ".obj") > 0;
}

/// Warns where the task of a choice makes no mesh, but another one would that reads the same kind of picture.
void WarnWithoutMesh(const systems::WeightsChoice& choice, const std::vector<fs::path>& places) {
  const systems::System& system = SystemOfRunOrWeights(choice.weights);
  if (MakesMeshes(system)) return;
  const auto better = std::ranges::find_if(Systems(), [&](const systems::System& other) {
    return MakesMeshes(other) && other.open != nullptr && other.shipped_rank > system.shipped_rank &&
           other.picture_content.suits == system.picture_content.suits;
  });
  if (better == Systems().end()) return;
  log::Warn(
      "{} are predicted by the weights {}, without a mesh: there are no weights of the task '{}' in {}. Restore them, "
      "or "
      "name a run of it",
      system.picture_content.plural, WeightsName(choice.weights), better->name,
      places.empty() ? "any folder" : choice.weights.parent_path().string());
}

/// Predictions by shipped weights. Where the pictures are of two kinds, each has a folder of its weights' name in `out`.
/// @throws UsageError where there are none.
std::vector<Prediction> ByShippedWeights(const PredictArguments& arguments, const std::vector<fs::path>& files) {
  const std::vector<fs::path> places = systems::WeightsPlaces();
  const std::vector<systems::ShippedWeights> shipped = systems::ListWeights(places);
  std::vector<systems::WeightsChoice> choices;
  if (arguments.weights.empty()) {
    choices = ChooseWeights(files, Systems(), shipped, places);
    for (const systems::WeightsChoice& choice : choices) WarnWithoutMesh(choice, places);
  } else {
    choices = {{WeightsNamed(arguments.weights, shipped, places), files}};
  }
  std::vector<Prediction> predictions;
  for (systems::WeightsChoice& choice : choices) {
    log::Info("Predicting by the weights {}", choice.weights.string());
    const std::string name = WeightsName(choice.weights);
    if (choice.num_pictures > 0)
      log::Info(
          "{} of {} inputs are {}, by their content, and predicted by {} (--weights NAME or a run decides instead)",
          choice.num_pictures, choice.inputs.size(), choice.content, name);
    const fs::path out = choices.size() == 1 ? arguments.out : arguments.out / name;
    predictions.push_back({choice.weights, std::move(choice.inputs), out});
  }
  return predictions;
}

/// A prediction that is ready to begin: it has read its inputs.
struct ReadyPrediction {
  Prediction what;
  const systems::System& system;
  Json options;
  systems::PredictionInputs inputs;
};

/// `overrides`: those of this task.
ReadyPrediction Prepared(const PredictArguments& arguments, const systems::System& system,
                         std::vector<std::string> overrides, Prediction what, const Task& task) {
  if (system.open == nullptr) {
    std::vector<std::string_view> names;
    for (const systems::System& other : Systems())
      if (other.open != nullptr) names.push_back(other.name);
    throw Error(fmt::format("{}: this is a run of the task '{}', which predicts nothing (expected a run of '{}')",
                            what.run.string(), system.name, fmt::join(names, "' or '")));
  }
  const auto is_refine = [](const std::string& word) { return word.starts_with("refine="); };
  if (arguments.keep_frame && IsWeightsFolder(what.run) && std::ranges::none_of(overrides, is_refine) &&
      systems::HasPredictionOption(system, "framing"))
    overrides.push_back("refine=false");  // Shipped weights have no model by which contours are matched.
  Json options = system.resolve_prediction(ConfigArguments{{}, overrides}.Load(), "predict");
  ParseDevice(arguments.device);
  CheckOutputFolder(what.out, systems::PredictionOutput(), {what.run});  // Before files are read.
  auto inputs = systems::ReadPredictionInputs(system, systems::ExpandInputFolders(system, what.files), task);
  systems::CheckPredictionFolder(system, what.out, what.run, inputs);
  return {std::move(what), system, std::move(options), std::move(inputs)};
}

systems::PredictionSummary Run(const PredictArguments& arguments, ReadyPrediction ready, const Task& task) {
  const auto& [run, files, out] = ready.what;
  systems::PredictionSummary summary{0, ready.inputs.failures};
  if (!ready.inputs.inputs.empty()) {  // Otherwise the network is not needed.
    const auto predictor = ready.system.open(run, ParseDevice(arguments.device), ready.options);
    const systems::PredictionInputs inputs = systems::SeparateInputs(*predictor, std::move(ready.inputs));
    summary = systems::PredictFiles(ready.system, *predictor, run, inputs, out, ready.options, task);
  }
  if (summary.num_results > 0)
    fmt::print("predictions: {} ({} of {})\n", out.string(), summary.num_results,
               summary.num_results + summary.failures.size());
  return summary;
}

/// Adds the options that the flags mean. @throws UsageError if no task has one of them.
void AddFlags(const PredictArguments& arguments, const std::vector<const systems::System*>& tasks,
              std::vector<std::string>& overrides) {
  const auto add = [&](bool is_given, const char* flag, const std::string& key, const std::string& value) {
    if (!is_given) return;
    if (std::ranges::none_of(tasks, [&](const auto* task) { return systems::HasPredictionOption(*task, key); }))
      throw UsageError(
          fmt::format("{} is for drawings of faces, and the inputs are predicted by the task '{}'. Leave it "
                      "out, or name --weights of drawings",
                      flag, tasks.front()->name));
    overrides.push_back(key + "=" + value);
  };
  add(arguments.keep_frame, "--keep-frame", "framing", "keep");
  add(arguments.all, "--all", "faces", "all");
  add(arguments.no_refine, "--no-refine", "refine", "false");
  add(arguments.no_fit, "--no-fit", "fit", "false");
}

void Predict(const PredictArguments& arguments) {
  std::vector<fs::path> files;
  std::vector<std::string> overrides;
  const bool names_run = arguments.weights.empty() && !IsOption(arguments.run) && !IsInput(arguments.run);
  std::vector<std::string> words = arguments.inputs;
  if (!names_run && !arguments.run.empty()) words.insert(words.begin(), arguments.run);
  for (const std::string& word : words) {
    if (IsOption(word)) overrides.push_back(word);
    if (!IsOption(word)) files.emplace_back(word);
  }
  if (files.empty()) throw UsageError(WithoutInput(names_run ? arguments.run : ""));
  std::vector<Prediction> predictions =
      names_run ? std::vector<Prediction>{{arguments.run, files, arguments.out}} : ByShippedWeights(arguments, files);
  const Task task = TaskOfProcess();
  std::vector<const systems::System*> tasks;
  for (const Prediction& prediction : predictions) tasks.push_back(&SystemOfRunOrWeights(prediction.run));
  AddFlags(arguments, tasks, overrides);
  std::vector<ReadyPrediction> ready;  // All are checked before the first is written.
  for (size_t i = 0; i < predictions.size(); ++i)
    ready.push_back(Prepared(arguments, *tasks[i], systems::OverridesOf(*tasks[i], tasks, overrides),
                             std::move(predictions[i]), task));
  systems::PredictionSummary summary;
  for (ReadyPrediction& prediction : ready) {
    systems::PredictionSummary one = Run(arguments, std::move(prediction), task);
    summary.num_results += one.num_results;
    for (systems::PredictionFailure& failure : one.failures) summary.failures.push_back(std::move(failure));
  }
  systems::ThrowIfFailed(summary, arguments.out);
}

/// By the run, or the weights, that are named, else by the shipped ones of drawings.
void PredictSession(const PredictArguments& arguments) {
  const bool has_inputs = !arguments.inputs.empty() || IsOption(arguments.run) || IsInput(arguments.run);
  if (has_inputs || (!arguments.run.empty() && !arguments.weights.empty()))
    throw UsageError("--session takes at most one run or one --weights, and neither inputs nor key=value");
  if (arguments.keep_frame || arguments.all || arguments.no_refine || arguments.no_fit)
    throw UsageError("--session takes none of --keep-frame, --all, --no-refine and --no-fit");
  SessionArguments session{arguments.session, arguments.run, arguments.out, ParseDevice(arguments.device)};
  if (session.run.empty()) {
    const std::vector<fs::path> places = systems::WeightsPlaces();
    const std::vector<systems::ShippedWeights> shipped = systems::ListWeights(places);
    session.run = arguments.weights.empty()
                      ? systems::WeightsFor(std::vector<fs::path>{"drawing.svg"}, Systems(), shipped, places)
                      : WeightsNamed(arguments.weights, shipped, places);
  }
  if (SystemOfRunOrWeights(session.run).name != sketch::kSystem)
    throw UsageError(fmt::format("--session is for runs and weights of the task '{}', and {} is of another",
                                 sketch::kSystem, session.run.string()));
  ReplaySession(session);
}

}  // namespace

Verb PredictVerb() {
  return {
      "predict", "Drawings to meshes, portraits to meshes or to landmarks and masks, with pictures",
      [](CLI::App& command) {
        auto arguments = std::make_shared<PredictArguments>();
        command.add_option("run", arguments->run,
                           "Run folder, or weights. Without it the shipped weights that read the inputs are used");
        command.add_option(
            "inputs", arguments->inputs,
            "Of a sketch run: frontal face drawings: SVG, Xournal++, InkML, Quick, Draw! ndjson, or pictures "
            "of lines (PNG, "
            "JPEG, WebP, BMP, TIFF). Of a landmarks or portrait run: pictures of faces. A folder of them; and "
            "key=value");
        command.add_option("--weights", arguments->weights,
                           "Shipped weights: their name (sketch-ict, parser, portrait, landmarks, gestures), or their "
                           "folder. Without it the choice follows from the inputs: line drawings and portraits are "
                           "distinguished by content. "
                           "Searched in $DAUMIER_WEIGHTS, else in `weights` of the "
                           "program's folder and of those above it");
        command
            .add_option("--session", arguments->session,
                        "Replay a recorded session of sketching instead (docs/sketching.md): a mesh and a drawing of "
                        "each of its states, and a sheet")
            ->check(CLI::ExistingFile);
        command.add_flag("--keep-frame", arguments->keep_frame,
                         "Use the sheet as the canvas of the training sketches; without it, the drawing is parsed to "
                         "find its frame");
        command.add_flag("--all", arguments->all,
                         "Predict every face on a sheet, as NAME_1, NAME_2, ...; without it, the largest face is "
                         "predicted, and a warning counts the faces");
        command.add_flag(
            "--no-refine", arguments->no_refine,
            "With --keep-frame: write the face of the network as it is; without it, its contours are matched with the "
            "strokes, but not by shipped weights, which have no model for that");
        command.add_flag(
            "--no-fit", arguments->no_fit,
            "Write the face of the network in the frame of the parsed drawing; without it, the face is fitted to "
            "the drawing");
        command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
        command.add_option("-o,--out", arguments->out, "Folder to write")->required();
        return [arguments] { arguments->session.empty() ? Predict(*arguments) : PredictSession(*arguments); };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
