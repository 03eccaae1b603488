#include "fitting/smooth_modes.h"

#include "core/error.h"
#include "core/parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace daumier::fitting {
namespace {

/// k(p, q) + sign * k(p, q's mirror image), k the squared exponential of variance 1/2: a row a centre, a column a position.
Eigen::MatrixXd MirroredKernel(const geometry::Points& centres, const geometry::Points& positions, double length,
                               double sign) {
  Eigen::MatrixXd kernel(centres.rows(), positions.rows());
  const auto k = [&](double squared) { return 0.5 * std::exp(-squared / (2 * length * length)); };
  for (Eigen::Index j = 0; j < positions.rows(); ++j) {
    for (Eigen::Index i = 0; i < centres.rows(); ++i) {
      const geometry::Vector3 centre = centres.row(i), image(-centre.x(), centre.y(), centre.z()),
                              position = positions.row(j);
      kernel(i, j) = k((centre - position).squaredNorm()) + sign * k((image - position).squaredNorm());
    }
  }
  return kernel;
}

struct ScalarModes {
  Eigen::VectorXd variances;
  Eigen::MatrixXd rows;  ///< M x V, unit deviation.
};

ScalarModes ModesOfKernel(const geometry::Points& centres, const geometry::Points& positions, double length,
                          double sign, double least_share) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(MirroredKernel(centres, centres, length, sign));
  const Eigen::VectorXd& values = eigen.eigenvalues();  // Ascending.
  const Eigen::Index count = (values.array() > least_share * values[values.size() - 1]).count();
  ScalarModes modes;
  modes.variances = values.tail(count).reverse();
  const Eigen::MatrixXd vectors = eigen.eigenvectors().rightCols(count).rowwise().reverse();
  modes.rows = modes.variances.cwiseSqrt().cwiseInverse().asDiagonal() * vectors.transpose() *
               MirroredKernel(centres, positions, length, sign);
  return modes;
}

}  // namespace

SmoothModes MakeSmoothModes(const geometry::Points& positions, const geometry::Points& centres,
                            const SmoothModesOptions& options) {
  DAUMIER_CHECK(centres.rows() > 0, "smooth displacements need centres");
  DAUMIER_CHECK(options.length_cm > 0 && options.deviation_cm > 0, "smooth displacements of length {}, deviation {}",
                options.length_cm, options.deviation_cm);
  const double symmetric = options.deviation_cm * std::sqrt(2 / (1 + std::pow(options.asymmetry, 2)));
  struct Mode {
    double variance;
    Eigen::VectorXd values;
    int axis;
  };
  std::vector<Mode> modes;
  constexpr std::array<double, 2> kSigns = {-1, 1};
  std::array<ScalarModes, 2> of_sign;
  OnAllCores(2, [&](int64_t i) {
    of_sign[size_t(i)] = ModesOfKernel(centres, positions, options.length_cm, kSigns[size_t(i)], options.least_share);
  });
  for (size_t i = 0; i < 2; ++i) {
    const double sign = kSigns[i];
    const ScalarModes& scalar = of_sign[i];
    for (const int axis : {0, 1}) {
      // Symmetric: x of the image is -x, y is y.
      const bool is_symmetric = (axis == 0) == (sign < 0);
      const double deviation = is_symmetric ? symmetric : symmetric * options.asymmetry;
      if (deviation <= 0) continue;
      for (Eigen::Index k = 0; k < scalar.variances.size(); ++k)
        modes.push_back(
            {scalar.variances[k] * deviation * deviation, deviation * scalar.rows.row(k).transpose(), axis});
    }
  }
  std::stable_sort(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) { return a.variance > b.variance; });
  SmoothModes result;
  result.rows.setZero(Eigen::Index(modes.size()), 2 * positions.rows());
  for (size_t m = 0; m < modes.size(); ++m) {
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
      result.rows(Eigen::Index(m), 2 * v + modes[m].axis) = float(modes[m].values[v]);
  }
  return result;
}

}  // namespace daumier::fitting
