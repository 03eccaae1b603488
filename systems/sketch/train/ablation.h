#pragma once
#include "ablation/database_task.h"

#include <string>

namespace daumier::sketch {

/// An ablation of sketch networks: runs of TrainSketch, reports of EvaluateSketchRun, errors in millimetres.
class SketchAblation : public ablation::DatabaseAblation {
 public:
  using ablation::DatabaseAblation::DatabaseAblation;

  /// `split` is split.kind. Paths of data are made absolute.
  Json ResolvedConfig(Json config, uint64_t seed, const std::string& split, const std::string& where) const override;
  Json ResolvedEval(const Json& eval, const std::string& where) const override;
  std::vector<std::string> references() const override { return {"recover_with"}; }

  void Evaluate(const std::filesystem::path& run, const Json& eval, const std::filesystem::path& report) const override;
  double InferMs(const std::filesystem::path& run) const override;

  std::vector<std::string> baselines() const override;
  /// By default the report's own result: the network with the shape input that metrics.json tells. Its face errors
  /// alone are known.
  ablation::AblationMeasure Measure(const Json& metrics, const std::string& line, const std::string& shape_input) const override;
  void WriteSheet(const std::vector<ablation::AblationPicture>& rows, const std::filesystem::path& file) const override;

 protected:
  void TrainRun(const Json& config, const std::filesystem::path& run, bool resume,
                const std::string& device) const override;
};

}  // namespace daumier::sketch
