#pragma once
#include "core/task.h"
#include "faces/controls/face_controls.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::datasets {

/// The manifest kind of a folder of control sheets.
inline constexpr const char* kControlSheetsKind = "controls";

/// The pictures that WriteControlSheets writes: GROUP.jpg for each group of controls.
std::vector<std::string> ControlSheetNames(const faces::FaceControls& controls);

/// What the controls of a template do, into an existing folder: of each group GROUP.jpg, a row a control, at the values
/// -3, -1.5, 0, 1.5 and 3 from the front and from the side; controls.json with name, group, sides and values of each
/// control, its mean and greatest displacement in mm at value 1, and `composition`: the twenty pairs that differ most
/// from the sum of both at value 2 (faces::MeasureComposition), and mean and greatest over all pairs; and a manifest of
/// kind "controls". @throws Error if a picture cannot be written; Cancelled, between pictures, if the task is.
void WriteControlSheets(const faces::FaceControls& controls, const faces::FaceTemplate& face_template,
                        const std::filesystem::path& folder, const Task& task = {});

}  // namespace daumier::datasets
