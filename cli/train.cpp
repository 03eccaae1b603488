#include "cli/verb.h"
#include "core/options.h"
#include "systems/deform/train/training.h"
#include "systems/sketch/options.h"
#include "systems/sketch/train/training.h"

#include <memory>

namespace daumier::cli {

Verb TrainVerb() {
  return {"train", "Train a network from a config into a run folder", [](CLI::App& command) {
            struct Arguments {
              ConfigArguments config;
              std::filesystem::path out;
              bool resume = false;
              std::string device = "cpu";
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("config", arguments->config.file, "TOML file of the run")->required();
            command.add_option("overrides", arguments->config.overrides,
                               "key=value or table.key=value, in TOML syntax");
            command.add_option("--out", arguments->out, "Run folder")->required();
            command.add_flag("--resume", arguments->resume, "Go on from the last checkpoint of the run folder");
            command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
            command.footer("Options of a sketch network:\n" + HelpText<sketch::SketchTrainingOptions>() +
                           "Options of a deformable model, product = \"deform\":\n" +
                           HelpText<deform::DeformTrainingOptions>());
            return [arguments] {
              const Json config = arguments->config.Load();
              const auto train = config.contains("product") ? deform::TrainDeform : sketch::TrainSketch;
              train(config, arguments->out, arguments->resume, arguments->device);
            };
          }};
}

}  // namespace daumier::cli
