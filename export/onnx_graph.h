#pragma once
#include <onnx/onnx_pb.h>
#include <torch/types.h>

#include <cstdint>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace daumier::exporting {

inline constexpr int kOpset = 13;
inline constexpr int kIrVersion = 7;
/// The name of the first, free dimension of every input and output.
inline constexpr const char* kBatchDimension = "N";

struct OnnxAttribute {
  std::string name;
  std::variant<int64_t, float, std::vector<int64_t>, std::string> value;
};

/// Writes an ONNX model node by node; every name that it makes is new. Values are known by their names.
class OnnxGraph {
 public:
  explicit OnnxGraph(const std::string& name);

  /// float32; dimension 0 of `example` becomes free if the input is batched, the others are fixed.
  void AddInput(const std::string& name, const torch::Tensor& example, bool batched = true);
  /// Leaves the free dimension of an input unnamed, which is as free.
  void UnnameBatch(const std::string& input);
  /// Makes `value` an output of that name, of the shape of `example`, dimension 0 free.
  void AddOutput(const std::string& name, const std::string& value, const torch::Tensor& example);
  /// Stores a tensor once a name. @throws Error if its element type is neither float32 nor int64.
  std::string AddInitializer(const std::string& name, const torch::Tensor& tensor);
  /// A constant list of integers, as shapes and axes are given.
  std::string AddIntegers(const std::vector<int64_t>& values);
  /// Stores a tensor under a new name. @throws Error as AddInitializer.
  std::string AddConstant(const torch::Tensor& tensor);
  /// Appends a node with one output and returns the output's name.
  std::string AddNode(const std::string& op, const std::vector<std::string>& inputs,
                      const std::vector<OnnxAttribute>& attributes = {});

  void AddMetadata(const std::string& key, const std::string& text);

  onnx::ModelProto& model() { return model_; }

 private:
  std::string NewName(const std::string& stem);

  onnx::ModelProto model_;
  std::set<std::string> initializers_;
  int num_names_ = 0;
};

}  // namespace daumier::exporting
