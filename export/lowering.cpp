#include "export/lowering.h"

#include "core/error.h"

#include <torch/csrc/jit/ir/constants.h>
#include <torch/csrc/jit/ir/ir.h>

#include <sstream>

namespace daumier::exporting {
namespace {

using torch::jit::Node;
using torch::jit::Value;

std::string LowerMatrixTranspose(const Value* matrix, LoweringContext& context) {
  return context.graph().AddNode("Transpose", {context.Name(matrix)}, {{"perm", std::vector<int64_t>{1, 0}}});
}

/// Creates no value of its own: read where it is used.
bool IsReadWhereUsed(const Node& node) {
  const auto kind = node.kind();
  return kind == c10::prim::Constant || kind == c10::prim::ListConstruct || kind == c10::aten::empty_like;
}

}  // namespace

void LoweringContext::SetWeight(const Value* value, const std::string& name, const torch::Tensor& weight) {
  weights_[value] = {name, weight};
}

std::string LoweringContext::Name(const Value* value) {
  if (const auto named = names_.find(value); named != names_.end()) return named->second;
  if (const auto weight = weights_.find(value); weight != weights_.end()) {
    return graph_.AddInitializer(weight->second.name, weight->second.tensor);
  }
  if (const auto constant = torch::jit::toIValue(value); constant.has_value()) {
    const std::string name = "constant_" + value->debugName();
    if (constant->isTensor()) return names_[value] = graph_.AddInitializer(name, constant->toTensor());
    if (constant->isScalar()) {  // A factor like 30 in x * 30.
      const auto number = torch::tensor(constant->toScalar().toFloat(), torch::kFloat32);
      return names_[value] = graph_.AddInitializer(name, number);
    }
  }
  if (value->node()->kind() == c10::aten::t)
    return names_[value] = LowerMatrixTranspose(value->node()->input(0), *this);
  throw Error(fmt::format("%{}, made by {}, is neither a tensor of the graph nor a weight", value->debugName(),
                          value->node()->kind().toQualString()));
}

std::vector<std::string> LoweringContext::Names(const Arguments& in, size_t first, size_t last) {
  std::vector<std::string> names;
  for (size_t i = first; i < last; ++i) {
    if (!in.IsAbsent(i)) names.push_back(Name(in.value(i)));
  }
  return names;
}

std::string LoweringContext::NameBeforeTranspose(const Value* value) {
  const bool of_weight = value->node()->kind() == c10::aten::t && weights_.count(value->node()->input(0)) == 1;
  return of_weight ? Name(value->node()->input(0)) : "";
}

std::optional<torch::Tensor> LoweringContext::Weight(const Value* value) const {
  if (const auto weight = weights_.find(value); weight != weights_.end()) return weight->second.tensor;
  const auto constant = torch::jit::toIValue(value);
  if (constant.has_value() && constant->isTensor()) return constant->toTensor();
  return std::nullopt;
}

std::string LoweringContext::Reshaped(const std::string& name, std::vector<int64_t> shape) {
  DAUMIER_CHECK(!shape.empty(), "the result has no dimension left for the batch");
  shape[0] = -1;
  return graph_.AddNode("Reshape", {name, graph_.AddIntegers(shape)});
}

bool LoweringContext::Fold(const Node& node) {
  if (node.outputs().size() != 1 || node.maybeOperator() == nullptr) return false;
  torch::jit::Stack stack;
  for (const Value* input : node.inputs()) {
    if (const auto weight = Weight(input); weight.has_value()) {
      stack.emplace_back(*weight);
    } else if (const auto constant = ConstantValue(input); constant.has_value()) {
      stack.push_back(*constant);
    } else {
      return false;
    }
  }
  node.getOperation()(stack);
  if (stack.size() != 1 || !stack[0].isTensor()) return false;
  SetWeight(node.output(), "constant_" + node.output()->debugName(), stack[0].toTensor());
  return true;
}

const Lowerings& LoweringTable() {
  static const Lowerings table = [] {
    Lowerings all;
    for (auto* part : {LayerLowerings, ImageLowerings, PointwiseLowerings, ShapeLowerings, ReductionLowerings})
      all.merge(part());
    const auto transpose = [](const Arguments& in, LoweringContext& context) {
      return LowerMatrixTranspose(in.value(0), context);
    };
    all.emplace("aten::t", transpose);
    return all;
  }();
  return table;
}

void LowerNode(const Node& node, LoweringContext& context) {
  if (IsReadWhereUsed(node)) return;
  if (node.kind() == c10::aten::t) return;  // Lowered where it is used, for Gemm takes a weight without it.
  const std::string name = node.kind().toQualString();
  const auto refuse = [&](const std::string& reason) {
    std::ostringstream line;
    line << node;
    throw Error(fmt::format("operator {} cannot be exported to ONNX: {}. It occurs in this line of the trace:\n{}",
                            name, reason, line.str()));
  };
  try {
    if (context.Fold(node)) return;
    const auto entry = LoweringTable().find(name);
    DAUMIER_CHECK(entry != LoweringTable().end(), "it has no entry in LoweringTable() of export/lowering.h");
    context.SetName(node.output(), entry->second(Arguments(node), context));
  } catch (const Error& error) {
    refuse(error.what());
  } catch (const c10::Error& error) {
    refuse(error.what_without_backtrace());
  }
}

}  // namespace daumier::exporting
