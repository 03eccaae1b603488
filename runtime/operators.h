#pragma once
#include "runtime/plan_builder.h"

namespace daumier::runtime {

/// Plans one node: checks shapes and attributes, adds steps, defines the output.
/// @throws Error with the cause if the node is not as ONNX demands, or of a form that is not run here.
using PlanOperator = void (*)(const GraphNode& node, PlanBuilder& plan);
using OperatorTable = std::map<std::string, PlanOperator>;

/// The operators that the exporter writes (export/lowering.h). @throws Error if it is not among them.
PlanOperator OperatorOf(const GraphNode& node);

/// The parts of the table.
OperatorTable LayerOperators();      ///< Convolutions, batch norm, products of matrices.
OperatorTable ImageOperators();      ///< Pools and resizing.
OperatorTable PointwiseOperators();  ///< Activations, arithmetic.
OperatorTable ShapeOperators();      ///< Views, parts, concatenation, padding.
OperatorTable ReductionOperators();  ///< Means, maxima, softmax.

/// What several parts use: values in plain layout.

/// Defines the output as `f(a, b)` of plain arrays that repeat along axes of size 1. f is "Add", "Mul" and so on.
Place AddPlainBinary(const GraphNode& node, const std::string& f, const Place& a, const Shape& of_a, const Place& b,
                     const Shape& of_b, const Shape& shape, PlanBuilder& plan);
/// The shape of a result of arrays that repeat along axes of size 1. @throws Error if they do not match.
Shape BroadcastShape(const Shape& a, const Shape& b);
/// f(x) of `count` numbers: "Relu", "Sigmoid" and so on; alpha of LeakyRelu and Elu; lowest and highest of Clip.
struct UnaryFunction {
  std::string name;
  float alpha = 0, lowest = 0, highest = 0;
};
void AddUnary(const GraphNode& node, const UnaryFunction& f, const Place& from, const Place& to, int64_t count,
              PlanBuilder& plan);

/// An axis of a tensor of that rank, counted from 0. @throws Error if there is none.
size_t AxisOf(int64_t axis, size_t rank);
/// Strides, pads and dilations of a node over images, (N, C, ...). @throws Error if they are not of that number of axes, or negative.
Window WindowOf(const GraphNode& node, const std::vector<int64_t>& kernel);
/// Sizes of the output of a window. @throws Error if the window is larger than the padded image.
Shape WindowOutput(const Shape& image, int64_t channels, const Window& window);

}  // namespace daumier::runtime
