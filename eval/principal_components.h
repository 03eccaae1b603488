#pragma once
#include "eval/face_rows.h"

#include <cstdint>

namespace daumier::eval {

/// The directions in which vectors differ most.
struct PrincipalComponents {
  Eigen::RowVectorXf mean;     ///< D
  FaceRows rows;               ///< K x D, orthonormal, the strongest first.
  Eigen::VectorXf deviations;  ///< K: standard deviation of the vectors along each row.
};

/// The first `size` principal components of vectors (n x D), by block power iteration in float32 on the side of the
/// vectors [Halko et al. 2011, algorithm 4.4]. Orthonormal also where the vectors vary in fewer directions.
/// Deterministic in seed. @throws Error if there are no more vectors than components.
PrincipalComponents FitPrincipalComponents(const CentredRows& vectors, int size, uint64_t seed);

}  // namespace daumier::eval
