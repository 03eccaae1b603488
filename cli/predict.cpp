#include "cli/verb.h"
#include "systems/sketch/train/predict_drawings.h"

#include <memory>

namespace daumier::cli {

Verb PredictVerb() {
  return {"predict", "Drawings to meshes and pictures", [](CLI::App& command) {
            struct Arguments {
              std::filesystem::path run, out;
              std::vector<std::filesystem::path> inputs;
              bool keep_frame = false, no_refine = false, deform = false;
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("run", arguments->run, "Run folder")->required();
            command
                .add_option("inputs", arguments->inputs,
                            "Frontal face drawings: SVG, Quick, Draw! ndjson, or pictures of lines")
                ->required();
            command.add_flag("--keep-frame", arguments->keep_frame,
                             "The sheet is the canvas of the training sketches; otherwise drawings are fitted to it");
            command.add_flag("--no-refine", arguments->no_refine,
                             "Keep the network's own face; otherwise its contours are drawn to the strokes");
            command.add_flag("--deform", arguments->deform,
                             "Then move the face's surface onto the strokes, beyond what the model of faces can say");
            command.add_option("--out", arguments->out, "Folder to write")->required();
            return [arguments] {
              sketch::PredictOptions options;
              options.framing = arguments->keep_frame ? sketch::Framing::kKeep : sketch::Framing::kFit;
              options.refine = !arguments->no_refine;
              options.deform = arguments->deform;
              sketch::PredictSketches(arguments->run, arguments->inputs, arguments->out, options);
            };
          }};
}

}  // namespace daumier::cli
