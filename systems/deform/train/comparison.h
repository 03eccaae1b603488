#pragma once
#include "systems/deform/train/evaluation.h"
#include "render/image.h"
#include "reports/chosen_faces.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::deform {

/// A run of a deformable model as a sheet shows it.
struct ComparedDeformRun {
  std::string name;
  std::filesystem::path run;
  DeformEvalOptions options = {};  ///< Of its evaluation; tells where faces come from.
};

/// What several runs make of the same faces (eval/comparison_sheet.h), each with the codes that its evaluation finds.
/// @throws Error as EvaluateDeformRun, if there is no run, or if a run was trained on other faces than the first.
render::Image DeformComparison(const std::vector<ComparedDeformRun>& runs, const std::vector<reports::ChosenFace>& faces);

}  // namespace daumier::deform
