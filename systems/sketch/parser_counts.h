#pragma once
#include "core/sample_batch.h"
#include "datasets/styles/styled_dataset.h"
#include "systems/sketch/parser_errors.h"
#include "systems/sketch/parser_network_options.h"
#include "systems/sketch/parser_outputs.h"

#include <vector>

namespace daumier::sketch {

/// Errors of the network on styled drawings, in the frame in which they are drawn.
struct ParserCounts {
  ClassCounts labels{faces::kNumLineLabels}, mouth{faces::kNumMouthStates}, eyes{faces::kNumEyeStates},
      view{faces::kNumDrawnViews};
  std::vector<PointErrors> points;  ///< Of the drawings that have any.

  /// batch: of datasets::StyledDataset.
  void Add(const SampleBatch& batch, const ParserOutputs& outputs, const ParserNetworkOptions& network);
  double mean_error() const;
};

}  // namespace daumier::sketch
