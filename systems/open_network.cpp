#include "systems/open_network.h"

#include "core/run_manifest.h"
#include "core/weights_folder.h"
#include "runtime/graph_runner.h"
#include "runtime/onnx_file.h"
#include "systems/training_library.h"

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

/// The file of the graph, which has been compared with its checksum; empty if there is none.
fs::path GraphFile(const fs::path& run_or_weights) {
  const bool is_weights = IsWeightsFolder(run_or_weights);
  const Manifest manifest =
      is_weights ? ReadWeights(run_or_weights, "", {kWeightsNetwork}) : ReadFinishedRun(run_or_weights);
  const char* const graph = is_weights ? kWeightsGraph : kBestGraph;
  return manifest.checksums.contains(graph) ? run_or_weights / graph : fs::path();
}

}  // namespace

std::unique_ptr<runtime::NetworkRunner> OpenNetwork(const fs::path& run_or_weights, const Device& device) {
  if (device == Device{})
    if (const fs::path graph = GraphFile(run_or_weights); !graph.empty())
      return std::make_unique<runtime::GraphRunner>(runtime::ReadOnnx(graph));
  return LoadTrainingLibrary().open_network(run_or_weights, device);
}

}  // namespace daumier::systems
