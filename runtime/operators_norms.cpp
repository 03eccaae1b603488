// Norms of images, layers and groups. Variances are biased: divided by the count.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/graph_fusion.h"
#include "runtime/operators.h"
#include "runtime/row_norm.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::runtime {
namespace {

float EpsilonOf(const GraphNode& node) {
  const float epsilon = node.Real("epsilon", 1e-5f);
  DAUMIER_CHECK(epsilon > 0 && std::isfinite(epsilon), "its epsilon is {}", epsilon);
  return epsilon;
}

/// An input of `count` numbers; absent: as many of `otherwise`.
std::vector<float> NumbersByChannel(const GraphNode& node, size_t input, int64_t count, float otherwise,
                                    const PlanBuilder& plan) {
  if (!node.Reads(input)) return std::vector<float>(size_t(count), otherwise);
  const std::vector<float>& numbers = plan.Weight(node, input).numbers;
  DAUMIER_CHECK(int64_t(numbers.size()) == count, "input {} has {} numbers, expected {}", input, numbers.size(), count);
  return numbers;
}

void AddRowNorm(const GraphNode& node, const Shape& shape, RowNorm norm, PlanBuilder& plan) {
  const Place from = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{from, to},
              [=, norm = std::move(norm)](Arena& arena) { norm.Run(arena.At(from), arena.At(to)); });
  plan.Define(node, shape, PlainLayout(shape), to);
}

/// Images in blocks of channels, in the layout that they have.
void AddBlockNorm(const GraphNode& node, BlockNorm norm, PlanBuilder& plan) {
  const PlannedValue value = plan.Value(node.inputs[0]);
  const Shape& shape = value.shape;
  norm.images = shape[0], norm.channels = shape[1], norm.area = shape[2] * shape[3];
  const Place from = value.place;
  const Place to = plan.MayOverwrite(node.inputs[0]) ? from : plan.NewOutput(node, shape, value.layout);
  plan.AddOwn(node, std::array{from, to},
              [=, norm = std::move(norm)](Arena& arena) { norm.Run(arena.At(from), arena.At(to)); });
  plan.Define(node, shape, value.layout, to);
}

/// The block of channels that an image lies in; 1: plain.
int BlockOfImage(const PlannedValue& value) {
  return value.shape.size() == 4 ? std::max(BlockOf(value.layout, value.shape), 1) : 1;
}

void PlanInstanceNorm(const GraphNode& node, PlanBuilder& plan) {
  const PlannedValue value = plan.Value(node.inputs.at(0));
  const Shape& shape = value.shape;
  DAUMIER_CHECK(shape.size() >= 3, "the input is {}, expected (N, C, ...)", ShapeText(shape));
  const int64_t channels = shape[1];
  for (const size_t input : {1, 2}) {
    const size_t found = plan.Weight(node, input).numbers.size();
    DAUMIER_CHECK(int64_t(found) == channels, "input {} has {} numbers, expected {}", input, found, channels);
  }
  const std::vector<float>&scales = plan.Weight(node, 1).numbers, &shifts = plan.Weight(node, 2).numbers;
  const bool with_relu = node.Text(kActivation, "") == "Relu";
  if (const int block = BlockOfImage(value); block > 1)
    return AddBlockNorm(
        node, {.block = block, .epsilon = EpsilonOf(node), .scales = scales, .shifts = shifts, .with_relu = with_relu},
        plan);
  AddRowNorm(node, shape,
             {.rows = shape[0] * channels,
              .runs = 1,
              .length = CheckedSize(shape, "its input") / (shape[0] * channels),
              .kinds = channels,
              .epsilon = EpsilonOf(node),
              .scales = scales,
              .shifts = shifts,
              .with_relu = with_relu},
             plan);
}

void PlanLayerNorm(const GraphNode& node, PlanBuilder& plan) {
  const Shape shape = plan.ShapeOf(node.inputs.at(0));
  const size_t axis = AxisOf(node.Integer("axis", -1), shape.size());
  RowNorm norm{.rows = 1, .runs = 1, .length = 1, .epsilon = EpsilonOf(node)};
  for (size_t i = 0; i < shape.size(); ++i) (i < axis ? norm.rows : norm.runs) *= shape[i];
  norm.scales = NumbersByChannel(node, 1, norm.runs, 1, plan);
  norm.shifts = NumbersByChannel(node, 2, norm.runs, 0, plan);
  AddRowNorm(node, shape, std::move(norm), plan);
}

void PlanGroupNorm(const GraphNode& node, PlanBuilder& plan) {
  const Shape shape = plan.ShapeOf(node.inputs.at(0));
  const int64_t groups = node.Integer("num_groups", 0);
  DAUMIER_CHECK(shape.size() >= 3 && groups >= 1 && shape[1] % groups == 0, "the input is {} with {} groups",
                ShapeText(shape), groups);
  DAUMIER_CHECK(shape.size() == 4 || node.Integer("of_images", 0) == 0, "the input is {}, expected (N, C, H, W)",
                ShapeText(shape));
  const int64_t channels = shape[1], of_group = channels / groups;
  const bool scales_groups = node.Integer("scales_groups", 0) != 0;
  const auto by_channel = [&](size_t input, float otherwise) {
    std::vector<float> numbers = NumbersByChannel(node, input, scales_groups ? groups : channels, otherwise, plan);
    if (!scales_groups) return numbers;
    std::vector<float> repeated;
    for (const float number : numbers) repeated.insert(repeated.end(), size_t(of_group), number);
    return repeated;
  };
  if (const int block = BlockOfImage(plan.Value(node.inputs[0])); block > 1)
    return AddBlockNorm(node,
                        {.block = block,
                         .of_group = of_group,
                         .epsilon = EpsilonOf(node),
                         .scales = by_channel(1, 1),
                         .shifts = by_channel(2, 0)},
                        plan);
  AddRowNorm(node, shape,
             {.rows = shape[0] * groups,
              .runs = of_group,
              .length = CheckedSize(shape, "its input") / (shape[0] * channels),
              .kinds = groups,
              .epsilon = EpsilonOf(node),
              .scales = by_channel(1, 1),
              .shifts = by_channel(2, 0)},
             plan);
}

}  // namespace

OperatorTable NormOperators() {
  return {{"GroupNormalization", PlanGroupNorm},
          {"InstanceNormalization", PlanInstanceNorm},
          {"LayerNormalization", PlanLayerNorm}};
}

}  // namespace daumier::runtime
