#include "runtime/array_kernels.h"

#include "core/error.h"
#include "runtime/primitives.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace daumier::runtime {
namespace {

/// Merges axes of `shape` that all stride lists traverse as one, and drops those of size 1. At least one axis remains.
template <class... Strides>
void MergeAxes(Shape& shape, Strides&... strides) {
  Shape merged;
  std::vector<size_t> last;  // Of each merged axis, its innermost axis.
  for (size_t i = 0; i < shape.size(); ++i) {
    if (shape[i] == 1) continue;
    const bool joins = !last.empty() && ((strides[last.back()] == strides[i] * shape[i]) && ...);
    if (joins) {
      merged.back() *= shape[i];
      last.back() = i;
    } else {
      merged.push_back(shape[i]);
      last.push_back(i);
    }
  }
  const auto take = [&](std::vector<int64_t>& of) {
    std::vector<int64_t> taken;
    for (const size_t i : last) taken.push_back(of[i]);
    if (last.empty()) taken.push_back(0);
    of = std::move(taken);
  };
  (take(strides), ...);
  if (merged.empty()) merged.push_back(1);
  shape = std::move(merged);
}

/// Calls `row(offset_a, offset_b)` for every row along the last axis, in order.
template <class Row>
void ForEachRow(const Shape& shape, const std::vector<int64_t>& a, const std::vector<int64_t>& b, const Row& row) {
  const size_t outer = shape.size() - 1;
  std::vector<int64_t> index(outer, 0);
  int64_t at_a = 0, at_b = 0;
  while (true) {
    row(at_a, at_b);
    size_t axis = outer;
    while (axis > 0) {
      --axis;
      at_a += a[axis], at_b += b[axis];
      if (++index[axis] < shape[axis]) break;
      at_a -= a[axis] * shape[axis], at_b -= b[axis] * shape[axis];
      index[axis] = 0;
      if (axis == 0) return;
    }
    if (outer == 0) return;
  }
}

using Four = float __attribute__((vector_size(16)));

/// Four numbers a time where both operands have steps of 0 or 1.
template <class F>
void RowOf(const float* a, int64_t step_a, const float* b, int64_t step_b, int64_t count, float* c) {
  const F f;
  int64_t i = 0;
  if constexpr (F::kOnVectors) {
    const Four repeated_a = {a[0], a[0], a[0], a[0]}, repeated_b = {b[0], b[0], b[0], b[0]};
    for (; i + 4 <= count; i += 4) {
      Four left = repeated_a, right = repeated_b;
      if (step_a == 1) std::memcpy(&left, a + i, sizeof(left));
      if (step_b == 1) std::memcpy(&right, b + i, sizeof(right));
      const Four result = f(left, right);
      std::memcpy(c + i, &result, sizeof(result));
    }
  }
  for (; i < count; ++i) c[i] = f(a[i * step_a], b[i * step_b]);
}

constexpr int64_t kMostParts = 64;

struct SumOf {
  static constexpr bool kOnVectors = true;
  template <class T>
  T operator()(T a, T b) const {
    return a + b;
  }
};
struct DifferenceOf {
  static constexpr bool kOnVectors = true;
  template <class T>
  T operator()(T a, T b) const {
    return a - b;
  }
};
struct ProductOf {
  static constexpr bool kOnVectors = true;
  template <class T>
  T operator()(T a, T b) const {
    return a * b;
  }
};
struct QuotientOf {
  static constexpr bool kOnVectors = true;
  template <class T>
  T operator()(T a, T b) const {
    return a / b;
  }
};
struct LargerOf {
  static constexpr bool kOnVectors = false;
  float operator()(float a, float b) const { return std::max(a, b); }
};
struct SmallerOf {
  static constexpr bool kOnVectors = false;
  float operator()(float a, float b) const { return std::min(a, b); }
};
struct PowerOf {
  static constexpr bool kOnVectors = false;
  float operator()(float a, float b) const { return std::pow(a, b); }
};
struct SlopeOf {
  static constexpr bool kOnVectors = false;
  float operator()(float a, float b) const { return a < 0 ? a * b : a; }
};

}  // namespace

std::vector<int64_t> StridesOf(const Shape& shape) {
  std::vector<int64_t> strides(shape.size(), 1);
  for (size_t i = shape.size(); i > 1; --i) strides[i - 2] = strides[i - 1] * shape[i - 1];
  return strides;
}

std::vector<int64_t> RepeatingStrides(const Shape& from, const Shape& to) {
  const std::vector<int64_t> own = StridesOf(from);
  std::vector<int64_t> strides(to.size(), 0);
  const size_t missing = to.size() - from.size();
  for (size_t i = 0; i < from.size(); ++i) strides[missing + i] = from[i] == 1 ? 0 : own[i];
  return strides;
}

Parts PartsOf(int64_t count, int64_t numbers) {
  constexpr int64_t kManyNumbers = 1 << 18;  // Less takes less time than to wake a thread.
  return {count, count > 1 && numbers >= kManyNumbers && OpenMpThreads() > 1};
}

StridedCopy::StridedCopy(const Shape& shape, const std::vector<int64_t>& from_strides,
                         const std::vector<int64_t>& to_strides)
    : shape_(shape), from_(from_strides), to_(to_strides) {
  MergeAxes(shape_, from_, to_);
}

void StridedCopy::Run(const float* from, float* to) const {
  const int64_t count = shape_.back(), step_from = from_.back(), step_to = to_.back();
  ForEachRow(shape_, from_, to_, [&](int64_t at_from, int64_t at_to) {
    if (step_from == 1 && step_to == 1) {
      std::memcpy(to + at_to, from + at_from, size_t(count) * sizeof(float));
    } else {
      for (int64_t i = 0; i < count; ++i) to[at_to + i * step_to] = from[at_from + i * step_from];
    }
  });
}

BroadcastFunction::BroadcastFunction(const std::string& f, const Shape& a, const Shape& b, const Shape& c)
    : shape_(c), a_(RepeatingStrides(a, c)), b_(RepeatingStrides(b, c)) {
  static const std::map<std::string, Row> kRows = {
      {"Add", RowOf<SumOf>},    {"Sub", RowOf<DifferenceOf>}, {"Mul", RowOf<ProductOf>}, {"Div", RowOf<QuotientOf>},
      {"Max", RowOf<LargerOf>}, {"Min", RowOf<SmallerOf>},    {"Pow", RowOf<PowerOf>},   {"PRelu", RowOf<SlopeOf>}};
  const auto row = kRows.find(f);
  DAUMIER_CHECK(row != kRows.end(), "there is no function '{}' of two arrays", f);
  row_ = row->second;
  MergeAxes(shape_, a_, b_);
  parts_ = PartsOf(std::min<int64_t>(shape_.front(), kMostParts), CheckedSize(shape_, "an array"));
}

void BroadcastFunction::Run(const float* a, const float* b, float* c) const {
  if (!parts_.on_all_cores) return RunPart(0, shape_.front(), a, b, c);
  const int64_t size = shape_.front();
  OnAllCores(parts_.count,
             [&](int64_t i) { RunPart(size * i / parts_.count, size * (i + 1) / parts_.count, a, b, c); });
}

void BroadcastFunction::RunPart(int64_t begin, int64_t end, const float* a, const float* b, float* c) const {
  Shape shape = shape_;
  shape.front() = end - begin;
  a += begin * a_.front(), b += begin * b_.front(), c += begin * (StridesOf(shape_).front());
  const int64_t count = shape.back(), step_a = a_.back(), step_b = b_.back();
  ForEachRow(shape, a_, b_, [&](int64_t at_a, int64_t at_b) {
    row_(a + at_a, step_a, b + at_b, step_b, count, c);
    c += count;
  });
}

StridedReduction::StridedReduction(Reduction kind, Shape kept, std::vector<int64_t> kept_strides, Shape reduced,
                                   std::vector<int64_t> reduced_strides)
    : kind_(kind),
      kept_(std::move(kept)),
      reduced_(std::move(reduced)),
      kept_strides_(std::move(kept_strides)),
      reduced_strides_(std::move(reduced_strides)) {
  MergeAxes(kept_, kept_strides_);
  MergeAxes(reduced_, reduced_strides_);
}

void StridedReduction::Run(const float* from, float* to) const {
  int64_t terms = 1;
  for (const int64_t size : reduced_) terms *= size;
  const int64_t count = reduced_.back(), step = reduced_strides_.back();
  const auto reduce = [&](const float* first) {
    double sum = 0;
    float largest = -std::numeric_limits<float>::infinity(), smallest = std::numeric_limits<float>::infinity();
    ForEachRow(reduced_, reduced_strides_, reduced_strides_, [&](int64_t at, int64_t) {
      for (int64_t i = 0; i < count; ++i) {
        const float value = first[at + i * step];
        sum += value;
        largest = std::max(largest, value);
        smallest = std::min(smallest, value);
      }
    });
    switch (kind_) {
      case Reduction::kMean:
        return float(sum / double(terms));
      case Reduction::kSum:
        return float(sum);
      case Reduction::kMax:
        return largest;
      default:
        return smallest;
    }
  };
  ForEachRow(kept_, kept_strides_, kept_strides_, [&](int64_t at, int64_t) {
    for (int64_t i = 0; i < kept_.back(); ++i) *to++ = reduce(from + at + i * kept_strides_.back());
  });
}

void SoftmaxOf(const float* from, int64_t outer, int64_t size, int64_t inner, bool logarithm, float* to) {
  for (int64_t o = 0; o < outer; ++o) {
    for (int64_t i = 0; i < inner; ++i) {
      const float* const source = from + o * size * inner + i;
      float* const target = to + o * size * inner + i;
      float largest = source[0];
      for (int64_t k = 1; k < size; ++k) largest = std::max(largest, source[k * inner]);
      double sum = 0;
      for (int64_t k = 0; k < size; ++k) sum += target[k * inner] = std::exp(source[k * inner] - largest);
      const auto scale = float(1 / sum), shift = float(std::log(sum));
      for (int64_t k = 0; k < size; ++k)
        target[k * inner] = logarithm ? source[k * inner] - largest - shift : target[k * inner] * scale;
    }
  }
}

}  // namespace daumier::runtime
