#pragma once
#include "cli/edit_files.h"
#include "cli/edit_start.h"
#include "systems/deform/open_code_model.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::cli {

/// What `daumier edit` is given.
struct EditArguments {
  std::filesystem::path model, out, toward, labelled_faces, label_file;
  EditStartArguments start;
  std::vector<std::string> handles, labels, keep;
  std::string label_method = "means";  ///< Or "svm".
  std::optional<double> soft_cm, caricature;
  double spread = 0.5;
  int random = 0, steps = 3, texture_size = 1024;
  uint64_t seed = 1;
  bool is_local = false, with_arap = false, moves_expression = false, is_textured = false, writes_ply = false,
       lists_labels = false, as_json = false;
};

/// The start and, after it, one face a step of each kind of edit that the arguments name; warnings where handles are not
/// reached or a face is unlike those of the model. @throws UsageError and Error naming the argument and the repair.
EditContent MakeEdit(const deform::OpenedModel& opened, const EditArguments& arguments);

/// The names of --list-labels. @throws UsageError if the model names no faces and none are given.
std::vector<std::string> LabelNames(const deform::OpenedModel& opened, const EditArguments& arguments);

}  // namespace daumier::cli
