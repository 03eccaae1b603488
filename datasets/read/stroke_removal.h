#pragma once
#include "core/random.h"
#include "render/strokes.h"

#include <vector>

namespace daumier::datasets {

/// Randomly selects `count` strokes to drop [Yu et al. 2016], drawn without replacement, each time in
/// proportion to P_i = exp(order_weight i - length_weight L_i), i the stroke's place in the list and L_i its length in
/// widths of the canvas: late and short strokes go first. Never all: at most one less than there are.
/// Returns for each stroke whether it is dropped.
std::vector<bool> DrawRemovedStrokes(const std::vector<render::Stroke>& strokes, int count, double order_weight,
                                     double length_weight, Rng& rng);

}  // namespace daumier::datasets
