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

/// The moments of eight channels, whose numbers lie `step` apart.
DAUMIER_FOR_EACH_PROCESSOR
void MomentsOfLanes(const float* pixels, int64_t count, int64_t step, Moments* moments) {
  const auto size = double(count);
  EightDoubles sum = {}, squares = {};
  for (int64_t i = 0; i < count; ++i) AddDistances(pixels + i * step, EightDoubles{}, false, sum);
  const EightDoubles mean = sum / size;
  for (int64_t i = 0; i < count; ++i) AddDistances(pixels + i * step, mean, true, squares);
  for (int64_t lane = 0; lane < kNormLanes; ++lane) moments[lane] = {size, mean[lane], squares[lane] / size};
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
  const int64_t planes = (channels + block - 1) / block, plane_size = area * block, lanes = planes * block;
  const int64_t pixels = kPartOfRow / block;
  std::vector<Moments> moments(size_t(images * lanes));
  const Parts parts = PartsOf(images * planes, images * planes * plane_size);
  ForEachPart(parts, [&](int64_t p) {
    for (int64_t i = 0; i < area; i += pixels) {
      for (int64_t first = 0; first < block; first += kNormLanes) {
        Moments of_part[kNormLanes], *const all = moments.data() + p * block + first;
        MomentsOfLanes(from + p * plane_size + i * block + first, std::min(pixels, area - i), block, of_part);
        for (int64_t lane = 0; lane < kNormLanes; ++lane) all[lane] = Merged(all[lane], of_part[lane]);
      }
    }
  });
  std::vector<float> lane_scales(moments.size(), 0), lane_shifts(moments.size(), 0);
  for (int64_t n = 0; n < images; ++n) {
    for (int64_t c = 0; c < channels; c += of_group) {
      Moments group;
      for (int64_t i = c; i < c + of_group; ++i) group = Merged(group, moments[size_t(n * lanes + i)]);
      for (int64_t i = c; i < c + of_group; ++i) {
        const double scale = scales[size_t(i)] / std::sqrt(group.variance + epsilon);
        lane_scales[size_t(n * lanes + i)] = float(scale);
        lane_shifts[size_t(n * lanes + i)] = float(shifts[size_t(i)] - group.mean * scale);
      }
    }
  }
  ForEachPart(parts, [&](int64_t p) {
    for (int64_t first = 0; first < block; first += kNormLanes) {
      const int64_t begin = p * plane_size + first, lane = p * block + first;
      ScaleLanes(from + begin, area, block, &lane_scales[size_t(lane)], &lane_shifts[size_t(lane)], with_relu,
                 to + begin);
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
