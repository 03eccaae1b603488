#include "systems/deform/train/system.h"

#include "export/run_export.h"
#include "systems/deform/run_folder.h"
#include "systems/deform/train/evaluation.h"
#include "systems/deform/train/export.h"
#include "systems/deform/train/training.h"

namespace daumier::deform {
namespace {

Json EvaluateInto(const std::filesystem::path& run, const Json& options, const std::filesystem::path& out,
                  const Task&) {
  return EvaluateDeformRun(run, out, ParseOptions<DeformEvalOptions>(options));
}

}  // namespace

systems::SystemTraining DeformTraining() {
  return {.name = kSystem,
          .train = TrainDeform,
          .evaluate_into = EvaluateInto,
          .describe_export = DescribeDeformExport,
          .validation_metric = "mean_vertex_error_mm",
          .training_metric = "training_error_mm"};
}

}  // namespace daumier::deform
