#pragma once
#include "core/array.h"

#include <span>

namespace daumier::sketch {

/// What the network returns of B drawings: heat_maps B x 26 x M x M, labels B x 14 x L x L, states B x 11, scores.
struct ParserOutputs {
  FloatArray heat_maps, labels, states;
};

inline std::span<const float> RowOf(const FloatArray& array, int64_t row) {
  return {array.row(row), size_t(array.row_size())};
}

}  // namespace daumier::sketch
