#pragma once
#include <span>

namespace daumier::runtime {

/// Whether no number is infinite or NaN. oneDNN loses NaN in many operators, so that it is looked for before a run.
bool AreFinite(std::span<const float> numbers);

}  // namespace daumier::runtime
