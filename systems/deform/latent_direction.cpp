#include "systems/deform/latent_direction.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/import/npy.h"

namespace daumier::deform {

LatentDirection LatentDirectionOf(const fitting::CodeModel& model, const Eigen::VectorXd& direction) {
  const Eigen::Index num_numbers = model.num_numbers();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(num_numbers), mean = model.Latent(zero);
  DAUMIER_CHECK(direction.size() == mean.size(), "a direction of {} numbers, expected {}, as the codes of the model",
                direction.size(), mean.size());
  DAUMIER_CHECK(direction.allFinite() && direction.norm() > 0,
                "the direction has a number that is not finite, or is 0");
  Eigen::MatrixXd factor(mean.size(), num_numbers);  // Its columns are orthogonal.
  for (Eigen::Index k = 0; k < num_numbers; ++k)
    factor.col(k) = model.Latent(Eigen::VectorXd::Unit(num_numbers, k)) - mean;
  const Eigen::VectorXd along = factor.transpose() * direction.normalized();
  const double deviation = along.norm();
  return {deviation * along.cwiseQuotient(factor.colwise().squaredNorm().transpose()), deviation};
}

LatentDirection ReadLatentDirection(const fitting::CodeModel& model, const std::filesystem::path& path) {
  const faces::NumberArray array = faces::ParseNpy(ReadFile(path), path.string());
  try {
    return LatentDirectionOf(model, array.Vector().cast<double>());
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

bool IsDirectionFile(const std::string& label) {
  return label.ends_with(".npy");
}

}  // namespace daumier::deform
