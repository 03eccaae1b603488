#pragma once
#include "systems/system.h"

#include <filesystem>
#include <string_view>
#include <vector>

/// The one table of trainable tasks. A new task is one row in system_table.cpp and one in training/library.cpp.
namespace daumier::cli {

const std::vector<systems::System>& Systems();

/// @throws UsageError naming the task and those of the table.
const systems::System& SystemNamed(std::string_view name);
/// The task of a training config: its `system`; of configs of earlier versions `product`, or "sketch".
const systems::System& SystemOfConfig(const Json& config);
/// The task of the run folder. @throws Error if there is no run.
const systems::System& SystemOfRun(const std::filesystem::path& run);
/// The task of the run folder, or of shipped weights. @throws Error as SystemOfRun and ReadWeights.
const systems::System& SystemOfRunOrWeights(const std::filesystem::path& folder);

}  // namespace daumier::cli
