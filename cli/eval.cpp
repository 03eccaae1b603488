#include "cli/verb.h"
#include "core/error.h"
#include "core/files.h"
#include "systems/deform/train/evaluation.h"
#include "systems/sketch/train/external_evaluation.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/deform/train/run.h"

#include <fmt/core.h>

#include <memory>
#include <vector>

namespace daumier::cli {
namespace {

struct EvalArguments {
  std::filesystem::path run, out;
  std::string split = "test", faces;
  sketch::SketchEvalOptions sketch;
  sketch::OtherFacesOptions other;
  deform::DeformEvalOptions deform;
  bool baselines = true, as_json = false;
  std::vector<CLI::Option*> of_sketches, of_deform;  ///< What only one product knows.
};

/// @throws UsageError if an option was given that the run's product does not know.
void RefuseOptions(const std::vector<CLI::Option*>& options, const std::string& product) {
  for (const CLI::Option* option : options) {
    if (option->count() > 0)
      throw UsageError(fmt::format("{} is no option of a run of kind '{}'", option->get_name(), product));
  }
}

Json EvaluateSketch(EvalArguments& arguments, const std::filesystem::path& out) {
  if (arguments.faces.empty()) {
    arguments.sketch.split = arguments.split;
    arguments.sketch.baselines = arguments.baselines;
    return sketch::EvaluateSketchRun(arguments.run, out, arguments.sketch);
  }
  if (arguments.other.sketches.empty())
    throw UsageError("a sketch run is measured on other faces by their sketches: give --sketches, too");
  arguments.other.faces = arguments.faces;
  arguments.other.strength = arguments.sketch.strength;
  arguments.other.baselines = arguments.baselines;
  return sketch::EvaluateOnOtherFaces(arguments.run, out, arguments.other);
}

Json EvaluateDeform(EvalArguments& arguments, const std::filesystem::path& out) {
  arguments.deform.split = arguments.split;
  arguments.deform.faces = arguments.faces;
  arguments.deform.baselines = arguments.baselines;
  return deform::EvaluateDeformRun(arguments.run, out, arguments.deform);
}

void Evaluate(EvalArguments& arguments) {
  const bool other = !arguments.faces.empty();
  const auto out = !arguments.out.empty() ? arguments.out : arguments.run / (other ? "other" : "report");
  // What is no run at all is refused by the product's own reader, which says what to do.
  const bool is_run = std::filesystem::exists(arguments.run / "manifest.json");
  const std::string product = is_run ? deform::ProductOf(ReadManifest(arguments.run, "run")) : "sketch";
  const bool is_deform = product == deform::kDeformProduct;
  RefuseOptions(is_deform ? arguments.of_sketches : arguments.of_deform, product);
  const Json metrics = is_deform ? EvaluateDeform(arguments, out) : EvaluateSketch(arguments, out);
  if (arguments.as_json) {
    PrintResult(metrics, true);
  } else {
    const bool has_page = std::filesystem::exists(out / "index.html");
    fmt::print("{}\npictures: {}\n", ReadFile(out / "table.md"),
               (out / (has_page ? "index.html" : "sheet.png")).string());
  }
}

}  // namespace

Verb EvalVerb() {
  return {
      "eval", "Errors of a run beside the free baselines, with pictures", [](CLI::App& command) {
        auto arguments = std::make_shared<EvalArguments>();
        command.add_option("run", arguments->run, "Run folder")->required();
        auto* faces = command.add_option("--faces", arguments->faces,
                                         "Measure on all of these faces instead, which the run was not trained on");
        command.add_option("--split", arguments->split, "test, validation or train")
            ->check(CLI::IsMember({"test", "validation", "train"}))
            ->capture_default_str()
            ->excludes(faces);
        auto* sketches = command.add_option("--sketches", arguments->other.sketches,
                                            "The sketches of these faces, for a sketch run");
        sketches->needs(faces);
        arguments->of_sketches = {
            sketches,
            command
                .add_option("--strength", arguments->sketch.strength,
                            "Augment the sketches: 0 not, 1 as in training, 2 strongly")
                ->check(CLI::Range(0.0, 4.0))
                ->capture_default_str(),
            command
                .add_option("--recover-with", arguments->sketch.recover_with,
                            "Run whose faces shape-level numbers are recovered with, for a network that reads them")
                ->excludes(faces),
            command.add_flag("--fit", arguments->sketch.fit, "Also fit the bilinear model to the labelled strokes")
                ->excludes(faces),
            command
                .add_flag("--refine", arguments->sketch.refine,
                          "Also match the contours of the network's faces with the strokes; with --faces always done")
                ->excludes(faces),
            command
                .add_flag("--deform", arguments->sketch.deform,
                          "Also do that and then move the faces' surfaces onto the strokes; with --faces always done")
                ->excludes(faces)};
        arguments->of_deform = {
            command
                .add_option("--max-faces", arguments->deform.max_faces,
                            "Of a deformable model: so many faces of the side, evenly spread over it")
                ->check(CLI::PositiveNumber)
                ->capture_default_str(),
            command
                .add_option("--adam-faces", arguments->deform.adam_faces,
                            "Of a deformable model: find the codes of so many of these by Adam, too")
                ->check(CLI::NonNegativeNumber)
                ->capture_default_str()};
        command.add_flag(
            "!--no-baselines", arguments->baselines,
            "Leave out the free baselines; with --faces those of a sketch run that read its training faces");
        command.add_option("--out", arguments->out, "Report folder; RUN/report by default, with --faces RUN/other");
        command.add_flag("--json", arguments->as_json, "Machine-readable");
        return [arguments] { Evaluate(*arguments); };
      }};
}

}  // namespace daumier::cli
