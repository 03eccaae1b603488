#pragma once
#include "core/parallel.h"
#include "runtime/graph.h"

#include <string>

/// Loops over plain arrays of float32.
namespace daumier::runtime {

/// Strides of a plain array, in numbers.
std::vector<int64_t> StridesOf(const Shape& shape);
/// Strides at which an array of shape `from` is read as one of shape `to`: 0 along axes that repeat.
std::vector<int64_t> RepeatingStrides(const Shape& from, const Shape& to);

/// A copy of numbers that lie apart: to[i, j, ...] = from[i s_0 + j s_1 + ...]. `to` has the strides of its own.
class StridedCopy {
 public:
  StridedCopy(const Shape& shape, const std::vector<int64_t>& from_strides, const std::vector<int64_t>& to_strides);
  void Run(const float* from, float* to) const;

 private:
  Shape shape_;  ///< Without sizes of 1, neighbours merged where they lie close.
  std::vector<int64_t> from_, to_;
};

/// Parts of an array that are computed one by one: on all cores if a plan is for several threads and the array is large.
struct Parts {
  int64_t count;
  bool on_all_cores;
};
/// numbers: of all parts together.
Parts PartsOf(int64_t count, int64_t numbers);
template <class Part>
void ForEachPart(const Parts& parts, const Part& part) {
  if (parts.on_all_cores) return OnAllCores(parts.count, part);
  for (int64_t i = 0; i < parts.count; ++i) part(i);
}

/// c = f(a, b) of arrays that repeat along axes of size 1. f: Add, Sub, Mul, Div, Max, Min, Pow, PRelu (b: slopes).
class BroadcastFunction {
 public:
  /// @throws Error if there is no such f.
  BroadcastFunction(const std::string& f, const Shape& a, const Shape& b, const Shape& c);
  void Run(const float* a, const float* b, float* c) const;

 private:
  /// From `begin` to before `end` of the first axis.
  void RunPart(int64_t begin, int64_t end, const float* a, const float* b, float* c) const;

  using Row = void (*)(const float* a, int64_t step_a, const float* b, int64_t step_b, int64_t count, float* c);
  Row row_;
  Shape shape_;
  std::vector<int64_t> a_, b_;
  Parts parts_ = {1, false};
};

enum class Reduction { kMean, kMax, kMin, kSum };
/// A reduction over the inner axes of an array that is read by strides.
class StridedReduction {
 public:
  /// kept, reduced: sizes and strides of the axes.
  StridedReduction(Reduction kind, Shape kept, std::vector<int64_t> kept_strides, Shape reduced,
                   std::vector<int64_t> reduced_strides);
  void Run(const float* from, float* to) const;

 private:
  Reduction kind_;
  Shape kept_, reduced_;
  std::vector<int64_t> kept_strides_, reduced_strides_;
};

/// Softmax, or its logarithm, along the middle of outer x size x inner.
void SoftmaxOf(const float* from, int64_t outer, int64_t size, int64_t inner, bool logarithm, float* to);

}  // namespace daumier::runtime
