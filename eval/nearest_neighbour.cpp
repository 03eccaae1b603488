#include "eval/nearest_neighbour.h"

#include <limits>

namespace daumier::eval {
namespace {

/// Bound of the rounding error of |a|^2 - 2 a b in float, relative to |a|^2 + |b|^2. Errors of 34,000 terms are 1e-6.
constexpr float kRounding = 1e-4f;

}  // namespace

NearestNeighbour::NearestNeighbour(FaceRows rows) : rows_(std::move(rows)) {
  DAUMIER_CHECK(rows_.rows() > 0, "a nearest neighbour needs training faces");
  squared_norms_ = rows_.rowwise().squaredNorm().transpose();
}

std::vector<int> NearestNeighbour::Nearest(const FaceRows& queries) const {
  DAUMIER_CHECK(queries.cols() == rows_.cols(), "a query has {} numbers, expected {}", queries.cols(), rows_.cols());
  const FaceRows products = Product(queries, rows_.transpose());
  std::vector<int> nearest;
  for (Eigen::Index i = 0; i < queries.rows(); ++i) {
    DAUMIER_CHECK(queries.row(i).allFinite(), "query {} contains a number that is not finite", i);
    const Eigen::RowVectorXf approximate = squared_norms_ - 2 * products.row(i);  // Without |query|^2.
    const float limit = approximate.minCoeff() + kRounding * (squared_norms_.maxCoeff() + queries.row(i).squaredNorm());
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index row = 0; row < rows_.rows(); ++row) {
      if (approximate[row] > limit) continue;
      const double distance = (rows_.row(row).cast<double>() - queries.row(i).cast<double>()).squaredNorm();
      if (distance < least) {
        least = distance;
        best = int(row);
      }
    }
    nearest.push_back(best);
  }
  return nearest;
}

int NearestNeighbour::Nearest(std::span<const float> query) const {
  return Nearest(FaceRows(AsRow(query)))[0];
}

}  // namespace daumier::eval
