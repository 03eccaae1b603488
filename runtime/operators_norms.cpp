// Norms of images, layers and groups. Variances are biased: divided by the count.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/graph_fusion.h"
#include "runtime/operators.h"

#include <array>
#include <cmath>

namespace daumier::runtime {
namespace {

float EpsilonOf(const GraphNode& node) {
  const float epsilon = node.Real("epsilon", 1e-5f);
  DAUMIER_CHECK(epsilon >= 0 && std::isfinite(epsilon), "its epsilon is {}", epsilon);
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

/// By oneDNN's batch norm of one image after the other, in blocks that are full of channels, or plain.
void PlanInstanceNorm(const GraphNode& node, PlanBuilder& plan) {
  const PlannedValue value = plan.Value(node.inputs.at(0));
  const Shape& shape = value.shape;
  DAUMIER_CHECK(shape.size() >= 3, "the input is {}, expected (N, C, ...)", ShapeText(shape));
  const int64_t channels = shape[1], area = CheckedSize(shape, "its input") / (shape[0] * channels);
  std::array<Place, 2> affine;
  for (size_t i = 0; i < 2; ++i) {
    const std::vector<float>& numbers = plan.Weight(node, i + 1).numbers;
    DAUMIER_CHECK(int64_t(numbers.size()) == channels, "input {} has {} numbers, expected {}", i + 1, numbers.size(),
                  channels);
    affine[i].constant = numbers.data();
  }
  int block = shape.size() == 4 ? BlockOf(value.layout, shape) : 1;
  if (block == 0 || channels % block != 0) block = 1;
  const Layout layout = BlockedLayout(shape, block);
  const Layout of_image = BlockedLayout({1, channels, 1, area}, block);
  const Primitive primitive = MakeInstanceNorm(of_image, EpsilonOf(node), node.Text(kActivation, "") == "Relu");
  const Place from = plan.In(node.inputs[0], layout);
  const bool in_place = from == value.place && plan.MayOverwrite(node.inputs[0]);
  const Place to = in_place ? from : plan.NewOutput(node, shape, layout);
  for (int64_t n = 0; n < shape[0]; ++n) {
    const auto of_batch = [&](Place place) {
      place.offset += n * channels * area;
      return place;
    };
    plan.AddPrimitive(node, primitive,
                      {{DNNL_ARG_SRC, of_image, of_batch(from)},
                       {DNNL_ARG_DST, of_image, of_batch(to)},
                       {DNNL_ARG_SCALE, PlainLayout({channels}), affine[0]},
                       {DNNL_ARG_SHIFT, PlainLayout({channels}), affine[1]}});
  }
  plan.Define(node, shape, layout, to);
}

double SumOfRow(const float* row, int64_t count, double mean, bool squares) {
  std::array<double, 4> sums = {};  // Four at a time: an addition waits for the one before.
  const auto term = [&](int64_t i) {
    const double distance = double(row[i]) - mean;
    return squares ? distance * distance : distance;
  };
  int64_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (size_t lane = 0; lane < 4; ++lane) sums[lane] += term(i + int64_t(lane));
  for (; i < count; ++i) sums[0] += term(i);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Rows of runs of numbers. Each row has a mean and a variance; each run of a row a scale and a shift.
struct RowNorm {
  int64_t rows = 0, runs = 0, length = 0;
  int64_t kinds = 1;  ///< Of rows, one after the other: row r has the scales from (r mod kinds) * runs on.
  float epsilon = 0;
  std::vector<float> scales, shifts;

  void Run(const float* from, float* to) const {
    const int64_t size = runs * length;
    for (int64_t r = 0; r < rows; ++r, from += size) {
      const double mean = SumOfRow(from, size, 0, false) / double(size);
      const double variance = SumOfRow(from, size, mean, true) / double(size);
      const double factor = 1 / std::sqrt(variance + epsilon);
      for (int64_t run = 0; run < runs; ++run) {
        const auto kind = size_t(r % kinds * runs + run);
        const auto scale = float(factor * scales[kind]), shift = float(shifts[kind] - mean * factor * scales[kind]);
        for (int64_t i = run * length; i < (run + 1) * length; ++i) *to++ = from[i] * scale + shift;
      }
    }
  }
};

void AddRowNorm(const GraphNode& node, const Shape& shape, RowNorm norm, PlanBuilder& plan) {
  DAUMIER_CHECK(norm.epsilon > 0, "its epsilon is {}", norm.epsilon);
  const Place from = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{from, to},
              [=, norm = std::move(norm)](Arena& arena) { norm.Run(arena.At(from), arena.At(to)); });
  plan.Define(node, shape, PlainLayout(shape), to);
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
  const int64_t channels = shape[1], of_group = channels / groups;
  RowNorm norm{.rows = shape[0] * groups,
               .runs = of_group,
               .length = CheckedSize(shape, "its input") / (shape[0] * channels),
               .kinds = groups,
               .epsilon = EpsilonOf(node)};
  const bool scales_groups = node.Integer("scales_groups", 0) != 0;
  const auto by_channel = [&](size_t input, float otherwise) {
    std::vector<float> numbers = NumbersByChannel(node, input, scales_groups ? groups : channels, otherwise, plan);
    if (!scales_groups) return numbers;
    std::vector<float> repeated;
    for (const float number : numbers) repeated.insert(repeated.end(), size_t(of_group), number);
    return repeated;
  };
  norm.scales = by_channel(1, 1);
  norm.shifts = by_channel(2, 0);
  AddRowNorm(node, shape, std::move(norm), plan);
}

}  // namespace

OperatorTable NormOperators() {
  return {{"GroupNormalization", PlanGroupNorm},
          {"InstanceNormalization", PlanInstanceNorm},
          {"LayerNormalization", PlanLayerNorm}};
}

}  // namespace daumier::runtime
