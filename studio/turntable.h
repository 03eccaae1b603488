#pragma once
#include "core/task.h"
#include "faces/face_model.h"
#include "studio/job_options.h"

#include <filesystem>

namespace daumier::studio {

/// Pictures turn_001.png, turn_002.png, ... of a face (V x 3, cm) that turns once about its vertical axis, and turntable.png, at most
/// 12 of them on one sheet. @throws Error as render::WriteImage; Cancelled if the task is.
void WriteTurntable(const std::filesystem::path& folder, const faces::FaceTemplate& face_template,
                    const geometry::Points& face, const TurntableOptions& options, const Task& task);

}  // namespace daumier::studio
