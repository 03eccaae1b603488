#include "runtime/row_norm.h"

#include "core/kernels.h"
#include "runtime/array_kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::runtime {
namespace {

constexpr int64_t kPartOfRow = 1 << 14;

/// The moments of a part, which is read twice and stays in the cache.
DAUMIER_FOR_EACH_PROCESSOR
Moments MomentsOfPart(const float* numbers, int64_t count) {
  constexpr int64_t kLanes = 8;
  using Doubles = double __attribute__((vector_size(kLanes * sizeof(double))));
  const auto sum_of = [&](double mean, bool squares) {
    Doubles lanes = {};
    int64_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
      Doubles distances = {};
      for (int64_t lane = 0; lane < kLanes; ++lane) distances[lane] = double(numbers[i + lane]) - mean;
      lanes += squares ? distances * distances : distances;
    }
    double sum = 0;
    for (int64_t lane = 0; lane < kLanes; ++lane) sum += lanes[lane];
    for (; i < count; ++i) {
      const double distance = double(numbers[i]) - mean;
      sum += squares ? distance * distance : distance;
    }
    return sum;
  };
  const auto size = double(count);
  const double mean = sum_of(0, false) / size;
  return {size, mean, sum_of(mean, true) / size};
}

Moments Merged(const Moments& a, const Moments& b) {
  if (a.count == 0) return b;
  const double count = a.count + b.count, share = b.count / count, distance = b.mean - a.mean;
  return {count, a.mean + share * distance,
          (1 - share) * a.variance + share * b.variance + share * (1 - share) * distance * distance};
}

DAUMIER_FOR_EACH_PROCESSOR
void ScaleRun(const float* from, int64_t count, float scale, float shift, float lowest, float* to) {
  for (int64_t i = 0; i < count; ++i) {
    const float y = from[i] * scale + shift;
    to[i] = y < lowest ? lowest : y;
  }
}

}  // namespace

Moments MomentsOf(const float* numbers, int64_t count) {
  if (count <= kPartOfRow) return MomentsOfPart(numbers, count);
  const int64_t num_parts = (count + kPartOfRow - 1) / kPartOfRow;
  std::vector<Moments> parts(static_cast<size_t>(num_parts));
  ForEachPart(PartsOf(num_parts, count), [&](int64_t i) {
    parts[size_t(i)] = MomentsOfPart(numbers + i * kPartOfRow, std::min(kPartOfRow, count - i * kPartOfRow));
  });
  Moments all;
  for (const Moments& part : parts) all = Merged(all, part);
  return all;
}

void RowNorm::Run(const float* from, float* to) const {
  const float lowest = with_relu ? 0 : -std::numeric_limits<float>::infinity();
  for (int64_t r = 0; r < rows; ++r, from += runs * length, to += runs * length) {
    const Moments moments = MomentsOf(from, runs * length);
    const double factor = 1 / std::sqrt(moments.variance + epsilon);
    if (length == 1) {
      const auto kind = size_t(r % kinds * runs);
      for (int64_t i = 0; i < runs; ++i) {
        const double y = (double(from[i]) - moments.mean) * factor * scales[kind + size_t(i)] + shifts[kind + size_t(i)];
        to[i] = std::max(float(y), lowest);
      }
      continue;
    }
    ForEachPart(PartsOf(runs, runs * length), [&](int64_t run) {
      const auto kind = size_t(r % kinds * runs + run);
      const double scale = factor * scales[kind];
      ScaleRun(from + run * length, length, float(scale), float(shifts[kind] - moments.mean * scale), lowest,
               to + run * length);
    });
  }
}

}  // namespace daumier::runtime
