#pragma once
#include "runtime/plan_builder.h"
#include "runtime/strided_view.h"

namespace daumier::runtime {

/// Plans one node: checks shapes and attributes, adds steps, defines the output.
/// @throws Error with the cause if the node is not as ONNX demands, or of a form that is not run here.
using PlanOperator = void (*)(const GraphNode& node, PlanBuilder& plan);
using OperatorTable = std::map<std::string, PlanOperator>;

/// The operators that are steps of a plan. @throws Error if the node's is not among them.
PlanOperator OperatorOf(const GraphNode& node);
/// Whether the operator is run here, if only on what is known before a run (runtime/constant_folding.h).
bool IsRunHere(const std::string& op);

/// The parts of the table.
OperatorTable LayerOperators();        ///< Convolutions, batch norm, products of matrices.
OperatorTable ImageOperators();        ///< Pools.
OperatorTable NormOperators();         ///< Norms of images, layers and groups.
OperatorTable PointwiseOperators();    ///< Activations, arithmetic.
OperatorTable RearrangingOperators();  ///< Padding, gathering, depth and space.
OperatorTable ReductionOperators();    ///< Sums, means, maxima, softmax.
OperatorTable ResizingOperators();     ///< Resize.
OperatorTable ShapeOperators();        ///< Views, parts, concatenation.

/// What several parts use: values in plain layout.

/// Defines the output as `f(a, b)` of plain arrays that repeat along axes of size 1. f is "Add", "Mul" and so on.
Place AddPlainBinary(const GraphNode& node, const std::string& f, const Place& a, const Shape& of_a, const Place& b,
                     const Shape& of_b, const Shape& shape, PlanBuilder& plan);
/// f(x) of `count` numbers: "Relu", "Sigmoid" and so on; alpha of LeakyRelu, Elu, Selu and HardSigmoid, beta of the latter,
/// gamma of Selu; lowest and highest of Clip; Gelu by tanh if alpha is not 0.
struct UnaryFunction {
  std::string name;
  float alpha = 0, lowest = 0, highest = 0, beta = 0, gamma = 0;
};
void AddUnary(const GraphNode& node, const UnaryFunction& f, const Place& from, const Place& to, int64_t count,
              PlanBuilder& plan);

/// Defines the output as a copy of a view of the plain array `from`, seen as `shape`.
void AddStridedCopy(const GraphNode& node, const StridedView& view, const Place& from, const Shape& shape,
                    PlanBuilder& plan);

/// The shape of input 0. @throws Error if it is not (N, C, H, W).
Shape ImageOf(const GraphNode& node, const PlanBuilder& plan);
/// Strides, pads and dilations of a node over images, (N, C, ...); pads by auto_pad, if it is given, so that the output
/// has the image's size divided by the strides, rounded up. @throws Error if they are not of that number of axes, or
/// negative.
Window WindowOf(const GraphNode& node, const std::vector<int64_t>& kernel, const Shape& image);
/// Sets the pads of an axis, of which SAME_UPPER has the larger half behind.
void SetPads(Window& window, size_t axis, int64_t both, bool upper);
/// Sizes of the output of a window. @throws Error if the window is larger than the padded image.
Shape WindowOutput(const Shape& image, int64_t channels, const Window& window);

}  // namespace daumier::runtime
