#include "systems/sketch/train/gesture_run.h"

#include "core/run_manifest.h"
#include "systems/sketch/train/gesture_network.h"
#include "tensor/module_state.h"

namespace daumier::sketch {

GestureRun LoadGestureRun(const std::filesystem::path& directory) {
  GestureRun run{ReadGestureRunFolder(directory)};
  run.network = MakeGestureNetwork(run.network_options);
  tensor::LoadModule(BestWeights(directory), *run.network);
  run.network->eval();
  for (torch::Tensor& parameter : run.network->parameters()) parameter.requires_grad_(false);
  return run;
}

}  // namespace daumier::sketch
