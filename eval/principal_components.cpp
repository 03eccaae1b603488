#include "eval/principal_components.h"

#include "core/random.h"
#include "geometry/symmetric_eigen.h"

#include <Eigen/QR>

#include <algorithm>

namespace daumier::eval {
namespace {

/// Oversampling and number of power iterations: both sharpen the last components.
constexpr Eigen::Index kSpare = 16;
constexpr int kPasses = 6;

/// An orthonormal basis of the span of the rows.
FaceRows OrthonormalRows(FaceRows rows) {
  // Row-major rows are the columns of a column-major matrix. Householder's Q is orthonormal also for dependent columns.
  Eigen::Map<Eigen::MatrixXf> columns(rows.data(), rows.cols(), rows.rows());
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXf>> qr(columns);
  const Eigen::MatrixXf basis = qr.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
  return basis.transpose();
}

}  // namespace

PrincipalComponents FitPrincipalComponents(const CentredRows& vectors, int size, uint64_t seed) {
  const FaceRows& centred = vectors.rows;
  const Eigen::Index num_vectors = centred.rows(), length = centred.cols();
  DAUMIER_CHECK(num_vectors > size && length >= size, "{} principal components of {} vectors of {} numbers", size,
                num_vectors, length);
  const Eigen::Index num_directions = std::min({size + kSpare, num_vectors, length});
  FaceRows scores(num_directions, num_vectors);
  Rng rng = Stream(seed, "principal components");
  for (float& score : scores.reshaped<Eigen::RowMajor>()) score = float(rng.Normal());
  for (int pass = 0; pass < kPasses; ++pass)
    scores = OrthonormalRows(Product(Product(scores, centred), centred.transpose()));
  const FaceRows directions = OrthonormalRows(Product(scores, centred));
  const Eigen::MatrixXd inside = Product(directions, centred.transpose()).cast<double>();
  const geometry::SymmetricEigen eigen =
      geometry::DecomposeSymmetric(inside * inside.transpose() / double(num_vectors));
  const FaceRows axes = eigen.vectors.rightCols(size).rowwise().reverse().transpose().cast<float>();
  return {vectors.mean, Product(axes, directions),
          eigen.values.tail(size).reverse().cwiseMax(0).cwiseSqrt().cast<float>()};
}

}  // namespace daumier::eval
