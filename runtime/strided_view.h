#pragma once
#include "runtime/graph.h"

#include <functional>

namespace daumier::runtime {

/// How a plain array is read as another one: element (i, j, ...) lies at offset + i s_0 + j s_1 + ...
struct StridedView {
  Shape shape;
  std::vector<int64_t> strides;
  int64_t offset = 0;
};

/// The integers that a node has as an input. @throws Error if they are not known before a run.
using IntegersOfInput = std::function<const std::vector<int64_t>&(size_t input)>;

/// Whether ViewOf has the operator: Expand, Flatten, Identity, Reshape, Slice, Split, Squeeze, Transpose, Unsqueeze.
bool IsViewOperator(const std::string& op);
/// The view that the node takes of its input 0, of shape `from`; the same before and during a run.
/// @throws Error with the cause if shape, axes, parts or order do not fit.
StridedView ViewOf(const GraphNode& node, const Shape& from, const IntegersOfInput& integers);

/// Whether the numbers of the view lie close, in its order.
bool LiesClose(const StridedView& view);
/// Where the elements of the view lie, in its order.
std::vector<int64_t> PlacesOf(const StridedView& view);

/// An axis of a tensor of that rank, counted from 0. @throws Error if there is none.
size_t AxisOf(int64_t axis, size_t rank);
/// The shape of a result of arrays that repeat along axes of size 1. @throws Error if they do not match.
Shape BroadcastShape(const Shape& a, const Shape& b);

}  // namespace daumier::runtime
