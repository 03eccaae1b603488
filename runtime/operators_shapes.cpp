// Views, parts, concatenation, padding.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/operators.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace daumier::runtime {
namespace {

/// The same numbers in another shape.
void DefineView(const GraphNode& node, const Shape& shape, PlanBuilder& plan) {
  const std::string& input = node.inputs.at(0);
  const int64_t size = CheckedSize(plan.ShapeOf(input), "its input");
  DAUMIER_CHECK(CheckedSize(shape, "its output") == size, "{} cannot be seen as {}", ShapeText(plan.ShapeOf(input)),
                ShapeText(shape));
  plan.Define(node, shape, PlainLayout(shape), plan.Plain(input));
}

void PlanIdentity(const GraphNode& node, PlanBuilder& plan) {
  const PlannedValue value = plan.Value(node.inputs.at(0));
  plan.Define(node, value.shape, value.layout, value.place);
}

/// 0 copies a size of the input, -1 is what is left.
void PlanReshape(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  Shape shape = plan.Integers(node, 1);
  int64_t known = 1;
  std::optional<size_t> free;
  for (size_t i = 0; i < shape.size(); ++i) {
    if (shape[i] == 0) {
      DAUMIER_CHECK(i < from.size(), "{} has no size {}", ShapeText(from), i);
      shape[i] = from[i];
    }
    DAUMIER_CHECK(shape[i] >= -1 && shape[i] <= kMostNumbers && (shape[i] != -1 || !free), "its shape is {}",
                  ShapeText(shape));
    if (shape[i] == -1) free = i;
    if (shape[i] != -1) known *= shape[i];
    DAUMIER_CHECK(known > 0 && known <= kMostNumbers, "its shape is {}", ShapeText(shape));
  }
  if (free) shape[*free] = CheckedSize(from, "its input") / known;
  DefineView(node, shape, plan);
}

void PlanFlatten(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const int64_t given = node.Integer("axis", 1);
  const size_t axis = given == int64_t(from.size()) ? from.size() : AxisOf(given, from.size());
  Shape shape = {1, 1};
  for (size_t i = 0; i < from.size(); ++i) shape[i < axis ? 0 : 1] *= from[i];
  DefineView(node, shape, plan);
}

/// The axes that input 1 names, of that rank.
std::vector<bool> NamedAxes(const GraphNode& node, size_t rank, const PlanBuilder& plan) {
  DAUMIER_CHECK(rank <= kMostDimensions, "it has {} axes", rank);
  std::vector<bool> named(rank, false);
  for (const int64_t axis : plan.Integers(node, 1)) named[AxisOf(axis, rank)] = true;
  return named;
}

void PlanSqueeze(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const std::vector<bool> named = NamedAxes(node, from.size(), plan);
  Shape shape;
  for (size_t i = 0; i < from.size(); ++i) {
    DAUMIER_CHECK(!named[i] || from[i] == 1, "axis {} of {} is not 1", i, ShapeText(from));
    if (!named[i]) shape.push_back(from[i]);
  }
  DefineView(node, shape, plan);
}

void PlanUnsqueeze(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const std::vector<bool> named = NamedAxes(node, from.size() + plan.Integers(node, 1).size(), plan);
  DAUMIER_CHECK(size_t(std::ranges::count(named, false)) == from.size(), "an axis is named twice");
  Shape shape;
  size_t next = 0;
  for (const bool is_new : named) shape.push_back(is_new ? 1 : from[next++]);
  DefineView(node, shape, plan);
}

/// A copy of the numbers that lie at `strides` behind `from`.
void DefineCopy(const GraphNode& node, const Shape& shape, const Place& from, const std::vector<int64_t>& strides,
                PlanBuilder& plan) {
  const Place to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{from, to}, [=, copy = StridedCopy(shape, strides, StridesOf(shape))](Arena& arena) {
    copy.Run(arena.At(from), arena.At(to));
  });
  plan.Define(node, shape, PlainLayout(shape), to);
}

void PlanTranspose(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  std::vector<int64_t> reversed(from.size());
  std::iota(reversed.rbegin(), reversed.rend(), 0);
  const std::vector<int64_t> order = node.Integers("perm", reversed);
  DAUMIER_CHECK(std::ranges::is_permutation(order, reversed), "perm is {}, no order of {} axes", ShapeText(order),
                from.size());
  const std::vector<int64_t> strides = StridesOf(from);
  Shape shape;
  std::vector<int64_t> ordered;
  for (const int64_t axis : order) {
    shape.push_back(from[size_t(axis)]);
    ordered.push_back(strides[size_t(axis)]);
  }
  DefineCopy(node, shape, plan.Plain(node.inputs[0]), ordered, plan);
}

/// One axis after the other. A part whose numbers lie close is a view.
void PlanSlice(const GraphNode& node, PlanBuilder& plan) {
  Shape shape = plan.ShapeOf(node.inputs.at(0));
  std::vector<int64_t> strides = StridesOf(shape);
  const std::vector<int64_t> begins = plan.Integers(node, 1), ends = plan.Integers(node, 2);
  std::vector<int64_t> axes(begins.size());
  std::iota(axes.begin(), axes.end(), 0);
  if (node.Reads(3)) axes = plan.Integers(node, 3);
  const std::vector<int64_t> steps = node.Reads(4) ? plan.Integers(node, 4) : std::vector<int64_t>(begins.size(), 1);
  DAUMIER_CHECK(ends.size() == begins.size() && axes.size() == begins.size() && steps.size() == begins.size(),
                "starts, ends, axes and steps are of different lengths");
  int64_t offset = 0;
  for (size_t i = 0; i < begins.size(); ++i) {
    const size_t axis = AxisOf(axes[i], shape.size());
    const int64_t size = shape[axis];
    const auto counted = [&](int64_t at) { return std::clamp(at < 0 ? at + size : at, int64_t{0}, size); };
    const int64_t begin = counted(begins[i]), end = counted(ends[i]);
    DAUMIER_CHECK(steps[i] >= 1 && begin < end, "it takes {} to {} by {} of {}: nothing, or backwards", begins[i],
                  ends[i], steps[i], size);
    offset += begin * strides[axis];
    shape[axis] = (end - begin - 1) / steps[i] + 1;
    if (shape[axis] > 1) strides[axis] *= steps[i];
  }
  Place from = plan.Plain(node.inputs[0]);
  from.offset += offset;
  const std::vector<int64_t> close = StridesOf(shape);
  const bool is_view = [&] {
    for (size_t i = 0; i < shape.size(); ++i)
      if (shape[i] > 1 && strides[i] != close[i]) return false;
    return true;
  }();
  if (is_view) return plan.Define(node, shape, PlainLayout(shape), from);
  DefineCopy(node, shape, from, strides, plan);
}

void PlanConcatenation(const GraphNode& node, PlanBuilder& plan) {
  Shape shape = plan.ShapeOf(node.inputs.at(0));
  const size_t axis = AxisOf(node.Integer("axis", 0), shape.size());
  shape[axis] = 0;
  for (const std::string& input : node.inputs) {
    const Shape& part = plan.ShapeOf(input);
    DAUMIER_CHECK(part.size() == shape.size(), "its parts have {} and {} axes", shape.size(), part.size());
    for (size_t i = 0; i < shape.size(); ++i)
      DAUMIER_CHECK(i == axis || part[i] == shape[i], "a part is {}, another one is {}", ShapeText(part),
                    ShapeText(plan.ShapeOf(node.inputs[0])));
    shape[axis] += part[axis];
  }
  CheckedSize(shape, "its output");
  auto gathering = plan.GatheringOf(node.output);
  if (gathering && gathering->block > 1)  // Later parts may still not have whole blocks.
    for (size_t i = 0; i + 1 < node.inputs.size(); ++i)
      if (plan.ShapeOf(node.inputs[i])[1] % gathering->block != 0) gathering = std::nullopt;
  const int block = gathering ? gathering->block : 1;
  const Layout layout = BlockedLayout(shape, block);
  const Place to = gathering ? plan.Grown(gathering->place, SizeOf(layout)) : plan.NewOutput(node, shape, layout);
  const std::vector<int64_t> strides = StridesOf(shape);
  int64_t before = 0;
  for (const std::string& input : node.inputs) {
    const Shape part = plan.ShapeOf(input);
    Place at = to;
    at.offset += before * strides[axis];
    before += part[axis];
    const Layout of_part = BlockedLayout(part, block);
    const Place from = plan.In(input, of_part);
    if (gathering) {
      plan.AddCopy(node, from, at, SizeOf(of_part));
      continue;
    }
    plan.AddOwn(node, std::array{from, at}, [=, copy = StridedCopy(part, StridesOf(part), strides)](Arena& arena) {
      copy.Run(arena.At(from), arena.At(at));
    });
  }
  plan.Define(node, shape, layout, to);
}

void PlanExpand(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const Shape wanted = plan.Integers(node, 1);
  CheckedSize(wanted, "the shape that it is expanded to");
  const Shape shape = BroadcastShape(from, wanted);
  DAUMIER_CHECK(CheckedSize(shape, "its output") > 0, "its output is empty");
  DefineCopy(node, shape, plan.Plain(node.inputs[0]), RepeatingStrides(from, shape), plan);
}

/// For each place along a padded axis, the place in the input, or -1 where the constant is.
std::vector<int64_t> PaddedPlaces(int64_t size, int64_t before, int64_t after, const std::string& mode) {
  DAUMIER_CHECK(before >= 0 && after >= 0 && before <= kMostNumbers && after <= kMostNumbers &&
                    (mode != "reflect" || std::max(before, after) < size),
                "it pads {} pixels by {} and {}", size, before, after);
  std::vector<int64_t> places;
  for (int64_t i = -before; i < size + after; ++i) {
    int64_t at = i;
    if (mode == "reflect" && at < 0) at = -at;
    if (mode == "reflect" && at >= size) at = 2 * (size - 1) - at;
    if (mode == "edge") at = std::clamp(at, int64_t{0}, size - 1);
    places.push_back(at < 0 || at >= size ? -1 : at);
  }
  return places;
}

struct Padding {
  std::vector<std::vector<int64_t>> places;  ///< By axis.
  std::vector<int64_t> strides;
  float value;

  /// Fills the rest of an output of which the first `axis` indices are given.
  float* Fill(const float* from, size_t axis, bool is_inside, float* to) const {
    for (const int64_t at : places[axis]) {
      const bool inside = is_inside && at >= 0;
      const float* const next = inside ? from + at * strides[axis] : from;
      if (axis + 1 < places.size()) {
        to = Fill(next, axis + 1, inside, to);
      } else {
        *to++ = inside ? *next : value;
      }
    }
    return to;
  }
};

void PlanPad(const GraphNode& node, PlanBuilder& plan) {
  const Shape from = plan.ShapeOf(node.inputs.at(0));
  const std::vector<int64_t>& pads = plan.Integers(node, 1);
  const std::string mode = node.Text("mode", "constant");
  DAUMIER_CHECK(mode == "constant" || mode == "reflect" || mode == "edge", "there is no padding '{}'", mode);
  DAUMIER_CHECK(pads.size() == 2 * from.size() && !from.empty(), "it has {} pads for {} axes", pads.size(),
                from.size());
  Padding padding{{}, StridesOf(from), 0};
  if (node.Reads(2)) {
    const std::vector<float>& value = plan.Weight(node, 2).numbers;
    DAUMIER_CHECK(value.size() == 1, "its constant has {} numbers", value.size());
    padding.value = value.front();
  }
  Shape shape;
  for (size_t i = 0; i < from.size(); ++i) {
    padding.places.push_back(PaddedPlaces(from[i], pads[i], pads[from.size() + i], mode));
    shape.push_back(int64_t(padding.places.back().size()));
  }
  CheckedSize(shape, "its output");
  const Place source = plan.Plain(node.inputs[0]), to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{source, to}, [=, padding = std::move(padding)](Arena& arena) {
    padding.Fill(arena.At(source), 0, true, arena.At(to));
  });
  plan.Define(node, shape, PlainLayout(shape), to);
}

}  // namespace

OperatorTable ShapeOperators() {
  return {{"Concat", PlanConcatenation}, {"Expand", PlanExpand},   {"Flatten", PlanFlatten},
          {"Identity", PlanIdentity},    {"Pad", PlanPad},         {"Reshape", PlanReshape},
          {"Slice", PlanSlice},          {"Squeeze", PlanSqueeze}, {"Transpose", PlanTranspose},
          {"Unsqueeze", PlanUnsqueeze}};
}

}  // namespace daumier::runtime
