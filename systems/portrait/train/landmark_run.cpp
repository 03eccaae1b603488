#include "systems/portrait/train/landmark_run.h"

#include "core/run_manifest.h"
#include "systems/portrait/train/landmark_network.h"
#include "tensor/module_state.h"

namespace daumier::portrait {

LandmarkRun LoadLandmarkRun(const std::filesystem::path& directory) {
  LandmarkRun run{ReadLandmarkRunFolder(directory), models::HeatMapUnet(nullptr)};
  run.network = MakeLandmarkNetwork(run.network_options);
  tensor::LoadModule(BestWeights(directory), *run.network);
  run.network->eval();
  for (torch::Tensor& parameter : run.network->parameters()) parameter.requires_grad_(false);
  return run;
}

}  // namespace daumier::portrait
