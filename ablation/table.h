#pragma once
#include "ablation/measure.h"

#include <optional>
#include <string>
#include <vector>

namespace daumier::ablation {

/// What a run cost.
struct RunCost {
  int64_t steps = 0, parameters = 0;
  double train_seconds = 0;
  struct Inference {
    double ms = 0;
    int threads = 0;
  };
  std::optional<Inference> inference = {};  ///< Nothing where it was not measured.
};

/// A row of the table on one split with one seed.
struct AblationResult {
  std::string name, split;
  uint64_t seed = 0;
  bool baseline = false;
  double paper = 0;  ///< 0: the paper has none.
  AblationMeasure measure = {};
  std::optional<RunCost> cost = {};  ///< Nothing where nothing was trained.
};

/// table.json: one object a split and row, splits and rows in the order of `results`, but baselines before rows.
/// Keys: name, split, baseline, paper, unit, error, error_low, error_high, errors, seeds, difference_to, difference,
/// difference_low, difference_high, steps, parameters, train_seconds, infer_ms, infer_threads, and those of
/// AblationMeasure::more; null where unknown.
///   error                  of test faces, or where measured_on is "validation", of those: the mean over seeds of
///                          `errors`, one a seed; steps, costs and further numbers likewise
///   error_low, error_high  95 % interval. Of one seed: the report's own. Of several: PersonBootstrap of all test faces
///                          of all seeds; seeds are not resampled
///   difference             error minus the error of `difference_to`: the row `compare_to`, or if it is empty the first
///                          row of the split that has face errors. The mean over the test faces of all seeds that both
///                          have, and the same bootstrap of these paired differences
/// @throws Error if two results on one split and seed have a different number of faces.
Json AblationTableJson(const std::vector<AblationResult>& results, const std::string& compare_to = "");

}  // namespace daumier::ablation
