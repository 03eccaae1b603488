#include "systems/deform/train/system.h"

#include "core/median_time.h"
#include "export/run_export.h"
#include "systems/deform/train/evaluation.h"
#include "systems/deform/train/export.h"
#include "systems/deform/train/run.h"
#include "systems/deform/train/surface_decoder.h"
#include "systems/deform/train/training.h"

namespace daumier::deform {
namespace {

reports::Evaluation Evaluate(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                             const Task& task) {
  return EvaluateDeformRun(run, ParseOptions<DeformEvalOptions>(options), databases, task);
}

double InferMs(const std::filesystem::path& run) {
  const DeformRun loaded = LoadDeformRun(run);
  return MedianMs([&] { SurfaceDecoder(loaded.network, loaded.codes[0]).Vertices(); });
}

}  // namespace

systems::SystemTraining DeformTraining() {
  return {.name = kSystem,
          .train = TrainDeform,
          .evaluate = Evaluate,
          .describe_export = DescribeDeformExport,
          .infer_ms = InferMs,
          .validation_metric = "mean_vertex_error_mm", .training_metric = "training_error_mm"};
}

}  // namespace daumier::deform
