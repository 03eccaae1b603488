#include "runtime/row_norm.h"

#include "core/kernels.h"
#include "runtime/array_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace daumier::runtime {
namespace {

constexpr int64_t kPartOfRow = 1 << 14, kNormLanes = 8;
using EightDoubles = double __attribute__((vector_size(kNormLanes * sizeof(double))));
using EightFloats = float __attribute__((vector_size(kNormLanes * sizeof(float))));

/// Adds x - mean, or its square, of the eight numbers at `numbers`.
DAUMIER_INLINE void AddDistances(const float* numbers, const EightDoubles& mean, bool squares, EightDoubles& sum) {
  EightFloats eight;
  std::memcpy(&eight, numbers, sizeof(eight));
  const EightDoubles distances = __builtin_convertvector(eight, EightDoubles) - mean;
  sum += squares ? distances * distances : distances;
}

/// The sum of x - mean, or of its square, over a row.
DAUMIER_INLINE double SumOfRow(const float* numbers, int64_t count, double mean, bool squares) {
  EightDoubles lanes = {};
  int64_t i = 0;
  for (; i + kNormLanes <= count; i += kNormLanes) AddDistances(numbers + i, EightDoubles{} + mean, squares, lanes);
  double sum = 0;
  for (int64_t lane = 0; lane < kNormLanes; ++lane) sum += lanes[lane];
  for (; i < count; ++i) {
    const double distance = double(numbers[i]) - mean;
    sum += squares ? distance * distance : distance;
  }
  return sum;
}

/// The moments of a part, which is read twice and stays in the cache.
DAUMIER_FOR_EACH_PROCESSOR
Moments MomentsOfPart(const float* numbers, int64_t count) {
  const auto size = double(count);
  const double mean = SumOfRow(numbers, count, 0, false) / size;
  return {size, mean, SumOfRow(numbers, count, mean, true) / size};
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

/// Moments of eight channels.
struct LaneMoments {
  double count = 0;
  EightDoubles mean = {}, variance = {};
};

DAUMIER_FOR_EACH_PROCESSOR
void MomentsOfLanes(const float* pixels, int64_t count, int64_t step, LaneMoments& moments) {
  const auto size = double(count);
  EightDoubles sum = {}, squares = {};
  for (int64_t i = 0; i < count; ++i) AddDistances(pixels + i * step, EightDoubles{}, false, sum);
  const EightDoubles mean = sum / size;
  for (int64_t i = 0; i < count; ++i) AddDistances(pixels + i * step, mean, true, squares);
  const double all = moments.count + size, share = size / all;
  const EightDoubles distance = mean - moments.mean;
  moments.variance = (1 - share) * moments.variance + share * (squares / size + (1 - share) * distance * distance);
  moments.mean += share * distance;
  moments.count = all;
}

DAUMIER_FOR_EACH_PROCESSOR
void ScaleLanes(const float* from, int64_t count, int64_t step, const float* scales, const float* shifts,
                bool with_relu, float* to) {
  EightFloats scale, shift;
  std::memcpy(&scale, scales, sizeof(scale));
  std::memcpy(&shift, shifts, sizeof(shift));
  for (int64_t i = 0; i < count * step; i += step) {
    EightFloats eight;
    std::memcpy(&eight, from + i, sizeof(eight));
    EightFloats y = eight * scale + shift;
    if (with_relu) y = y < 0 ? EightFloats{} : y;
    std::memcpy(to + i, &y, sizeof(y));
  }
}

}  // namespace

void BlockNorm::Run(const float* from, float* to) const {
  const int64_t groups = block / kNormLanes, plane_size = area * block, pixels = kPartOfRow / block;
  ForEachPart(PartsOf(planes, planes * plane_size), [&](int64_t p) {
    for (int64_t group = 0; group < groups; ++group) {
      const int64_t begin = p * plane_size + group * kNormLanes;
      LaneMoments moments;
      for (int64_t i = 0; i < area; i += pixels)
        MomentsOfLanes(from + begin + i * block, std::min(pixels, area - i), block, moments);
      float lane_scales[kNormLanes], lane_shifts[kNormLanes];
      for (int64_t lane = 0; lane < kNormLanes; ++lane) {
        const auto kind = size_t(p % kinds * block + group * kNormLanes + lane);
        const double scale = scales[kind] / std::sqrt(moments.variance[lane] + epsilon);
        lane_scales[lane] = float(scale);
        lane_shifts[lane] = float(shifts[kind] - moments.mean[lane] * scale);
      }
      ScaleLanes(from + begin, area, block, lane_scales, lane_shifts, with_relu, to + begin);
    }
  });
}

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
        const double y =
            (double(from[i]) - moments.mean) * factor * scales[kind + size_t(i)] + shifts[kind + size_t(i)];
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
