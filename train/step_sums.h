#pragma once
#include <torch/types.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace daumier::train {

/// A number of a step that is NaN or infinite.
struct NotFinite {
  int64_t step;
  std::string name;
  double value;
};

/// Sums of the named numbers of steps. They are kept on the device of the training, so that Add does not wait for it;
/// all that returns numbers does.
class StepSums {
 public:
  /// The numbers of a step: scalars on one device. The first step with a number that is not finite is remembered until
  /// a step has other names.
  void Add(int64_t step, const std::map<std::string, torch::Tensor>& numbers);
  /// Number of steps since Clear.
  int num_steps() const { return num_steps_; }
  /// Totals since Clear, of all steps. A name that some steps lack counts as 0 in these.
  std::map<std::string, double> Totals() const;
  void Clear();
  /// Continues from the totals of num_steps steps.
  void Load(std::map<std::string, double> totals, int num_steps);

  /// Of the first step that had one, "loss" before all others and "gradient_norm" after them.
  std::optional<NotFinite> FirstNotFinite() const;

 private:
  std::map<std::string, double> totals_;  ///< Of names that the last step did not have.
  int num_steps_ = 0;
  std::vector<std::string> names_;  ///< Of the tensors' entries.
  torch::Tensor sums_;              ///< (K) float64
  torch::Tensor bad_step_;          ///< () int64, -1: none.
  torch::Tensor bad_numbers_;       ///< (K) float64, of that step.
};

}  // namespace daumier::train
