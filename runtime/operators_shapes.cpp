// Views, parts, concatenation.
#include "core/error.h"
#include "runtime/array_kernels.h"
#include "runtime/operators.h"

#include <algorithm>
#include <array>

namespace daumier::runtime {
namespace {

void PlanIdentity(const GraphNode& node, PlanBuilder& plan) {
  const PlannedValue value = plan.Value(node.inputs.at(0));
  plan.Define(node, value.shape, value.layout, value.place);
}

/// A view whose numbers lie close is no copy.
void PlanView(const GraphNode& node, PlanBuilder& plan) {
  const StridedView view =
      ViewOf(node, plan.ShapeOf(node.inputs.at(0)),
             [&](size_t input) -> const std::vector<int64_t>& { return plan.Integers(node, input); });
  CheckedSize(view.shape, "its output");
  Place from = plan.Plain(node.inputs[0]);
  from.offset += view.offset;
  if (LiesClose(view)) return plan.Define(node, view.shape, PlainLayout(view.shape), from);
  AddStridedCopy(node, view, from, view.shape, plan);
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

}  // namespace

void AddStridedCopy(const GraphNode& node, const StridedView& view, const Place& from, const Shape& shape,
                    PlanBuilder& plan) {
  const Place to = plan.NewOutput(node, shape, PlainLayout(shape));
  plan.AddOwn(node, std::array{from, to},
              [=, copy = StridedCopy(view.shape, view.strides, StridesOf(view.shape))](Arena& arena) {
                copy.Run(arena.At(from), arena.At(to));
              });
  plan.Define(node, shape, PlainLayout(shape), to);
}

OperatorTable ShapeOperators() {
  return {{"Concat", PlanConcatenation}, {"Expand", PlanView},   {"Flatten", PlanView}, {"Identity", PlanIdentity},
          {"Reshape", PlanView},         {"Slice", PlanView},    {"Split", PlanView},   {"Squeeze", PlanView},
          {"Transpose", PlanView},       {"Unsqueeze", PlanView}};
}

}  // namespace daumier::runtime
