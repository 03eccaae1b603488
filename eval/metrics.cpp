#include "eval/metrics.h"

#include "core/error.h"
#include "core/random.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace daumier::eval {
namespace {

double VertexError(std::span<const float> predicted, std::span<const float> truth, size_t vertex) {
  double squared = 0;
  for (size_t axis = 3 * vertex; axis < 3 * vertex + 3; ++axis) {
    const double difference = double(predicted[axis]) - truth[axis];
    squared += difference * difference;
  }
  return std::sqrt(squared);
}

void CheckFaces(std::span<const float> predicted, std::span<const float> truth) {
  DAUMIER_CHECK(predicted.size() == truth.size(), "the prediction has {} coordinates and the truth {}",
                predicted.size(), truth.size());
  DAUMIER_CHECK(truth.size() % 3 == 0, "{} coordinates are no whole number of vertices", truth.size());
}

}  // namespace

std::vector<double> VertexErrors(std::span<const float> predicted, std::span<const float> truth, double mm_per_cm) {
  CheckFaces(predicted, truth);
  std::vector<double> errors(truth.size() / 3);
  for (size_t vertex = 0; vertex < errors.size(); ++vertex)
    errors[vertex] = mm_per_cm * VertexError(predicted, truth, vertex);
  return errors;
}

double MeanVertexError(std::span<const float> predicted, std::span<const float> truth, std::span<const int> region,
                       double mm_per_cm) {
  CheckFaces(predicted, truth);
  DAUMIER_CHECK(!region.empty(), "the region over which the error is averaged is empty");
  double sum = 0;
  for (const int vertex : region) {
    DAUMIER_CHECK(vertex >= 0 && size_t(vertex) < truth.size() / 3, "the region has vertex {}, the face {} vertices",
                  vertex, truth.size() / 3);
    sum += VertexError(predicted, truth, vertex);
  }
  return mm_per_cm * sum / double(region.size());
}

double VertexDistance(std::span<const float> face, int vertex_a, int vertex_b) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double difference = double(face[3 * vertex_a + axis]) - face[3 * vertex_b + axis];
    squared += difference * difference;
  }
  return std::sqrt(squared);
}

double Mean(std::span<const double> values) {
  DAUMIER_CHECK(!values.empty(), "the mean of no value is asked for");
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double Percentile(std::span<const double> values, double percent) {
  DAUMIER_CHECK(!values.empty(), "a percentile of no value is asked for");
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double position = std::clamp(percent / 100, 0.0, 1.0) * double(sorted.size() - 1);
  const size_t below = size_t(position);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - double(below)) * (sorted[above] - sorted[below]);
}

Interval PersonBootstrap(std::span<const double> errors, std::span<const int> persons, uint64_t seed, int num_draws) {
  DAUMIER_CHECK(errors.size() == persons.size(), "{} errors of {} faces", errors.size(), persons.size());
  DAUMIER_CHECK(!errors.empty() && num_draws > 0, "a bootstrap needs at least one face and one draw");
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

}  // namespace daumier::eval
