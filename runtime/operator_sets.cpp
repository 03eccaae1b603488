#include "runtime/operator_sets.h"

#include "core/error.h"

#include <algorithm>
#include <set>

namespace daumier::runtime {
namespace {

GraphTensor TensorOf(std::vector<int64_t> integers) {
  return {.shape = {int64_t(integers.size())}, .integers = std::move(integers), .has_integers = true};
}
GraphTensor TensorOf(std::vector<float> numbers) {
  return {.shape = {int64_t(numbers.size())}, .numbers = std::move(numbers)};
}

/// A node on its way into the graph.
class Rewriting {
 public:
  Rewriting(StoredNode stored, int64_t operator_set, Graph& graph)
      : operator_set_(operator_set), node_(std::move(stored.node)), outputs_(std::move(stored.outputs)), graph_(graph) {
    while (!outputs_.empty() && outputs_.back().empty()) outputs_.pop_back();
    if (!outputs_.empty()) node_.output = outputs_.front();
  }

  void Add() {
    const std::string op = node_.op;
    if (op == "Constant") return AddConstant();
    if (op == "Split") return AddParts();
    if (op == "Sum" || op == "Max" || op == "Min") return AddChain();
    if (op == "Dropout") AsIdentity();
    if (op == "Pad" && operator_set_ < 11) PadsAsInputs();
    if (op == "Upsample") UpsampleAsResize();
    if (op == "Resize") AsLaterResize();
    if (op == "Slice" && operator_set_ < 10) IntegersAsInputs({{"starts", 1}, {"ends", 2}, {"axes", 3}});
    if (op == "Clip" && operator_set_ < 11) BoundsAsInputs();
    if (op == "Squeeze" || op == "Unsqueeze" || op.starts_with("Reduce")) IntegersAsInputs({{"axes", 1}});
    if ((op == "Softmax" || op == "LogSoftmax") && operator_set_ < 13) FlattenSoftmax();
    if (op == "GroupNormalization" && operator_set_ < 21) node_.attributes["scales_groups"] = int64_t{1};
    DropOutputsOfTraining();
    DAUMIER_CHECK(outputs_.size() == 1, "{} has {} outputs, expected one", node_.Text(), outputs_.size());
    Push(std::move(node_));
  }

 private:
  void Push(GraphNode node) {
    DAUMIER_CHECK(graph_.nodes.size() < kMostNodes, "the graph has more than {} nodes", kMostNodes);
    graph_.nodes.push_back(std::move(node));
  }

  std::string AddWeight(const std::string& what, GraphTensor tensor) {
    std::string name = node_.output + "/" + what;
    while (graph_.weights.contains(name)) name += "'";
    graph_.weights.emplace(name, std::move(tensor));
    return name;
  }
  void SetInput(size_t input, const std::string& name) {
    if (node_.inputs.size() <= input) node_.inputs.resize(input + 1);
    node_.inputs[input] = name;
  }
  void IntegersAsInputs(const std::vector<std::pair<std::string, size_t>>& places) {
    for (const auto& [attribute, input] : places) {
      if (!node_.Has(attribute)) continue;
      SetInput(input, AddWeight(attribute, TensorOf(node_.Integers(attribute, {}))));
      node_.attributes.erase(attribute);
    }
  }

  void AddConstant() {
    DAUMIER_CHECK(outputs_.size() == 1 && node_.attributes.size() == 1,
                  "{} has {} outputs and {} attributes, expected one", node_.Text(), outputs_.size(),
                  node_.attributes.size());
    const auto& [name, value] = *node_.attributes.begin();
    GraphTensor tensor;
    if (const auto* const of_file = std::get_if<GraphTensor>(&value))
      tensor = *of_file;
    else if (const auto* const reals = std::get_if<std::vector<float>>(&value))
      tensor = TensorOf(*reals);
    else if (const auto* const integers = std::get_if<std::vector<int64_t>>(&value))
      tensor = TensorOf(*integers);
    else if (const auto* const real = std::get_if<float>(&value))
      tensor = {.shape = {}, .numbers = {*real}};
    else if (const auto* const integer = std::get_if<int64_t>(&value))
      tensor = {.shape = {}, .integers = {*integer}, .has_integers = true};
    else
      throw Error(fmt::format("{} has the attribute '{}' of text", node_.Text(), name));
    const bool is_new = graph_.weights.emplace(node_.output, std::move(tensor)).second;
    DAUMIER_CHECK(is_new, "the name '{}' is given to two tensors", node_.output);
  }

  /// A node for each part; parts that nothing reads have no name.
  void AddParts() {
    IntegersAsInputs({{"split", 1}});
    node_.attributes["parts"] = node_.Integer("num_outputs", int64_t(outputs_.size()));
    for (size_t i = 0; i < outputs_.size(); ++i) {
      if (outputs_[i].empty()) continue;
      GraphNode part = node_;
      part.attributes["part"] = int64_t(i);
      part.output = outputs_[i];
      Push(std::move(part));
    }
  }

  /// f(a, b, c) = f(f(a, b), c).
  void AddChain() {
    DAUMIER_CHECK(!node_.inputs.empty() && outputs_.size() == 1, "{} has {} inputs and {} outputs", node_.Text(),
                  node_.inputs.size(), outputs_.size());
    const std::vector<std::string> inputs = std::move(node_.inputs);
    if (node_.op == "Sum") node_.op = "Add";
    if (inputs.size() == 1) node_.op = "Identity";
    node_.inputs = {inputs[0]};
    const std::string output = node_.output;
    for (size_t i = 1; i < inputs.size(); ++i) {
      node_.inputs = {i == 1 ? inputs[0] : node_.output, inputs[i]};
      node_.output = i + 1 == inputs.size() ? output : fmt::format("{}/{}", output, i);
      if (i + 1 < inputs.size()) Push(node_);
    }
    Push(std::move(node_));
  }

  void AsIdentity() {
    node_.op = "Identity";
    node_.inputs.resize(std::min<size_t>(node_.inputs.size(), 1));
    node_.attributes.clear();
    outputs_.resize(std::min<size_t>(outputs_.size(), 1));
  }

  void PadsAsInputs() {
    IntegersAsInputs({{"pads", 1}});
    if (node_.Has("value")) SetInput(2, AddWeight("value", {.shape = {}, .numbers = {node_.Real("value", 0)}}));
  }

  void BoundsAsInputs() {
    size_t input = 1;
    for (const char* const bound : {"min", "max"}) {
      if (node_.Has(bound)) SetInput(input, AddWeight(bound, {.shape = {}, .numbers = {node_.Real(bound, 0)}}));
      ++input;
    }
  }

  void UpsampleAsResize() {
    DAUMIER_CHECK(node_.inputs.size() == 2, "{} has {} inputs, expected two", node_.Text(), node_.inputs.size());
    node_.op = "Resize";
    node_.inputs.insert(node_.inputs.begin() + 1, "");
    AsymmetricPlaces();
  }
  void AsLaterResize() {
    if (operator_set_ < 11) {
      DAUMIER_CHECK(node_.inputs.size() == 2, "{} has {} inputs, expected two", node_.Text(), node_.inputs.size());
      node_.inputs.insert(node_.inputs.begin() + 1, "");
      AsymmetricPlaces();
    }
    if (node_.inputs.size() > 1) node_.inputs[1] = "";  // The region, which the modes that are run ignore.
    for (size_t i = 2; i < node_.inputs.size(); ++i)    // An empty tensor is an absent one.
      if (const auto found = graph_.weights.find(node_.inputs[i]);
          found != graph_.weights.end() && found->second.numbers.empty() && found->second.integers.empty())
        node_.inputs[i] = "";
  }
  void AsymmetricPlaces() {
    node_.attributes["coordinate_transformation_mode"] = std::string("asymmetric");
    node_.attributes["nearest_mode"] = std::string("floor");
  }

  void FlattenSoftmax() {
    node_.attributes["axis"] = node_.Integer("axis", 1);
    node_.attributes["flattens"] = int64_t{1};
  }

  void DropOutputsOfTraining() {
    static const std::set<std::string> kNames = {"BatchNormalization", "InstanceNormalization", "LayerNormalization",
                                                 "MaxPool"};
    if (!kNames.contains(node_.op) || outputs_.empty()) return;
    DAUMIER_CHECK(node_.Integer("training_mode", 0) == 0, "{} is in the form of training", node_.Text());
    outputs_.resize(1);
  }

  int64_t operator_set_;
  GraphNode node_;
  std::vector<std::string> outputs_;
  Graph& graph_;
};

}  // namespace

void AddNode(StoredNode stored, int64_t operator_set, Graph& graph) {
  Rewriting(std::move(stored), operator_set, graph).Add();
}

}  // namespace daumier::runtime
