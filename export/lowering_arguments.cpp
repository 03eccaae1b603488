#include "export/lowering_arguments.h"

#include "core/error.h"

#include <torch/csrc/jit/ir/constants.h>
#include <torch/csrc/jit/ir/ir.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace daumier::exporting {
namespace {

using torch::jit::Node;
using torch::jit::Value;

/// A list of one type. Nothing if an item is no constant of that type.
template <class T>
std::optional<c10::IValue> ListOf(const Node& list) {
  c10::List<T> items;
  for (const Value* input : list.inputs()) {
    const auto item = torch::jit::toIValue(input);
    if (!item.has_value() || item->isNone()) return std::nullopt;
    items.push_back(item->to<T>());
  }
  return c10::IValue(items);
}

int64_t FromZero(int64_t axis, int64_t rank) {
  return axis < 0 ? axis + rank : axis;
}

}  // namespace

std::optional<c10::IValue> ConstantValue(const Value* value) {
  if (const auto constant = torch::jit::toIValue(value); constant.has_value()) return *constant;
  const Node& node = *value->node();
  if (node.kind() != c10::prim::ListConstruct) return std::nullopt;
  const auto element = value->type()->expect<c10::ListType>()->getElementType();
  if (element->kind() == c10::TypeKind::IntType) return ListOf<int64_t>(node);
  if (element->kind() == c10::TypeKind::FloatType) return ListOf<double>(node);
  return std::nullopt;
}

bool IsReadByArithmeticAlone(const Value* value) {
  static const std::set<std::string> arithmetic = {"aten::add", "aten::sub", "aten::mul", "aten::div"};
  const auto& uses = value->uses();
  return !uses.empty() && std::all_of(uses.begin(), uses.end(), [](const auto& use) {
    return arithmetic.count(use.user->kind().toQualString()) == 1;
  });
}

std::vector<int64_t> ShapeOf(const Value* value) {
  const auto sizes = value->type()->expect<c10::TensorType>()->sizes().concrete_sizes();
  DAUMIER_CHECK(sizes.has_value(), "the trace has no shape of %{}", value->debugName());
  return *sizes;
}

size_t Arguments::size() const {
  return node_.inputs().size();
}

const Value* Arguments::value(size_t i) const {
  return node_.input(i);
}

const Value* Arguments::Find(const std::string& name) const {
  const auto index = node_.schema().argumentIndexWithName(name);
  return index.has_value() ? node_.input(static_cast<size_t>(*index)) : nullptr;
}

bool Arguments::Has(const std::string& name) const {
  return Find(name) != nullptr;
}

bool Arguments::IsAbsent(size_t i) const {
  const auto constant = torch::jit::toIValue(node_.input(i));
  return constant.has_value() && constant->isNone();
}

bool Arguments::IsAbsent(const std::string& name) const {
  const Value* value = Find(name);
  if (value == nullptr) return true;
  const auto constant = torch::jit::toIValue(value);
  return constant.has_value() && constant->isNone();
}

c10::IValue Arguments::Constant(const std::string& name) const {
  const Value* value = Find(name);
  DAUMIER_CHECK(value != nullptr, "this form of the operator has no argument '{}'", name);
  const auto constant = ConstantValue(value);
  DAUMIER_CHECK(constant.has_value(), "the argument '{}' depends on the input, ONNX needs a constant there", name);
  return *constant;
}

int64_t Arguments::Integer(const std::string& name) const {
  return Constant(name).toInt();
}

bool Arguments::Flag(const std::string& name) const {
  return Constant(name).toBool();
}

double Arguments::Real(const std::string& name) const {
  return Constant(name).toScalar().toDouble();
}

std::string Arguments::Text(const std::string& name) const {
  return Constant(name).toStringRef();
}

std::vector<int64_t> Arguments::Integers(const std::string& name) const {
  return Constant(name).toIntVector();
}

std::vector<double> Arguments::Reals(const std::string& name) const {
  return Constant(name).toDoubleVector();
}

std::vector<int64_t> Arguments::Shape(size_t i) const {
  return ShapeOf(node_.input(i));
}

std::vector<int64_t> Arguments::OutputShape() const {
  return ShapeOf(node_.output(0));
}

int64_t Arguments::Axis(const std::string& name, int64_t rank) const {
  return FromZero(Integer(name), rank);
}

std::vector<int64_t> Arguments::Axes(const std::string& name, int64_t rank) const {
  std::vector<int64_t> axes;
  if (!IsAbsent(name)) {
    const c10::IValue constant = Constant(name);
    axes = constant.isInt() ? std::vector<int64_t>{constant.toInt()} : constant.toIntVector();
  }
  if (axes.empty()) {
    axes.resize(static_cast<size_t>(rank));
    std::iota(axes.begin(), axes.end(), 0);
  }
  for (int64_t& axis : axes) axis = FromZero(axis, rank);
  std::sort(axes.begin(), axes.end());
  return axes;
}

std::vector<int64_t> Arguments::Spatial(const std::string& name) const {
  auto numbers = Integers(name);
  if (numbers.size() == 1) numbers.assign(Shape(0).size() - 2, numbers[0]);
  return numbers;
}

}  // namespace daumier::exporting
