#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace daumier::rig {

/// Displacements of a mesh by name: S = S_0 + sum_t w_t offset_t, w_t in 0 .. 1 [Pan et al. 2024, section 3.2.4].
struct MorphTargets {
  std::vector<std::string> names;  ///< T
  Eigen::MatrixXf offsets;         ///< 3V x T, cm, coordinates of a vertex next to each other (x0 y0 z0 x1 ...).

  int num_targets() const { return static_cast<int>(names.size()); }
};

}  // namespace daumier::rig
