#include "systems/sketch/train/parser_run.h"

#include "core/run_manifest.h"
#include "systems/sketch/train/parser_network.h"
#include "tensor/module_state.h"

namespace daumier::sketch {

ParserRun LoadParserRun(const std::filesystem::path& directory) {
  ParserRun run{ReadParserRunFolder(directory), models::HeatMapUnet(nullptr)};
  run.network = MakeParserNetwork(run.network_options);
  tensor::LoadModule(BestWeights(directory), *run.network);
  run.network->eval();
  for (torch::Tensor& parameter : run.network->parameters()) parameter.requires_grad_(false);
  return run;
}

}  // namespace daumier::sketch
