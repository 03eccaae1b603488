#include "faces/principal_components.h"

#include "core/error.h"
#include "faces/leading_eigenvectors.h"

#include <algorithm>

namespace daumier::faces {

Eigen::MatrixXd GramMatrix(int num_faces, int num_coordinates, const std::function<std::span<const float>(int)>& face,
                           Centring centring) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(num_faces, num_faces);
  constexpr int kBlock = 4096;
  Eigen::MatrixXd block;
  for (int begin = 0; begin < num_coordinates; begin += kBlock) {
    const int width = std::min(kBlock, num_coordinates - begin);
    block.resize(num_faces, width);
    for (int i = 0; i < num_faces; ++i) {
      const std::span<const float> coordinates = face(i);
      DAUMIER_CHECK(int(coordinates.size()) == num_coordinates, "face {} has {} coordinates, expected {}", i,
                    coordinates.size(), num_coordinates);
      block.row(i) = Eigen::Map<const Eigen::RowVectorXf>(coordinates.data() + begin, width).cast<double>();
    }
    if (centring == Centring::kMean) block.rowwise() -= block.colwise().mean().eval();
    gram.selfadjointView<Eigen::Lower>().rankUpdate(block);
  }
  return gram.selfadjointView<Eigen::Lower>();
}

SnapshotComponents FindComponents(const Eigen::MatrixXd& gram, int most, double least_share) {
  const auto [variances, vectors] = FindLeadingEigenvectors(gram, most);
  const Eigen::Index count = (variances.array() > std::max(0.0, least_share * variances[0])).count();
  return {variances.head(count),
          vectors.leftCols(count) * variances.head(count).cwiseSqrt().cwiseInverse().asDiagonal()};
}

}  // namespace daumier::faces
