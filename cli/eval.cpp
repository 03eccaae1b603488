#include "cli/verb.h"
#include "core/files.h"
#include "eval/other_faces.h"
#include "eval/sketch_eval.h"

#include <fmt/core.h>

#include <memory>

namespace daumier::cli {

Verb EvalVerb() {
  return {"eval", "Errors of a run in millimetres beside the free baselines, with pictures", [](CLI::App& command) {
            struct Arguments {
              std::filesystem::path run, out;
              eval::SketchEvalOptions options;
              eval::OtherFacesOptions other;
              bool as_json = false;
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("run", arguments->run, "Run folder")->required();
            command.add_option("--split", arguments->options.split, "test, validation or train")
                ->check(CLI::IsMember({"test", "validation", "train"}))
                ->capture_default_str();
            command
                .add_option("--strength", arguments->options.strength,
                            "Augment the sketches: 0 not, 1 as in training, 2 strongly")
                ->check(CLI::Range(0.0, 4.0))
                ->capture_default_str();
            command.add_option("--recover-with", arguments->options.recover_with,
                               "Run whose faces shape-level numbers are recovered with, for a network that reads them");
            command.add_flag("--fit", arguments->options.fit, "Also fit the bilinear model to the labelled strokes");
            command.add_flag("--refine", arguments->options.refine,
                             "Also match the contours of the network's faces with the strokes");
            auto* faces = command.add_option("--faces", arguments->other.faces,
                                             "Measure on all of these faces instead, which the run was not trained on");
            auto* sketches = command.add_option("--sketches", arguments->other.sketches, "The sketches of these faces");
            faces->needs(sketches);
            sketches->needs(faces);
            command.add_option("--out", arguments->out, "Report folder; RUN/report by default, with --faces RUN/other");
            command.add_flag("--json", arguments->as_json, "Machine-readable");
            return [arguments] {
              const bool other = !arguments->other.faces.empty();
              arguments->other.strength = arguments->options.strength;
              const auto out = !arguments->out.empty() ? arguments->out : arguments->run / (other ? "other" : "report");
              const Json metrics = other ? eval::EvaluateOnOtherFaces(arguments->run, out, arguments->other)
                                         : eval::EvaluateSketchRun(arguments->run, out, arguments->options);
              if (arguments->as_json) {
                PrintResult(metrics, true);
              } else {
                fmt::print("{}\npictures: {}\n", ReadFile(out / "table.md"),
                           (out / (other ? "sheet.png" : "index.html")).string());
              }
            };
          }};
}

}  // namespace daumier::cli
