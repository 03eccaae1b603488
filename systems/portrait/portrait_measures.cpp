#include "systems/portrait/portrait_measures.h"

#include "core/error.h"
#include "geometry/alignment.h"

#include <cmath>

namespace daumier::portrait {

ShapeMeasure::ShapeMeasure(const faces::FaceTemplate& face_template)
    : mm_per_cm_(faces::MillimetresPerCm(face_template)),
      weights_(Eigen::VectorXd::Zero(face_template.num_vertices())),
      openings_(faces::FindOpenings(face_template)) {
  for (const int vertex : faces::RegionFor(face_template.annotation, "face", "errors")) weights_[vertex] = 1;
}

double ShapeMeasure::SimilarityErrorMm(const geometry::Points& predicted, const geometry::Points& truth) const {
  const geometry::Points aligned = geometry::AlignSimilarity(predicted, truth, weights_).Apply(predicted);
  return mm_per_cm_ * (aligned - truth).rowwise().norm().dot(weights_) / weights_.sum();
}

std::array<double, 3> ShapeMeasure::GapsMm(const geometry::Points& vertices) const {
  return {mm_per_cm_ * faces::MeanGap(openings_.lids[0], vertices),
          mm_per_cm_ * faces::MeanGap(openings_.lids[1], vertices),
          mm_per_cm_ * faces::MeanGap(openings_.lips, vertices)};
}

OpeningErrors CompareGaps(const std::array<double, 3>& predicted, const std::array<float, 3>& truth) {
  OpeningErrors errors;
  const bool right = truth[0] < kClosedMm, left = truth[1] < kClosedMm;
  const double of_right = std::abs(predicted[0] - truth[0]), of_left = std::abs(predicted[1] - truth[1]);
  if (right && left) errors.closed_eyes = (of_right + of_left) / 2;
  if (right != left) {
    errors.closed_eyes = right ? of_right : of_left;
    errors.wink = std::abs((predicted[0] - predicted[1]) - (double(truth[0]) - double(truth[1])));
  }
  errors.mouth = std::abs(predicted[2] - truth[2]);
  return errors;
}

}  // namespace daumier::portrait
