#include "runtime/strided_view.h"

#include "core/error.h"
#include "runtime/array_kernels.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace daumier::runtime {
namespace {

/// A node's view of an array.
struct ViewRequest {
  const GraphNode& node;
  const Shape& from;
  const IntegersOfInput& integers;
};

/// The same numbers in another shape.
StridedView SeenAs(const Shape& from, Shape shape) {
  DAUMIER_CHECK(CheckedSize(shape, "its output") == CheckedSize(from, "its input"), "{} cannot be seen as {}",
                ShapeText(from), ShapeText(shape));
  std::vector<int64_t> strides = StridesOf(shape);
  return {std::move(shape), std::move(strides)};
}

StridedView ViewOfIdentity(const ViewRequest& request) {
  return SeenAs(request.from, request.from);
}

/// 0 copies a size of the input, -1 is what is left.
StridedView ViewOfReshape(const ViewRequest& request) {
  const Shape& from = request.from;
  Shape shape = request.integers(1);
  const bool copies = request.node.Integer("allowzero", 0) == 0;
  int64_t known = 1;
  std::optional<size_t> free;
  for (size_t i = 0; i < shape.size(); ++i) {
    if (shape[i] == 0 && copies) {
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
  return SeenAs(from, shape);
}

StridedView ViewOfFlatten(const ViewRequest& request) {
  const Shape& from = request.from;
  const int64_t given = request.node.Integer("axis", 1);
  const size_t axis = given == int64_t(from.size()) ? from.size() : AxisOf(given, from.size());
  Shape shape = {1, 1};
  for (size_t i = 0; i < from.size(); ++i) shape[i < axis ? 0 : 1] *= from[i];
  return SeenAs(from, shape);
}

std::vector<bool> NamedAxes(const std::vector<int64_t>& axes, size_t rank) {
  DAUMIER_CHECK(rank <= kMostDimensions, "it has {} axes", rank);
  std::vector<bool> named(rank, false);
  for (const int64_t axis : axes) named[AxisOf(axis, rank)] = true;
  return named;
}

/// Without axes, all of size 1 vanish.
StridedView ViewOfSqueeze(const ViewRequest& request) {
  const Shape& from = request.from;
  const bool names_axes = request.node.Reads(1);
  const std::vector<bool> named =
      names_axes ? NamedAxes(request.integers(1), from.size()) : std::vector<bool>(from.size(), true);
  Shape shape;
  for (size_t i = 0; i < from.size(); ++i) {
    DAUMIER_CHECK(!named[i] || from[i] == 1 || !names_axes, "axis {} of {} is not 1", i, ShapeText(from));
    if (!named[i] || from[i] != 1) shape.push_back(from[i]);
  }
  return SeenAs(from, shape);
}

StridedView ViewOfUnsqueeze(const ViewRequest& request) {
  const Shape& from = request.from;
  const std::vector<int64_t>& axes = request.integers(1);
  const std::vector<bool> named = NamedAxes(axes, from.size() + axes.size());
  DAUMIER_CHECK(size_t(std::ranges::count(named, false)) == from.size(), "an axis is named twice");
  Shape shape;
  size_t next = 0;
  for (const bool is_new : named) shape.push_back(is_new ? 1 : from[next++]);
  return SeenAs(from, shape);
}

StridedView ViewOfTranspose(const ViewRequest& request) {
  const Shape& from = request.from;
  std::vector<int64_t> reversed(from.size());
  std::iota(reversed.rbegin(), reversed.rend(), 0);
  const std::vector<int64_t> order = request.node.Integers("perm", reversed);
  DAUMIER_CHECK(std::ranges::is_permutation(order, reversed), "perm is {}, no order of {} axes", ShapeText(order),
                from.size());
  const std::vector<int64_t> strides = StridesOf(from);
  StridedView view;
  for (const int64_t axis : order) {
    view.shape.push_back(from[size_t(axis)]);
    view.strides.push_back(strides[size_t(axis)]);
  }
  return view;
}

/// Every `step`-th of an axis from `begin` to before `end`; both count from the end where negative.
void TakeRange(StridedView& view, size_t axis, int64_t begin, int64_t end, int64_t step) {
  const int64_t size = view.shape[axis], backwards = step < 0 ? 1 : 0;
  const auto counted = [&](int64_t at) { return std::clamp(at < 0 ? at + size : at, -backwards, size - backwards); };
  const int64_t first = std::max(counted(begin), int64_t{0}), last = counted(end);
  const int64_t distance = step < 0 ? first - last : last - first;
  DAUMIER_CHECK(step != 0 && step >= -kMostNumbers && size > 0 && distance > 0,
                "it takes {} to {} by {} of {}: nothing", begin, end, step, size);
  view.offset += first * view.strides[axis];
  view.shape[axis] = (distance - 1) / std::abs(step) + 1;
  if (view.shape[axis] > 1) view.strides[axis] *= step;
}

StridedView ViewOfSlice(const ViewRequest& request) {
  const GraphNode& node = request.node;
  StridedView view{request.from, StridesOf(request.from)};
  const std::vector<int64_t>&begins = request.integers(1), &ends = request.integers(2);
  std::vector<int64_t> axes(begins.size());
  std::iota(axes.begin(), axes.end(), 0);
  if (node.Reads(3)) axes = request.integers(3);
  const std::vector<int64_t> steps = node.Reads(4) ? request.integers(4) : std::vector<int64_t>(begins.size(), 1);
  DAUMIER_CHECK(ends.size() == begins.size() && axes.size() == begins.size() && steps.size() == begins.size(),
                "starts, ends, axes and steps are of different lengths");
  for (size_t i = 0; i < begins.size(); ++i)
    TakeRange(view, AxisOf(axes[i], view.shape.size()), begins[i], ends[i], steps[i]);
  return view;
}

StridedView ViewOfSplit(const ViewRequest& request) {
  const GraphNode& node = request.node;
  StridedView view{request.from, StridesOf(request.from)};
  const size_t axis = AxisOf(node.Integer("axis", 0), view.shape.size());
  const int64_t size = view.shape[axis], part = node.Integer("part", 0), parts = node.Integer("parts", 1);
  DAUMIER_CHECK(part >= 0 && part < parts, "there is no part {} of {}", part, parts);
  int64_t begin = 0, end = 0;
  if (node.Reads(1)) {
    const std::vector<int64_t>& sizes = request.integers(1);
    DAUMIER_CHECK(int64_t(sizes.size()) == parts, "it has {} parts and {} sizes", parts, sizes.size());
    for (size_t i = 0; i <= size_t(part); ++i) {
      DAUMIER_CHECK(sizes[i] > 0 && sizes[i] <= size - end, "parts of {} do not fill {}", ShapeText(sizes), size);
      begin = end;
      end += sizes[i];
    }
  } else {
    const int64_t most = (size - 1) / parts + 1;
    begin = std::min(part * most, size);
    end = std::min(begin + most, size);
  }
  TakeRange(view, axis, begin, end, 1);
  return view;
}

StridedView ViewOfExpand(const ViewRequest& request) {
  const Shape& wanted = request.integers(1);
  CheckedSize(wanted, "the shape that it is expanded to");
  const Shape shape = BroadcastShape(request.from, wanted);
  DAUMIER_CHECK(CheckedSize(shape, "its output") > 0, "its output is empty");
  return {shape, RepeatingStrides(request.from, shape)};
}

using ViewFunction = StridedView (*)(const ViewRequest&);
const std::map<std::string, ViewFunction>& ViewFunctions() {
  static const std::map<std::string, ViewFunction> functions = {
      {"Expand", ViewOfExpand},   {"Flatten", ViewOfFlatten},     {"Identity", ViewOfIdentity},
      {"Reshape", ViewOfReshape}, {"Slice", ViewOfSlice},         {"Split", ViewOfSplit},
      {"Squeeze", ViewOfSqueeze}, {"Transpose", ViewOfTranspose}, {"Unsqueeze", ViewOfUnsqueeze}};
  return functions;
}

}  // namespace

bool IsViewOperator(const std::string& op) {
  return ViewFunctions().contains(op);
}

StridedView ViewOf(const GraphNode& node, const Shape& from, const IntegersOfInput& integers) {
  return ViewFunctions().at(node.op)({node, from, integers});
}

bool LiesClose(const StridedView& view) {
  const std::vector<int64_t> close = StridesOf(view.shape);
  for (size_t i = 0; i < view.shape.size(); ++i)
    if (view.shape[i] > 1 && view.strides[i] != close[i]) return false;
  return true;
}

std::vector<int64_t> PlacesOf(const StridedView& view) {
  std::vector<int64_t> places = {view.offset};
  for (size_t axis = 0; axis < view.shape.size(); ++axis) {
    std::vector<int64_t> finer;
    finer.reserve(places.size() * size_t(view.shape[axis]));
    for (const int64_t place : places)
      for (int64_t i = 0; i < view.shape[axis]; ++i) finer.push_back(place + i * view.strides[axis]);
    places = std::move(finer);
  }
  return places;
}

size_t AxisOf(int64_t axis, size_t rank) {
  const int64_t counted = axis < 0 ? axis + int64_t(rank) : axis;
  DAUMIER_CHECK(counted >= 0 && counted < int64_t(rank), "there is no axis {} of {}", axis, rank);
  return size_t(counted);
}

Shape BroadcastShape(const Shape& a, const Shape& b) {
  Shape shape(std::max(a.size(), b.size()));
  for (size_t i = 0; i < shape.size(); ++i) {
    const int64_t of_a = i < a.size() ? a[a.size() - 1 - i] : 1, of_b = i < b.size() ? b[b.size() - 1 - i] : 1;
    DAUMIER_CHECK(of_a == of_b || of_a == 1 || of_b == 1, "the shapes {} and {} do not match", ShapeText(a),
                  ShapeText(b));
    shape[shape.size() - 1 - i] = of_a == 1 ? of_b : of_a;
  }
  return shape;
}

}  // namespace daumier::runtime
