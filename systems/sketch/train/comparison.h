#pragma once
#include "systems/sketch/train/evaluation.h"
#include "render/image.h"

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

/// A face of the databases.
struct ComparedSketch {
  std::string title;
  int face = 0;
};

/// What several runs of the same databases make of the same faces (eval/comparison_sheet.h), each as its evaluation
/// measures it (SketchMeasurement::PredictResult). A row shows the sketch that the first run sees.
/// @throws Error as EvaluateSketchRun, if there is no run, or if a run was trained on other data than the first.
render::Image SketchComparison(const std::vector<ComparedRun>& runs, const std::vector<ComparedSketch>& faces);

/// Which test faces a sheet shows: the median, where the worst 5 % begin, and the first. `errors`: of each of `faces`.
/// @throws Error if there is none, or the lengths differ.
std::vector<ComparedSketch> ChooseFaces(const std::vector<int>& faces, const std::vector<double>& errors);

}  // namespace daumier::sketch
