#include "runtime/graph_runner.h"

#include "core/error.h"
#include "runtime/constant_folding.h"
#include "runtime/finite.h"
#include "runtime/graph_fusion.h"
#include "runtime/plan_builder.h"

#include <algorithm>
#include <list>

namespace daumier::runtime {
namespace {

using InputShapes = std::map<std::string, Shape>;

/// The shapes of a graph's inputs. @throws Error as GraphRunner::Run.
InputShapes ShapesOf(const Graph& graph, const NamedArrays& inputs) {
  InputShapes shapes;
  for (const GraphInput& input : graph.inputs) {
    const auto found = inputs.find(input.name);
    DAUMIER_CHECK(found != inputs.end(), "the network reads '{}', which is missing", input.name);
    const Shape& shape = found->second.shape;
    const bool fits = std::ranges::equal(shape, input.shape, [](int64_t size, int64_t expected) {
      return size > 0 && (expected == -1 || size == expected);
    });
    DAUMIER_CHECK(fits, "the input '{}' is {}, expected {} (-1: any size but 0)", input.name, ShapeText(shape),
                  ShapeText(input.shape));
    DAUMIER_CHECK(CheckedSize(shape, "the input") == int64_t(found->second.values.size()),
                  "the input '{}' has {} numbers for the shape {}", input.name, found->second.values.size(),
                  ShapeText(shape));
    DAUMIER_CHECK(AreFinite(found->second.values), "the input '{}' has numbers that are not finite", input.name);
    shapes[input.name] = shape;
  }
  return shapes;
}

Graph Checked(Graph graph) {
  CheckGraph(graph);
  return Fused(FoldedConstants(std::move(graph)));
}

}  // namespace

struct GraphRunner::State {
  /// A plan of inputs of these shapes, by a number of threads.
  struct Entry {
    InputShapes shapes;
    int threads;
    std::shared_ptr<const Plan> plan;
  };

  explicit State(Graph of_graph) : graph(Checked(std::move(of_graph))) {}

  std::shared_ptr<const Plan> PlanFor(const NamedArrays& inputs) {
    const InputShapes shapes = ShapesOf(graph, inputs);
    const int threads = OpenMpThreads();
    const std::lock_guard lock(mutex);
    const auto found = std::ranges::find_if(
        plans, [&](const Entry& entry) { return entry.threads == threads && entry.shapes == shapes; });
    if (found != plans.end()) {
      plans.splice(plans.begin(), plans, found);
    } else {
      try {
        plans.push_front({shapes, threads, PlanBuilder(graph, shapes, packed).Build()});
      } catch (const dnnl::error& error) {
        throw Error(fmt::format("oneDNN refuses the graph: {}", error.what()));
      }
      if (plans.size() > kMostPlans) plans.pop_back();
    }
    return plans.front().plan;
  }

  const Graph graph;
  std::mutex mutex;
  PackedWeights packed;
  std::list<Entry> plans;  ///< The last one used first.
};

GraphRunner::GraphRunner(Graph graph) : state_(std::make_unique<State>(std::move(graph))) {}

GraphRunner::~GraphRunner() = default;

NamedArrays GraphRunner::Run(const NamedArrays& inputs) const {
  return state_->PlanFor(inputs)->Run(inputs);
}

std::vector<GraphRunner::Step> GraphRunner::StepsFor(const NamedArrays& inputs) const {
  std::vector<Step> steps;
  for (const PlanStep& step : state_->PlanFor(inputs)->steps()) steps.push_back({step.node, step.kernel});
  return steps;
}

int64_t GraphRunner::BytesFor(const NamedArrays& inputs) const {
  return state_->PlanFor(inputs)->arena_size() * int64_t(sizeof(float));
}

}  // namespace daumier::runtime
