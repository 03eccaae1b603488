// Activations and arithmetic.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/onnx_tensor.h"
#include "runtime/operators.h"
#include "runtime/siren_math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace daumier::runtime {
namespace {

/// Functions of which f(0) = 0, so that the channels that fill up a block stay zero.
bool KeepsZero(const UnaryFunction& f) {
  static const std::set<std::string> kNames = {"Abs",       "Ceil",      "Elu",  "Erf",  "Floor", "Gelu",
                                               "HardSwish", "LeakyRelu", "Mish", "Neg",  "Relu",  "Round",
                                               "Selu",      "Sin",       "Sqrt", "Tanh", "Trunc"};
  return kNames.contains(f.name) || (f.name == "Clip" && f.lowest <= 0 && f.highest >= 0);
}

template <class F>
std::function<void(const float*, int64_t, float*)> EachNumber(const F& f) {
  return [f](const float* from, int64_t count, float* to) {
    for (int64_t i = 0; i < count; ++i) to[i] = f(from[i]);
  };
}

void Sines(const float* from, int64_t count, float* to) {
  constexpr int64_t kWidth = 64;
  static constexpr std::array<float, kWidth> kNoBias = {};
  if (from != to) std::copy_n(from, count, to);
  SineOfBlock(to, kNoBias.data(), count / kWidth, kWidth, 1);
  SineOfBlock(to + count / kWidth * kWidth, kNoBias.data(), 1, count % kWidth, 1);
}

using Loop = std::function<void(const float*, int64_t, float*)>;

float Softplus(float x) {
  return std::max(x, 0.0f) + std::log1p(std::exp(-std::abs(x)));
}

/// Functions of one number without parameters.
const std::map<std::string, Loop>& PlainLoops() {
  static const std::map<std::string, Loop> loops = {
      {"Abs", EachNumber([](float x) { return std::abs(x); })},
      {"Ceil", EachNumber([](float x) { return std::ceil(x); })},
      {"Cos", EachNumber([](float x) { return std::cos(x); })},
      {"Erf", EachNumber([](float x) { return std::erf(x); })},
      {"Exp", EachNumber([](float x) { return std::exp(x); })},
      {"Floor", EachNumber([](float x) { return std::floor(x); })},
      {"HardSwish", EachNumber([](float x) { return x * std::clamp(x / 6 + 0.5f, 0.0f, 1.0f); })},
      {"Log", EachNumber([](float x) { return std::log(x); })},
      {"Mish", EachNumber([](float x) { return x * std::tanh(Softplus(x)); })},
      {"Neg", EachNumber([](float x) { return -x; })},
      {"Reciprocal", EachNumber([](float x) { return 1 / x; })},
      {"Relu", EachNumber([](float x) { return std::max(x, 0.0f); })},
      {"Round", EachNumber([](float x) { return std::rint(x); })},
      {"Sigmoid", EachNumber([](float x) { return 1 / (1 + std::exp(-x)); })},
      {"Sin", Sines},
      {"Softplus", EachNumber(Softplus)},
      {"Softsign", EachNumber([](float x) { return x / (1 + std::abs(x)); })},
      {"Sqrt", EachNumber([](float x) { return std::sqrt(x); })},
      {"Tanh", EachNumber([](float x) { return std::tanh(x); })},
      {"Trunc", EachNumber([](float x) { return std::trunc(x); })}};
  return loops;
}

float GeluByTanh(float x) {
  constexpr float kFactor = 0.7978845608f;  // sqrt(2 / pi)
  return 0.5f * x * (1 + std::tanh(kFactor * (x + 0.044715f * x * x * x)));
}

Loop LoopOf(const UnaryFunction& f) {
  const float alpha = f.alpha, lowest = f.lowest, highest = f.highest, beta = f.beta, gamma = f.gamma;
  if (const auto found = PlainLoops().find(f.name); found != PlainLoops().end()) return found->second;
  if (f.name == "Clip") return EachNumber([=](float x) { return std::min(std::max(x, lowest), highest); });
  if (f.name == "Elu") return EachNumber([=](float x) { return x > 0 ? x : alpha * std::expm1(x); });
  if (f.name == "Gelu" && alpha != 0) return EachNumber(GeluByTanh);
  if (f.name == "Gelu") return EachNumber([](float x) { return 0.5f * x * (1 + std::erf(x * 0.7071067812f)); });
  if (f.name == "HardSigmoid") return EachNumber([=](float x) { return std::clamp(alpha * x + beta, 0.0f, 1.0f); });
  if (f.name == "LeakyRelu") return EachNumber([=](float x) { return x > 0 ? x : alpha * x; });
  if (f.name == "Selu") return EachNumber([=](float x) { return gamma * (x > 0 ? x : alpha * std::expm1(x)); });
  throw Error(fmt::format("there is no function '{}'", f.name));
}

/// In the input's own layout where the padding of its channels stays zero, and in place where nothing else reads it.
void PlanFunction(const GraphNode& node, const UnaryFunction& f, PlanBuilder& plan) {
  const std::string& input = node.inputs.at(0);
  const PlannedValue value = plan.Value(input);
  const int64_t size = CheckedSize(value.shape, "its input");
  const bool is_kept = KeepsZero(f) || SizeOf(value.layout) == size;
  const Layout layout = is_kept ? value.layout : PlainLayout(value.shape);
  const Place from = plan.In(input, layout);
  const Place to = from == value.place && plan.MayOverwrite(input) ? from : plan.NewOutput(node, value.shape, layout);
  AddUnary(node, f, from, to, SizeOf(layout), plan);
  plan.Define(node, value.shape, layout, to);
}

void PlanUnary(const GraphNode& node, PlanBuilder& plan) {
  const float usual_alpha = node.op == "LeakyRelu" ? 0.01f : 1.0f;
  PlanFunction(node, {node.op, node.Real("alpha", usual_alpha)}, plan);
}

void PlanGelu(const GraphNode& node, PlanBuilder& plan) {
  const std::string form = node.Text("approximate", "none");
  DAUMIER_CHECK(form == "none" || form == "tanh", "there is no Gelu by '{}'", form);
  PlanFunction(node, {node.op, form == "tanh" ? 1.0f : 0.0f}, plan);
}

void PlanHardSigmoid(const GraphNode& node, PlanBuilder& plan) {
  PlanFunction(node, {.name = node.op, .alpha = node.Real("alpha", 0.2f), .beta = node.Real("beta", 0.5f)}, plan);
}

void PlanSelu(const GraphNode& node, PlanBuilder& plan) {
  PlanFunction(node,
               {.name = node.op, .alpha = node.Real("alpha", 1.67326319f), .gamma = node.Real("gamma", 1.05070102f)},
               plan);
}

/// Numbers of a run stay float32; as whole ones they lose what is behind the point.
void PlanCast(const GraphNode& node, PlanBuilder& plan) {
  const int64_t type = node.Integer("to", 0);
  DAUMIER_CHECK(type >= kFloat32 && type <= kBfloat16 && type != kString && type != kBool,
                "it casts numbers of a run to the element type {}", type);
  if (!IsRealType(type)) return PlanFunction(node, {"Trunc"}, plan);
  const PlannedValue value = plan.Value(node.inputs.at(0));
  plan.Define(node, value.shape, value.layout, value.place);
}

void PlanClip(const GraphNode& node, PlanBuilder& plan) {
  const auto bound = [&](size_t input, float otherwise) {
    if (!node.Reads(input)) return otherwise;
    const std::vector<float>& numbers = plan.Weight(node, input).numbers;
    DAUMIER_CHECK(numbers.size() == 1, "a bound has {} numbers", numbers.size());
    return numbers.front();
  };
  PlanFunction(node,
               {"Clip", 0, bound(1, std::numeric_limits<float>::lowest()), bound(2, std::numeric_limits<float>::max())},
               plan);
}

/// The block of both operands if they are images of one shape in one layout whose padding `f` keeps zero; else 1.
bool MeetInBlocks(const GraphNode& node, const PlannedValue& a, const PlannedValue& b) {
  return a.shape == b.shape && a.layout == b.layout && BlockOf(a.layout, a.shape) > 1 && node.op != "Div" &&
         node.op != "Pow";
}

void PlanBinary(const GraphNode& node, PlanBuilder& plan) {
  DAUMIER_CHECK(node.inputs.size() == 2, "it has {} inputs, expected two", node.inputs.size());
  const PlannedValue a = plan.Value(node.inputs[0]), b = plan.Value(node.inputs[1]);
  // One of two images in blocks and the other plain: the plain one is converted, which costs less than two.
  const bool is_sum_of_images = a.shape == b.shape && a.shape.size() == 4 && node.op != "Div" && node.op != "Pow";
  const bool blocked = MeetInBlocks(node, a, b) ||
                       (is_sum_of_images && std::max(BlockOf(a.layout, a.shape), BlockOf(b.layout, b.shape)) > 1);
  if (!blocked) {
    const Shape shape = BroadcastShape(a.shape, b.shape);
    AddPlainBinary(node, node.op, plan.Plain(node.inputs[0]), a.shape, plan.Plain(node.inputs[1]), b.shape, shape,
                   plan);
    return;
  }
  const Layout layout = BlockOf(a.layout, a.shape) > 1 ? a.layout : b.layout;
  const Place left = plan.In(node.inputs[0], layout), right = plan.In(node.inputs[1], layout);
  Place to;
  if (left == a.place && plan.MayOverwrite(node.inputs[0])) {
    to = left;
  } else if (right == b.place && plan.MayOverwrite(node.inputs[1])) {
    to = right;
  } else {
    to = plan.NewOutput(node, a.shape, layout);
  }
  const Shape flat = {SizeOf(layout)};
  plan.AddOwn(node, std::array{left, right, to}, [=, f = BroadcastFunction(node.op, flat, flat, flat)](Arena& arena) {
    f.Run(arena.At(left), arena.At(right), arena.At(to));
  });
  plan.Define(node, a.shape, layout, to);
}

}  // namespace

void AddUnary(const GraphNode& node, const UnaryFunction& f, const Place& from, const Place& to, int64_t count,
              PlanBuilder& plan) {
  constexpr int64_t kPart = int64_t{1} << 14;  // A multiple of the widths of loops: results do not depend on parts.
  plan.AddOwn(node, std::array{from, to},
              [=, loop = LoopOf(f), parts = PartsOf((count + kPart - 1) / kPart, count)](Arena& arena) {
                const float* const source = arena.At(from);
                float* const target = arena.At(to);
                ForEachPart(parts, [&](int64_t part) {
                  const int64_t begin = part * kPart;
                  loop(source + begin, std::min(kPart, count - begin), target + begin);
                });
              });
}

Place AddPlainBinary(const GraphNode& node, const std::string& f, const Place& a, const Shape& of_a, const Place& b,
                     const Shape& of_b, const Shape& shape, PlanBuilder& plan) {
  CheckedSize(shape, "its output");
  const Place to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{a, b, to}, [=, function = BroadcastFunction(f, of_a, of_b, shape)](Arena& arena) {
    function.Run(arena.At(a), arena.At(b), arena.At(to));
  });
  plan.Define(node, shape, PlainLayout(shape), to);
  return to;
}

OperatorTable PointwiseOperators() {
  OperatorTable table;
  for (const auto& [name, loop] : PlainLoops()) table[name] = PlanUnary;
  for (const char* name : {"Elu", "LeakyRelu"}) table[name] = PlanUnary;
  table.erase("Trunc");
  table["Cast"] = PlanCast;
  table["Gelu"] = PlanGelu;
  table["HardSigmoid"] = PlanHardSigmoid;
  table["Selu"] = PlanSelu;
  for (const char* name : {"Add", "Div", "Max", "Min", "Mul", "Pow", "PRelu", "Sub"}) table[name] = PlanBinary;
  table["Clip"] = PlanClip;
  return table;
}

}  // namespace daumier::runtime
