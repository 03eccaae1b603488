#pragma once
#include "runtime/graph.h"

#include <optional>

/// Numbers that are computed before a run (runtime/constant_folding.h).
namespace daumier::runtime {

/// The operators of FoldedUnary and FoldedBinary.
std::vector<std::string> FoldedArithmeticNames();
/// f of each number: Abs, Cast, Ceil, Exp, Floor, Neg, Not, Reciprocal, Round, Sqrt. Nothing of another f.
/// @throws Error on overflow, or a type that Cast does not have.
std::optional<GraphTensor> FoldedUnary(const GraphNode& node, const GraphTensor& from);
/// f(a, b) of tensors of one shape: Add, And, Div, Equal, Greater, GreaterOrEqual, Less, LessOrEqual, Max, Min, Mod, Mul,
/// Or, Pow, Sub. Comparisons give 0 and 1. Nothing of another f. @throws Error on overflow, division by 0, or if one
/// tensor is of integers and the other one is not.
std::optional<GraphTensor> FoldedBinary(const std::string& f, const GraphTensor& a, const GraphTensor& b);
/// ReduceMax, ReduceMin, ReduceProd or ReduceSum of all numbers. @throws Error if there are none.
GraphTensor FoldedReduction(const std::string& f, const GraphTensor& from);
/// first, first + step, ... to before `end`; nothing if these are more than `most`. @throws Error if step is 0.
std::optional<GraphTensor> FoldedRange(const GraphTensor& first, const GraphTensor& end, const GraphTensor& step,
                                       int64_t most);

/// Indices of an axis of that size, counted from 0. @throws Error if one is outside.
std::vector<int64_t> IndicesOf(const std::vector<int64_t>& indices, int64_t size);

}  // namespace daumier::runtime
