#pragma once
#include "runtime/graph.h"
#include "runtime/network_runner.h"

#include <memory>
#include <string>
#include <vector>

namespace daumier::runtime {

/// A graph, run on oneDNN. Its convolutions give LibTorch's bits wherever LibTorch itself uses oneDNN in blocks of
/// channels, but for batch norms, which are part of the weights here. A plan is made at the first run of inputs of a
/// shape, by the number of threads that OpenMP has in the calling thread; the last kMostPlans are kept.
class GraphRunner : public NetworkRunner {
 public:
  static constexpr size_t kMostPlans = 4;

  /// @throws Error as CheckGraph.
  explicit GraphRunner(Graph graph);
  ~GraphRunner() override;

  /// @throws Error naming an input that is missing, has another shape, is empty or is not finite; a node that cannot be
  /// computed with inputs of these shapes.
  NamedArrays Run(const NamedArrays& inputs) const override;

  /// How inputs of these shapes are run: a step a line, its node and the code that computes it, "ours" for our own.
  struct Step {
    std::string node, kernel;
  };
  std::vector<Step> StepsFor(const NamedArrays& inputs) const;
  /// Bytes of one run's memory, without weights, inputs and outputs.
  int64_t BytesFor(const NamedArrays& inputs) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace daumier::runtime
