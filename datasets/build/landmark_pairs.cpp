#include "datasets/build/landmark_pairs.h"

#include <cmath>

namespace daumier::datasets {

int SameLandmark(int landmark) {
  return landmark;
}

LandmarkPairs PairsOf(const FitInput& input, const MeshLandmarks& places, const SourceLandmark& source) {
  LandmarkPairs pairs;
  for (int l = 0; l < faces::kNumLandmarks; ++l) {
    if (places[size_t(source(l))]) pairs.landmarks.push_back(l);
  }
  const auto count = static_cast<Eigen::Index>(pairs.landmarks.size());
  pairs.places.resize(count, 3);
  pairs.rest.resize(count, 3);
  pairs.weights.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const int l = pairs.landmarks[size_t(k)];
    pairs.places.row(k) = places[size_t(source(l))]->transpose();
    pairs.rest.row(k) = input.face.neutral.row(input.face.annotation.landmarks[size_t(l)]);
    pairs.weights[k] = l < faces::kNumContourLandmarks ? input.contour_weight : 1.0;
  }
  return pairs;
}

double SpreadOf(const geometry::Points& points, const Eigen::VectorXd& weights) {
  const Eigen::RowVector3d centre = weights.transpose() * points / weights.sum();
  return std::sqrt(weights.dot((points.rowwise() - centre).rowwise().squaredNorm()) / weights.sum());
}

Eigen::VectorXd Residuals(const LandmarkPairs& pairs) {
  const geometry::Similarity similarity = geometry::AlignRobustly(pairs.places, pairs.rest, pairs.weights);
  return (similarity.Apply(pairs.places) - pairs.rest).rowwise().norm() / SpreadOf(pairs.rest, pairs.weights);
}

double MisfitOf(const LandmarkPairs& pairs) {
  return pairs.weights.dot(Residuals(pairs)) / pairs.weights.sum();
}

}  // namespace daumier::datasets
