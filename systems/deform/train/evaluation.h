#pragma once
#include "core/json.h"
#include "core/options.h"

#include <filesystem>
#include <string>

namespace daumier::deform {

struct DeformEvalOptions {
  std::string split = "test";
  std::string faces;
  int max_faces = 128;
  int adam_faces = 8;
  int adam_steps = 1000;
  bool baselines = true;

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"test", "validation", "train"}}, "Which side of the run's split is measured.");
    visit("faces", faces, Text{},
          "Folder of other faces of the same topology, which the run was not trained on; all of them are measured.");
    visit("max_faces", max_faces, Range{1, 1e6}, "So many faces of the side, evenly spread over it.");
    visit("adam_faces", adam_faces, Range{0, 1e6},
          "The codes of so many of these, the first ones, are also found as in the paper.");
    visit("adam_steps", adam_steps, Range{1, 1e6}, "Steps of that.");
    visit("baselines", baselines, Flag{}, "Measure the free baselines beside the network.");
  }
};

/// `daumier eval` of a deformable model's run: the errors of faces whose codes are found with the network held fixed
/// (FitCode with the weights of the run's loss), over all vertices, in the model's frame, with nothing aligned
/// first. Rows: the network with codes by Gauss-Newton; both methods on the first adam_faces of the faces; the template
/// alone; the mean of the training faces, the nearest of them, and a linear model with as many components as a code has
/// numbers (eval/linear_model.h, fitted on at most 2,000 evenly spread training faces, its ridge weight chosen on
/// at most 200 validation faces). Writes into `out_directory` metrics.json (returned; docs/formats.md), table.md, a
/// report with pictures (eval/report.h) of the median, the 95th percentile and the first face, and a manifest.
/// @throws Error as LoadDeformRun and FaceDatabase, if the run's faces are not those that it was trained on, or if
/// other faces are of another topology; UsageError if the side is empty.
Json EvaluateDeformRun(const std::filesystem::path& run_directory, const std::filesystem::path& out_directory,
                       const DeformEvalOptions& options = {});

}  // namespace daumier::deform
