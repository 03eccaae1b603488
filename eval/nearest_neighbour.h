#pragma once
#include "eval/face_rows.h"

#include <span>
#include <vector>

namespace daumier::eval {

/// Nearest row by the sum of squared differences, the first of equals. Exact: products in float only preselect rows.
/// Fastest on rows without their mean, of which fewest are preselected.
class NearestNeighbour {
 public:
  /// @throws Error if there is no row.
  explicit NearestNeighbour(FaceRows rows);

  /// Index of the row nearest to each query. May be called from several threads.
  /// @throws Error if the lengths differ or a number of a query is not finite.
  std::vector<int> Nearest(const FaceRows& queries) const;
  int Nearest(std::span<const float> query) const;

  const FaceRows& rows() const { return rows_; }

 private:
  FaceRows rows_;
  Eigen::RowVectorXf squared_norms_;
};

}  // namespace daumier::eval
