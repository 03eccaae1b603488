#include "systems/deform/system.h"

#include "core/error.h"
#include "core/training.h"
#include "systems/deform/evaluation_options.h"
#include "systems/deform/metrics.h"
#include "systems/deform/options.h"
#include "systems/deform/run_folder.h"

namespace daumier::deform {

systems::System DeformSystem() {
  return {
      .name = kSystem,
      .room = "systems/deform",
      .training_help = [] { return HelpText<DeformTrainingOptions>(); },
      .evaluation_help = [] { return HelpText<DeformEvalOptions>(); },
      .resolve_config =
          [](const Json& config, const std::string& where) {
            return ToJson(ParseTraining<DeformTrainingOptions>(config, where));
          },
      .resolve_evaluation =
          [](const Json& options, const std::string& where) {
            const auto parsed = ParseOptions<DeformEvalOptions>(options, where);
            if (!parsed.faces.empty() && parsed.split != DeformEvalOptions().split)
              throw UsageError(fmt::format("{}: faces excludes split (all of these faces are measured)", where));
            return ToJson(parsed);
          },
      .read_metrics = ReadDeformMetrics,
      .summary_columns = DeformSummaryColumns,
  };
}

}  // namespace daumier::deform
