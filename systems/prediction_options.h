#pragma once
#include "systems/system.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::systems {

/// Whether a dotted key ("parsing.rounds") is an option of the task's predictions.
bool HasPredictionOption(const System& system, std::string_view key);

/// Which of the words key=value a task gets where several predict: those that are its options, and those that are an
/// option of none of the `tasks`, which its resolve_prediction refuses.
std::vector<std::string> OverridesOf(const System& system, std::span<const System* const> tasks,
                                     const std::vector<std::string>& overrides);

}  // namespace daumier::systems
