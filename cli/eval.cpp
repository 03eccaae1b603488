#include "cli/verb.h"
#include "core/files.h"
#include "eval/sketch_eval.h"

#include <fmt/core.h>

#include <memory>

namespace daumier::cli {

Verb EvalVerb() {
  return {"eval", "Errors of a run in millimetres beside the free baselines, with pictures", [](CLI::App& command) {
            struct Arguments {
              std::filesystem::path run, out;
              eval::SketchEvalOptions options;
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
            command.add_option("--out", arguments->out, "Report folder; RUN/report by default");
            command.add_flag("--json", arguments->as_json, "Machine-readable");
            return [arguments] {
              const auto out = arguments->out.empty() ? arguments->run / "report" : arguments->out;
              const Json metrics = eval::EvaluateSketchRun(arguments->run, out, arguments->options);
              if (arguments->as_json) {
                PrintResult(metrics, true);
              } else {
                fmt::print("{}\npictures: {}\n", ReadFile(out / "table.md"), (out / "index.html").string());
              }
            };
          }};
}

}  // namespace daumier::cli
