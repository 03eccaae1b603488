#include "cli/verb.h"
#include "fitting/sketch_predictor.h"

#include <memory>

namespace daumier::cli {

Verb PredictVerb() {
  return {
      "predict", "Sketch images to meshes and pictures", [](CLI::App& command) {
        struct Arguments {
          std::filesystem::path run, out;
          std::vector<std::filesystem::path> inputs;
        };
        auto arguments = std::make_shared<Arguments>();
        command.add_option("run", arguments->run, "Run folder")->required();
        command.add_option("inputs", arguments->inputs, "Frontal face sketches: dark lines on light paper")->required();
        command.add_option("--out", arguments->out, "Folder to write")->required();
        return [arguments] { fitting::PredictSketches(arguments->run, arguments->inputs, arguments->out); };
      }};
}

}  // namespace daumier::cli
