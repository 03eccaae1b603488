#include "cli/system_table.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/files.h"
#include "core/process_task.h"
#include "core/run_manifest.h"
#include "systems/training_library.h"

#include <fmt/core.h>

#include <memory>
#include <vector>

namespace daumier::cli {
namespace {

/// A flag that sets an option of an evaluation. Without `value` it sets the option to true.
struct OptionFlag {
  const char *flag, *key, *help;
  bool value = true;
};

const std::vector<OptionFlag>& OptionFlags() {
  static const std::vector<OptionFlag> flags = {
      {"--split", "split", "Subset of the run's split: test (default), validation or train"},
      {"--faces", "faces", "Measure all faces of this folder, on which the run was not trained, instead of the split"},
      {"--sketches", "sketches", "Of a sketch run: the sketches of the faces of --faces"},
      {"--strength", "strength", "Of a sketch run: augmentation of the sketches: 0 none, 1 as in training, 2 strong"},
      {"--recover-with", "recover_with",
       "Of a network that reads curve coefficients: the run from whose faces they are recovered"},
      {"--max-faces", "max_faces", "Of a deformable model: largest number of faces, evenly spaced in the subset"},
      {"--adam-faces", "adam_faces",
       "Of a deformable model: also find the codes of this many faces by Adam, which takes minutes; none by default"},
      {"--fit", "fit", "Of a sketch run: also fit the bilinear model to the labelled strokes", false},
      {"--refine", "refine", "Of a sketch run: also match the contours of the predicted faces with the strokes", false},
      {"--deform", "deform", "Of a sketch run: also fit the faces to the sketches as a parser of drawings reads them",
       false}};
  return flags;
}

struct EvalArguments {
  std::filesystem::path run, out;
  std::vector<std::string> texts = std::vector<std::string>(OptionFlags().size());
  std::vector<std::string> overrides;
  bool baselines = true, as_json = false;
};

/// The options that were given, by key; values as TOML, or else as text.
Json OptionsOf(const EvalArguments& arguments) {
  std::vector<std::string> overrides;
  for (size_t i = 0; i < arguments.texts.size(); ++i) {
    if (!arguments.texts[i].empty())
      overrides.push_back(fmt::format("{}={}", OptionFlags()[i].key, arguments.texts[i]));
  }
  if (!arguments.baselines) overrides.push_back("baselines=false");
  overrides.insert(overrides.end(), arguments.overrides.begin(), arguments.overrides.end());
  return ConfigArguments{{}, overrides}.Load();
}

/// What an evaluation reads: the run, and every option that is a folder.
std::vector<std::filesystem::path> InputsOf(const EvalArguments& arguments, const Json& options) {
  std::vector<std::filesystem::path> inputs{arguments.run};
  const Json values = options.flatten();
  for (const auto& [key, value] : values.items())
    if (value.is_string() && std::filesystem::is_directory(value.get<std::string>()))
      inputs.push_back(value.get<std::string>());
  return inputs;
}

void Evaluate(const EvalArguments& arguments) {
  const systems::System& system = SystemOfRun(arguments.run);
  const Json given = OptionsOf(arguments);
  const Json options = system.resolve_evaluation(given, fmt::format("eval of a run of the task '{}'", system.name));
  const auto out = !arguments.out.empty()    ? arguments.out
                   : given.contains("faces") ? arguments.run / "other"
                                             : ReportDirectory(arguments.run);
  reports::CheckReportDirectory(out, InputsOf(arguments, options));
  const systems::SystemTraining& training = systems::LoadTrainingLibrary().at(system.name);
  FolderCache databases;
  const reports::Evaluation evaluation = training.evaluate(arguments.run, options, databases, TaskOfProcess());
  reports::WriteEvaluation(out, evaluation);
  if (arguments.as_json) {
    PrintResult(evaluation.metrics, true);
    return;
  }
  const bool has_page = std::filesystem::exists(out / "index.html");
  fmt::print("{}\npictures: {}\n", ReadFile(out / "table.md"),
             (out / (has_page ? "index.html" : "sheet.png")).string());
}

}  // namespace

Verb EvalVerb() {
  return {
      "eval", "Errors of a run and of training-free baselines, with pictures", [](CLI::App& command) {
        auto arguments = std::make_shared<EvalArguments>();
        command.add_option("run", arguments->run, "Run folder")->required();
        for (size_t i = 0; i < OptionFlags().size(); ++i) {
          const OptionFlag& flag = OptionFlags()[i];
          if (flag.value) {
            command.add_option(flag.flag, arguments->texts[i], flag.help);
          } else {
            command.add_flag_callback(
                flag.flag, [arguments, i] { arguments->texts[i] = "true"; }, flag.help);
          }
        }
        command.add_flag_callback(
            "--no-baselines", [arguments] { arguments->baselines = false; }, "Leave out the training-free baselines");
        command.add_option("overrides", arguments->overrides, "key=value: any option of the evaluation");
        command.add_option("-o,--out", arguments->out, "Report folder; RUN/report by default, with --faces RUN/other");
        command.add_flag("--json", arguments->as_json, "Print the result as JSON");
        std::string footer;
        for (const systems::System& system : Systems())
          footer +=
              fmt::format("Options of an evaluation of a run of '{}':\n{}", system.name, system.evaluation_help());
        command.footer(footer);
        return [arguments] { Evaluate(*arguments); };
      }};
}

}  // namespace daumier::cli
