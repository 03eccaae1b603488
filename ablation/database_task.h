#pragma once
#include "ablation/task.h"

#include <functional>
#include <string>

namespace daumier::ablation {

/// What ablations have in common whose runs are folders of train/run_folder.h, trained on the databases that `data` of
/// their config names, whose reports hold a `table` and tell which faces were tested, and whose errors are millimetres.
class DatabaseAblation : public AblationTask {
 public:
  /// device: of the training, "cpu" or "cuda".
  explicit DatabaseAblation(std::string device = "cpu") : device_(std::move(device)) {}

  bool Finished(const std::filesystem::path& run, const Json& config) const override;
  void Train(const Json& config, const std::filesystem::path& run) const override;
  std::string unit() const override { return "mm"; }
  std::string validation_metric() const override { return "mean_vertex_error_mm"; }
  bool HasLine(const Json& metrics, const std::string& line) const override;
  std::string TestedOn(const Json& metrics) const override;

 protected:
  /// Trains anew, or goes on with what is there if `resume`.
  virtual void TrainRun(const Json& config, const std::filesystem::path& run, bool resume,
                        const std::string& device) const = 0;
  /// Of many calls, the median of their milliseconds.
  static double MedianMs(const std::function<void()>& answer);

 private:
  std::string device_;
};

}  // namespace daumier::ablation
