#include "systems/portrait/train/portrait_run.h"

#include "core/run_manifest.h"
#include "tensor/module_state.h"

namespace daumier::portrait {

PortraitRun LoadPortraitRun(const std::filesystem::path& directory) {
  PortraitRun run{ReadPortraitRunFolder(directory), PortraitNetwork(nullptr)};
  run.network = PortraitNetwork(run.options.network, run.model.expression_weights);
  tensor::LoadModule(BestWeights(directory), *run.network);
  run.network->eval();
  for (const torch::Tensor& parameter : run.network->parameters()) parameter.requires_grad_(false);
  return run;
}

}  // namespace daumier::portrait
