#pragma once
#include "systems/sketch/train/evaluation.h"
#include "render/image.h"
#include "reports/chosen_faces.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::sketch {

/// A run as a sheet shows it.
struct ComparedRun {
  std::string name;
  std::filesystem::path run;
  SketchEvalOptions options = {};  ///< Of its evaluation.
};

/// What several runs of the same databases make of the same faces (eval/comparison_sheet.h), each as its evaluation
/// measures it (SketchMeasurement::PredictResult). A row shows the sketch that the first run sees.
/// @throws Error as EvaluateSketchRun, if there is no run, or if a run was trained on other data than the first.
render::Image SketchComparison(const std::vector<ComparedRun>& runs, const std::vector<reports::ChosenFace>& faces);

}  // namespace daumier::sketch
