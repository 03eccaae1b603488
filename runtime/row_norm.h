#pragma once
#include <cstdint>
#include <vector>

namespace daumier::runtime {

/// Mean and biased variance of numbers, summed in float64 by parts whose moments are merged [Chan et al. 1983].
struct Moments {
  double count = 0, mean = 0, variance = 0;
};
Moments MomentsOf(const float* numbers, int64_t count);

/// y = (x - mean) / sqrt(variance + epsilon) scale + shift of plain rows, each of its own mean and variance. A row has
/// `runs` runs of `length` numbers, each run a scale and a shift. Large arrays are computed on all cores, with the same
/// results.
struct RowNorm {
  int64_t rows = 0, runs = 0, length = 0;
  int64_t kinds = 1;  ///< Of rows, one after the other: row r has the scales from (r mod kinds) * runs on.
  float epsilon = 0;
  std::vector<float> scales = {}, shifts = {};  ///< kinds * runs
  bool with_relu = false;                       ///< y = max(y, 0)

  void Run(const float* from, float* to) const;
};

/// The same for images in blocks of 8 or 16 channels, with a mean and a variance for each group of channels: planes of
/// `area` pixels of `block` numbers each.
struct BlockNorm {
  int64_t images = 1, channels = 0, area = 0;
  int block = 8;
  int64_t of_group = 1;  ///< Channels of a group; 1: a norm of images.
  float epsilon = 0;
  std::vector<float> scales = {}, shifts = {};  ///< By channels. What fills up a block becomes 0.
  bool with_relu = false;

  void Run(const float* from, float* to) const;
};

}  // namespace daumier::runtime
