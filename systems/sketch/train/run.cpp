#include "systems/sketch/train/run.h"

#include "core/run_manifest.h"
#include "tensor/module_state.h"

namespace daumier::sketch {

SketchRun LoadSketchRun(const std::filesystem::path& directory) {
  SketchRun run{ReadSketchRunFolder(directory), SketchNetwork(nullptr)};
  run.network = SketchNetwork(run.network_options, run.models);
  tensor::LoadModule(BestWeights(directory), *run.network);
  run.network->eval();
  for (torch::Tensor& parameter : run.network->parameters()) parameter.requires_grad_(false);
  return run;
}

}  // namespace daumier::sketch
