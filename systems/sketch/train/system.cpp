#include "systems/sketch/train/system.h"

#include "export/run_export.h"
#include "systems/sketch/run_folder.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/external_evaluation.h"
#include "systems/sketch/train/training.h"

namespace daumier::sketch {
namespace {

Json EvaluateInto(const std::filesystem::path& run, const Json& options, const std::filesystem::path& out,
                  const Task&) {
  if (options.contains("faces")) return EvaluateOnOtherFaces(run, out, ParseOptions<OtherFacesOptions>(options));
  return EvaluateSketchRun(run, out, ParseOptions<SketchEvalOptions>(options));
}

}  // namespace

systems::SystemTraining SketchTraining() {
  return {.name = kSystem,
          .train = TrainSketch,
          .evaluate_into = EvaluateInto,
          .describe_export = DescribeSketchExport,
          .validation_metric = "mean_vertex_error_mm"};
}

}  // namespace daumier::sketch
