#pragma once
#include <cstdint>
#include <span>

/// The one definition of each statistic. All functions throw Error if there is no value or a value is not finite; the
/// message contains its index.
namespace daumier {

double Mean(std::span<const double> values);

/// The value below which a share of `percent` / 100 of the values lies, linear between neighbours in order:
/// Percentile({1, 2, 4}, 50) = 2, Percentile({1, 2, 4}, 75) = 3. O(n). @throws Error also if percent is not in 0..100.
double Percentile(std::span<const double> values, double percent);

/// Percentile(values, 50): the mean of the two middle values if their number is even.
double Median(std::span<const double> values);

struct Interval {
  double low, high;
};

/// The 95 % interval of the mean of `errors` by a bootstrap over persons: each of `num_draws` draws takes as many
/// persons as there are, with replacement, each with all of its faces. Faces of a person resemble each other, so that
/// an interval from resampled faces is too narrow. persons: one a face. One person alone gives low = high = mean.
/// Deterministic in seed. @throws Error also if the lengths differ or num_draws < 1.
Interval PersonBootstrap(std::span<const double> errors, std::span<const int> persons, uint64_t seed,
                         int num_draws = 2000);

}  // namespace daumier
