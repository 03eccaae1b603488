#include "eval/linear_model.h"

#include "eval/metrics.h"

#include <limits>

namespace daumier::eval {
namespace {

/// The scores of faces on the components.
FaceRows ScoresOf(const PrincipalComponents& components, const FaceRows& faces) {
  DAUMIER_CHECK(faces.cols() == components.mean.size(), "faces have {} coordinates, expected {}", faces.cols(),
                components.mean.size());
  const FaceRows centred = faces.rowwise() - components.mean;
  return Product(centred, components.rows.transpose());
}

FaceRows FacesOf(const PrincipalComponents& components, const FaceRows& scores, double ridge) {
  const Eigen::ArrayXd variances = components.deviations.cast<double>().array().square();
  const double prior = ridge * variances.mean();
  const Eigen::ArrayXd shrinkage = variances.unaryExpr([&](double v) { return v > 0 ? v / (v + prior) : 0.0; });
  const FaceRows shrunk = scores * shrinkage.cast<float>().matrix().asDiagonal();
  return Product(shrunk, components.rows).rowwise() + components.mean;
}

}  // namespace

FaceRows LinearModel::Predict(const FaceRows& faces) const {
  return FacesOf(components, ScoresOf(components, faces), ridge);
}

std::optional<int> LinearModel::ComponentsFor(double share) const {
  double explained = 0;
  for (Eigen::Index k = 0; k < components.deviations.size(); ++k) {
    explained += double(components.deviations[k]) * components.deviations[k];
    if (explained >= share * total_variance) return int(k) + 1;
  }
  return std::nullopt;
}

LinearModel FitLinearModel(const CentredRows& training, const FaceRows& validation, int num_components, uint64_t seed) {
  const Eigen::Index num_training = training.rows.rows();
  DAUMIER_CHECK(num_training > 1, "a linear model is fitted to two training faces or more, not {}", num_training);
  DAUMIER_CHECK(validation.rows() > 0, "the ridge weight of a linear model is chosen on validation faces: none");
  DAUMIER_CHECK(validation.allFinite(), "a validation face contains a number that is not finite");
  const int size = int(std::min<Eigen::Index>(num_components, num_training - 1));
  LinearModel model;
  model.components = FitPrincipalComponents(training, size, seed);
  for (Eigen::Index i = 0; i < num_training; ++i)
    model.total_variance += double(training.rows.row(i).squaredNorm()) / double(num_training);
  const FaceRows scores = ScoresOf(model.components, validation);
  double least = std::numeric_limits<double>::infinity();
  for (const double ridge : {0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    const double error = MeanVertexDistance(FacesOf(model.components, scores, ridge), validation);
    if (error < least) {
      least = error;
      model.ridge = ridge;
    }
  }
  return model;
}

}  // namespace daumier::eval
