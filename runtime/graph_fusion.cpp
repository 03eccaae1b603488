#include "runtime/graph_fusion.h"

#include "core/error.h"
#include "runtime/finite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace daumier::runtime {
namespace {

constexpr size_t kWeights = 1, kBias = 2;

/// A graph while nodes are removed from it; positions do not change until Take.
class Fusion {
 public:
  explicit Fusion(Graph graph) : graph_(std::move(graph)), removed_(graph_.nodes.size()) {
    for (size_t i = 0; i < graph_.nodes.size(); ++i) {
      producers_[graph_.nodes[i].output] = i;
      for (const std::string& input : graph_.nodes[i].inputs) ++reads_[input];
    }
    for (const std::string& output : graph_.outputs) ++reads_[output];
  }

  void FuseAll() {
    for (size_t i = 0; i < graph_.nodes.size(); ++i) {
      const std::string& op = graph_.nodes[i].op;
      if (op == "Identity") FuseIdentity(i);
      if (op == "BatchNormalization") FuseBatchNorm(i);
      if (op == "Add") FuseGroupNorm(i);
      if (op == "Add") FuseSum(i);
      if (op == "Relu" || op == "LeakyRelu" || op == "Sigmoid" || op == "Tanh") FuseActivation(i);
    }
  }

  Graph Take() {
    std::vector<GraphNode> kept;
    for (size_t i = 0; i < graph_.nodes.size(); ++i)
      if (!removed_[i]) kept.push_back(std::move(graph_.nodes[i]));
    graph_.nodes = std::move(kept);
    std::set<std::string> read;
    for (const GraphNode& node : graph_.nodes) read.insert(node.inputs.begin(), node.inputs.end());
    std::erase_if(graph_.weights, [&](const auto& weight) { return !read.contains(weight.first); });
    return std::move(graph_);
  }

 private:
  /// The node that computes `name`, if `reader` alone reads it.
  GraphNode* OnlyFor(const std::string& name) {
    const auto producer = producers_.find(name);
    return producer != producers_.end() && reads_[name] == 1 ? &graph_.nodes[producer->second] : nullptr;
  }
  /// Node `from`, computed at the place of node `at` and with its output.
  void Move(GraphNode& from, size_t at) {
    removed_[size_t(&from - graph_.nodes.data())] = true;
    from.output = graph_.nodes[at].output;
    graph_.nodes[at] = std::move(from);
    producers_[graph_.nodes[at].output] = at;
  }
  const GraphTensor* NumbersOf(const GraphNode& node, size_t input) const {
    if (!node.Reads(input)) return nullptr;
    const auto found = graph_.weights.find(node.inputs[input]);
    return found == graph_.weights.end() || found->second.has_integers ? nullptr : &found->second;
  }

  /// An output's identity gives its name to the node before it.
  void FuseIdentity(size_t at) {
    const GraphNode& node = graph_.nodes[at];
    if (node.inputs.size() != 1) return;
    if (GraphNode* const before = OnlyFor(node.inputs[0])) Move(*before, at);
  }

  void FuseBatchNorm(size_t at) {
    const GraphNode& norm = graph_.nodes[at];
    if (norm.inputs.size() != 5) return;
    GraphNode* const before = OnlyFor(norm.inputs[0]);
    if (before == nullptr || before->op != "Conv" || before->attributes.contains(kActivation) || before->Reads(kAddend))
      return;
    const GraphTensor* const weights = NumbersOf(*before, kWeights);
    if (weights == nullptr || weights->shape.size() < 2 || weights->shape[0] == 0) return;
    const auto channels = size_t(weights->shape[0]);
    std::array<const GraphTensor*, 4> norms;  // scale, shift, mean, variance
    for (size_t i = 0; i < norms.size(); ++i) {
      norms[i] = NumbersOf(norm, i + 1);
      if (norms[i] == nullptr || norms[i]->numbers.size() != channels) return;
    }
    const GraphTensor* const bias = NumbersOf(*before, kBias);
    if (before->Reads(kBias) && (bias == nullptr || bias->numbers.size() != channels)) return;
    GraphTensor scaled = *weights, shifted{.shape = {int64_t(channels)}, .numbers = std::vector<float>(channels)};
    const size_t row = weights->numbers.size() / channels;
    const double epsilon = norm.Real("epsilon", 1e-5f);
    for (size_t c = 0; c < channels; ++c) {
      const double scale = norms[0]->numbers[c] / std::sqrt(double(norms[3]->numbers[c]) + epsilon);
      for (size_t i = 0; i < row; ++i) scaled.numbers[c * row + i] = float(scale * scaled.numbers[c * row + i]);
      const double offset = bias == nullptr ? 0 : bias->numbers[c];
      shifted.numbers[c] = float(norms[1]->numbers[c] + scale * (offset - norms[2]->numbers[c]));
    }
    DAUMIER_CHECK(AreFinite(scaled.numbers) && AreFinite(shifted.numbers), "{} makes numbers that are not finite",
                  norm.Text());
    before->inputs.resize(3);
    before->inputs[kWeights] = AddWeight(norm.name + "/weights", std::move(scaled));
    before->inputs[kBias] = AddWeight(norm.name + "/bias", std::move(shifted));
    Move(*before, at);
  }

  std::string AddWeight(std::string name, GraphTensor tensor) {
    while (graph_.weights.contains(name) || producers_.contains(name)) name += "'";
    ++reads_[name];
    graph_.weights.emplace(name, std::move(tensor));
    return name;
  }

  /// The node of `op` that computes one input of `node`, if nothing else reads it, and the weight that is the other
  /// one, of a number for each channel of an image: (C, 1, 1) or (1, C, 1, 1).
  struct ByChannel {
    const GraphNode* node = nullptr;
    const GraphTensor* weight = nullptr;
  };
  ByChannel OfChannels(const GraphNode& node, const std::string& op) {
    if (node.inputs.size() != 2) return {};
    for (size_t i = 0; i < 2; ++i) {
      const GraphTensor* const weight = NumbersOf(node, i);
      const GraphNode* const before = OnlyFor(node.inputs[1 - i]);
      if (weight == nullptr || before == nullptr || before->op != op) continue;
      const Shape& shape = weight->shape;
      const auto count = int64_t(weight->numbers.size());
      if (count > 1 && (shape == Shape{count, 1, 1} || shape == Shape{1, count, 1, 1})) return {before, weight};
    }
    return {};
  }

  /// The node of `op` that computes input 0 of `node`, if nothing else reads it.
  const GraphNode* OnlyBefore(const GraphNode* node, const std::string& op) {
    const GraphNode* const before = node == nullptr || !node->Reads(0) ? nullptr : OnlyFor(node->inputs[0]);
    return before != nullptr && before->op == op ? before : nullptr;
  }

  /// PyTorch's group norm before set 18: groups are seen as channels, normalised, seen as channels again, scaled.
  void FuseGroupNorm(size_t at) {
    const auto [product, shifts] = OfChannels(graph_.nodes[at], "Mul");
    const auto [back, scales] = product == nullptr ? ByChannel{} : OfChannels(*product, "Reshape");
    const GraphNode* const norm = OnlyBefore(back, "InstanceNormalization");
    const GraphNode* const to_groups = OnlyBefore(norm, "Reshape");
    if (to_groups == nullptr || to_groups->inputs.size() != 2 || back->inputs.size() != 2 || norm->inputs.size() != 3)
      return;
    const auto shape = producers_.find(back->inputs[1]);
    if (shape == producers_.end() || graph_.nodes[shape->second].op != "Shape" ||
        graph_.nodes[shape->second].inputs[0] != to_groups->inputs[0] ||
        !graph_.nodes[shape->second].attributes.empty())
      return;
    const auto groups = graph_.weights.find(to_groups->inputs[1]);
    const GraphTensor *const ones = NumbersOf(*norm, 1), *const zeros = NumbersOf(*norm, 2);
    if (groups == graph_.weights.end() || groups->second.integers.size() != 3 || ones == nullptr || zeros == nullptr)
      return;
    const std::vector<int64_t>& seen = groups->second.integers;
    const auto is_all = [&](const GraphTensor& tensor, float number) {
      return int64_t(tensor.numbers.size()) == seen[1] && std::ranges::count(tensor.numbers, number) == seen[1];
    };
    if (seen[0] != 0 || seen[1] < 1 || seen[2] != -1 || !is_all(*ones, 1) || !is_all(*zeros, 0)) return;
    if (shifts->numbers.size() != scales->numbers.size()) return;
    const auto channels = int64_t(scales->numbers.size());
    GraphNode fused{.op = "GroupNormalization", .name = graph_.nodes[at].name};
    fused.attributes = {{"num_groups", seen[1]}, {"epsilon", norm->Real("epsilon", 1e-5f)}, {"of_images", int64_t{1}}};
    fused.inputs = {to_groups->inputs[0],
                    AddWeight(fused.name + "/scale", {.shape = {channels}, .numbers = scales->numbers}),
                    AddWeight(fused.name + "/shift", {.shape = {channels}, .numbers = shifts->numbers})};
    fused.output = graph_.nodes[at].output;
    for (const GraphNode* const node : {to_groups, norm, back, product})
      removed_[size_t(node - graph_.nodes.data())] = true;
    graph_.nodes[at] = std::move(fused);
  }

  /// A sum whose later operand is a convolution's.
  void FuseSum(size_t at) {
    const GraphNode sum = graph_.nodes[at];
    if (sum.op != "Add" || sum.inputs.size() != 2 || sum.inputs[0] == sum.inputs[1]) return;
    std::optional<size_t> best;
    for (size_t i = 0; i < 2; ++i) {
      const GraphNode* const before = OnlyFor(sum.inputs[i]);
      if (before == nullptr || before->op != "Conv" || before->attributes.contains(kActivation) ||
          before->Reads(kAddend) || graph_.weights.contains(sum.inputs[1 - i]))
        continue;
      if (best && producers_.at(sum.inputs[*best]) > producers_.at(sum.inputs[i])) continue;
      best = i;
    }
    if (!best) return;
    GraphNode& convolution = graph_.nodes[producers_.at(sum.inputs[*best])];
    convolution.inputs.resize(kAddend + 1);
    convolution.inputs[kAddend] = sum.inputs[1 - *best];
    Move(convolution, at);
  }

  void FuseActivation(size_t at) {
    const GraphNode& activation = graph_.nodes[at];
    if (activation.inputs.size() != 1) return;
    GraphNode* const before = OnlyFor(activation.inputs[0]);
    if (before == nullptr || before->attributes.contains(kActivation)) return;
    const bool follows_norm = before->op == "InstanceNormalization" && activation.op == "Relu";
    if (before->op != "Conv" && before->op != "Gemm" && !follows_norm) return;
    before->attributes[kActivation] = activation.op;
    before->attributes[kActivationAlpha] = activation.op == "LeakyRelu" ? activation.Real("alpha", 0.01f) : 0.0f;
    Move(*before, at);
  }

  Graph graph_;
  std::vector<bool> removed_;
  std::map<std::string, size_t> producers_;
  std::map<std::string, int> reads_;
};

}  // namespace

Graph Fused(Graph graph) {
  Fusion fusion(std::move(graph));
  fusion.FuseAll();
  return fusion.Take();
}

}  // namespace daumier::runtime
