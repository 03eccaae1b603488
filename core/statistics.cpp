#include "core/statistics.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace daumier {
namespace {

void CheckValues(std::span<const double> values, const char* what) {
  DAUMIER_CHECK(!values.empty(), "{} of no values, expected at least one", what);
  for (size_t i = 0; i < values.size(); ++i)
    DAUMIER_CHECK(std::isfinite(values[i]), "{} of values of which number {} is {}", what, i, values[i]);
}

}  // namespace

double Mean(std::span<const double> values) {
  CheckValues(values, "a mean");
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double Percentile(std::span<const double> values, double percent) {
  CheckValues(values, "a percentile");
  DAUMIER_CHECK(percent >= 0 && percent <= 100, "percentile {}, expected 0 to 100", percent);
  std::vector<double> ranked(values.begin(), values.end());
  const double position = percent / 100 * double(ranked.size() - 1);
  const auto below = ranked.begin() + std::ptrdiff_t(position);
  std::nth_element(ranked.begin(), below, ranked.end());
  if (below + 1 == ranked.end()) return *below;
  const double above = *std::min_element(below + 1, ranked.end());
  return *below + (position - std::floor(position)) * (above - *below);
}

double Median(std::span<const double> values) {
  return Percentile(values, 50);
}

Interval PersonBootstrap(std::span<const double> errors, std::span<const int> persons, uint64_t seed, int num_draws) {
  DAUMIER_CHECK(errors.size() == persons.size(), "{} errors of {} faces", errors.size(), persons.size());
  DAUMIER_CHECK(num_draws > 0, "a bootstrap of {} draws, expected at least 1", num_draws);
  CheckValues(errors, "a bootstrap");
  struct Cluster {
    double sum = 0;
    double count = 0;
  };
  std::map<int, Cluster> cluster_of_person;
  for (size_t face = 0; face < errors.size(); ++face) {
    Cluster& cluster = cluster_of_person[persons[face]];
    cluster.sum += errors[face];
    cluster.count += 1;
  }
  std::vector<Cluster> clusters;
  for (const auto& [person, cluster] : cluster_of_person) clusters.push_back(cluster);

  Rng rng = Stream(seed, "bootstrap");
  std::vector<double> means(num_draws);
  for (double& mean : means) {
    Cluster drawn;
    for (size_t i = 0; i < clusters.size(); ++i) {
      const Cluster& cluster = clusters[rng.Below(clusters.size())];
      drawn.sum += cluster.sum;
      drawn.count += cluster.count;
    }
    mean = drawn.sum / drawn.count;
  }
  return {Percentile(means, 2.5), Percentile(means, 97.5)};
}

}  // namespace daumier
