#pragma once
#include "core/random.h"
#include "datasets/styles/styled_lines.h"

namespace daumier::datasets {

/// Sorts lines as a person might draw them: part by part in one of some usual orders of the parts with small changes,
/// lines of a part as they are.
void SortAsDrawn(LineSheet& sheet, Rng& rng);

}  // namespace daumier::datasets
