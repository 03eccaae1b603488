#include "export/onnx_graph.h"

#include "core/error.h"

namespace daumier::exporting {
namespace {

void Describe(onnx::ValueInfoProto& info, const std::string& name, const torch::Tensor& example, bool batched) {
  info.set_name(name);
  auto& type = *info.mutable_type()->mutable_tensor_type();
  type.set_elem_type(onnx::TensorProto::FLOAT);
  auto& shape = *type.mutable_shape();
  if (batched) shape.add_dim()->set_dim_param(kBatchDimension);
  for (int64_t dimension = batched ? 1 : 0; dimension < example.dim(); ++dimension) {
    shape.add_dim()->set_dim_value(example.size(dimension));
  }
}

onnx::TensorProto::DataType TypeOf(const torch::Tensor& tensor, const std::string& name) {
  if (tensor.scalar_type() == torch::kFloat32) return onnx::TensorProto::FLOAT;
  if (tensor.scalar_type() == torch::kInt64) return onnx::TensorProto::INT64;
  throw Error(fmt::format("tensor '{}' has element type {}; only float32 and int64 are exported", name,
                          c10::toString(tensor.scalar_type())));
}

}  // namespace

OnnxGraph::OnnxGraph(const std::string& name) {
  model_.set_ir_version(kIrVersion);
  model_.set_producer_name("daumier");
  auto& opset = *model_.add_opset_import();
  opset.set_domain("");
  opset.set_version(kOpset);
  model_.mutable_graph()->set_name(name);
}

void OnnxGraph::AddInput(const std::string& name, const torch::Tensor& example, bool batched) {
  Describe(*model_.mutable_graph()->add_input(), name, example, batched);
}

void OnnxGraph::UnnameBatch(const std::string& input) {
  for (auto& info : *model_.mutable_graph()->mutable_input())
    if (info.name() == input) info.mutable_type()->mutable_tensor_type()->mutable_shape()->mutable_dim(0)->Clear();
}

void OnnxGraph::AddMetadata(const std::string& key, const std::string& text) {
  auto& entry = *model_.add_metadata_props();
  entry.set_key(key);
  entry.set_value(text);
}

void OnnxGraph::AddOutput(const std::string& name, const std::string& value, const torch::Tensor& example) {
  auto& node = *model_.mutable_graph()->add_node();
  node.set_op_type("Identity");
  node.set_name(NewName("Identity"));
  node.add_input(value);
  node.add_output(name);
  Describe(*model_.mutable_graph()->add_output(), name, example, true);
}

std::string OnnxGraph::AddInitializer(const std::string& name, const torch::Tensor& tensor) {
  if (!initializers_.insert(name).second) return name;
  const auto type = TypeOf(tensor, name);
  const auto plain = tensor.detach().cpu().contiguous();
  auto& stored = *model_.mutable_graph()->add_initializer();
  stored.set_name(name);
  stored.set_data_type(type);
  for (const int64_t size : plain.sizes()) stored.add_dims(size);
  stored.set_raw_data(plain.data_ptr(), plain.nbytes());
  return name;
}

std::string OnnxGraph::AddIntegers(const std::vector<int64_t>& values) {
  return AddInitializer(NewName("integers"), torch::tensor(values, torch::kInt64));
}

std::string OnnxGraph::AddConstant(const torch::Tensor& tensor) {
  return AddInitializer(NewName("tensor"), tensor);
}

std::string OnnxGraph::AddNode(const std::string& op, const std::vector<std::string>& inputs,
                               const std::vector<OnnxAttribute>& attributes) {
  auto& node = *model_.mutable_graph()->add_node();
  node.set_op_type(op);
  node.set_name(NewName(op));
  for (const auto& input : inputs) node.add_input(input);
  for (const auto& [name, value] : attributes) {
    auto& attribute = *node.add_attribute();
    attribute.set_name(name);
    if (const auto* integer = std::get_if<int64_t>(&value)) {
      attribute.set_type(onnx::AttributeProto::INT);
      attribute.set_i(*integer);
    } else if (const auto* real = std::get_if<float>(&value)) {
      attribute.set_type(onnx::AttributeProto::FLOAT);
      attribute.set_f(*real);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
      attribute.set_type(onnx::AttributeProto::STRING);
      attribute.set_s(*text);
    } else {
      attribute.set_type(onnx::AttributeProto::INTS);
      for (const int64_t item : std::get<std::vector<int64_t>>(value)) attribute.add_ints(item);
    }
  }
  node.add_output(node.name() + ":0");
  return node.output(0);
}

std::string OnnxGraph::NewName(const std::string& stem) {
  return stem + "_" + std::to_string(num_names_++);
}

}  // namespace daumier::exporting
