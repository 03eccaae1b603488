#pragma once
#include "core/task.h"
#include "render/image.h"
#include "studio/display_head.h"
#include "studio/job_options.h"

#include <filesystem>
#include <functional>

namespace daumier::studio {

/// Pictures turn_001.png, turn_002.png, ... of what turns once about its vertical axis, and turntable.png, at most 12 of them on one
/// sheet. draw: a square picture of options.size pixels a side, moved by degrees to the head's own left. @throws Error as
/// render::WriteImage; Cancelled if the task is.
void WriteTurntable(const std::filesystem::path& folder, const std::function<render::Image(double yaw_degrees)>& draw,
                    const TurntableOptions& options, const Task& task);

/// The same of a face (V x 3, cm).
void WriteTurntable(const std::filesystem::path& folder, const DisplayHead& display, const geometry::Points& face,
                    const TurntableOptions& options, const Task& task);

}  // namespace daumier::studio
