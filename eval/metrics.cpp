#include "eval/metrics.h"

#include "core/error.h"

#include <cmath>

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

double MeanVertexDistance(const FaceRows& predicted, const FaceRows& truth) {
  DAUMIER_CHECK(predicted.rows() == truth.rows() && truth.rows() > 0, "{} faces were predicted of {}", predicted.rows(),
                truth.rows());
  double sum = 0;
  for (size_t i = 0; i < size_t(truth.rows()); ++i)
    sum += Mean(VertexErrors(RowSpan(predicted, i), RowSpan(truth, i), 1));
  return sum / double(truth.rows());
}

double VertexDistance(std::span<const float> face, int vertex_a, int vertex_b) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double difference = double(face[3 * vertex_a + axis]) - face[3 * vertex_b + axis];
    squared += difference * difference;
  }
  return std::sqrt(squared);
}

}  // namespace daumier::eval
