#pragma once
#include <ATen/core/ivalue.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace torch::jit {
struct Node;
struct Value;
}  // namespace torch::jit

namespace daumier::exporting {

/// The arguments of a traced operator, by the names of its schema, and the shapes of its tensors. Shapes are those of
/// the trace: dimension 0 is the batch size at which it was made.
class Arguments {
 public:
  explicit Arguments(const torch::jit::Node& node) : node_(node) {}

  const torch::jit::Node& node() const { return node_; }
  size_t size() const;
  const torch::jit::Value* value(size_t i) const;
  bool Has(const std::string& name) const;
  /// True if the operator has no such argument, or if it is None.
  bool IsAbsent(const std::string& name) const;
  bool IsAbsent(size_t i) const;

  /// @throws Error if the argument depends on an input, or has another type.
  int64_t Integer(const std::string& name) const;
  bool Flag(const std::string& name) const;
  double Real(const std::string& name) const;
  std::string Text(const std::string& name) const;
  std::vector<int64_t> Integers(const std::string& name) const;
  std::vector<double> Reals(const std::string& name) const;

  /// @throws Error if the trace has no shape of the tensor.
  std::vector<int64_t> Shape(size_t i) const;
  std::vector<int64_t> OutputShape() const;

  /// An axis of a tensor of that rank, counted from 0.
  int64_t Axis(const std::string& name, int64_t rank) const;
  /// Ascending. All axes if the argument is absent or empty.
  std::vector<int64_t> Axes(const std::string& name, int64_t rank) const;
  /// One number for each spatial dimension of the image, which is input 0: LibTorch takes a single one for all of them.
  std::vector<int64_t> Spatial(const std::string& name) const;

 private:
  const torch::jit::Value* Find(const std::string& name) const;
  c10::IValue Constant(const std::string& name) const;

  const torch::jit::Node& node_;
};

/// The value of a constant, or of a list of constants. Nothing if it is neither.
std::optional<c10::IValue> ConstantValue(const torch::jit::Value* value);

/// Whether the value is read, and by sums, differences, products and quotients alone, which repeat a smaller operand.
bool IsReadByArithmeticAlone(const torch::jit::Value* value);

/// @throws Error if the trace has no shape of the tensor.
std::vector<int64_t> ShapeOf(const torch::jit::Value* value);

}  // namespace daumier::exporting
