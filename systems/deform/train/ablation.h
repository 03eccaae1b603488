#pragma once
#include "ablation/database_task.h"

#include <string>

namespace daumier::deform {

/// An ablation of deformable models: runs of TrainDeform, reports of EvaluateDeformRun, errors in millimetres.
class DeformAblation : public ablation::DatabaseAblation {
 public:
  using ablation::DatabaseAblation::DatabaseAblation;

  /// `split` is split.kind. Paths of data are made absolute.
  Json ResolvedConfig(Json config, uint64_t seed, const std::string& split, const std::string& where) const override;
  Json ResolvedEval(const Json& eval, const std::string& where) const override;
  std::vector<std::string> references() const override { return {}; }

  void Evaluate(const std::filesystem::path& run, const Json& eval, const std::filesystem::path& report) const override;
  /// From a code to all vertices, what depends on the code included.
  double InferMs(const std::filesystem::path& run) const override;

  std::string training_metric() const override { return "training_error_mm"; }
  std::vector<std::string> baselines() const override;
  /// By default the report's own result, whose face errors alone are known.
  ablation::AblationMeasure Measure(const Json& metrics, const std::string& line, const std::string& shape_input) const override;
  void WriteSheet(const std::vector<ablation::AblationPicture>& rows, const std::filesystem::path& file) const override;

 protected:
  void TrainRun(const Json& config, const std::filesystem::path& run, bool resume,
                const std::string& device) const override;
};

}  // namespace daumier::deform
