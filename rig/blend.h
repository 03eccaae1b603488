#pragma once
#include "geometry/mesh.h"
#include "rig/blend_kernel.h"
#include "rig/morph_targets.h"

#include <cstddef>
#include <span>
#include <vector>

namespace daumier::rig {

/// 0.001 mm.
inline constexpr float kLeastMoveCm = 1e-4f;

/// The faces of a rig, fast: S = S_0 + sum_t w_t offset_t [Pan et al. 2024, section 3.2.4] in float32, on the calling
/// thread. Of each target only blocks of 16 coordinates are stored in which a vertex moves; targets of weight 0 cost
/// nothing. Does not change after construction, so that threads may share one.
class Blend {
 public:
  /// `rest`: V x 3, cm. A block is left out where no coordinate moves by more than `tolerance_cm` at weight 1: transferred
  /// expressions move most vertices by less than 0.001 mm, which no picture shows.
  /// @throws Error unless the targets have as many names as columns, and 3V rows.
  Blend(const geometry::Points& rest, const MorphTargets& targets, float tolerance_cm = kLeastMoveCm);

  int num_vertices() const { return num_vertices_; }
  int num_targets() const { return static_cast<int>(first_runs_.size()) - 1; }
  /// Bytes of offsets that are stored; 4 x 3V x T if every coordinate moves.
  size_t num_bytes() const { return offsets_.size() * sizeof(BlendBlock) + tails_.size() * sizeof(float); }

  /// weights: T, any numbers. positions: 3V, cm, coordinates of a vertex next to each other (x0 y0 z0 x1 ...).
  /// @throws Error if a size differs.
  void Apply(std::span<const float> weights, std::span<float> positions) const;
  /// The same as V x 3.
  geometry::Points At(std::span<const float> weights) const;

 private:
  int num_vertices_, tail_begin_;  ///< Coordinates from tail_begin_ on fill no block.
  std::vector<BlendBlock> rest_, offsets_;
  std::vector<float> rest_tail_, tails_;  ///< tails_: T x the length of rest_tail_.
  std::vector<BlendRun> runs_;
  std::vector<int> first_runs_;  ///< T + 1: runs of target t are first_runs_[t] .. first_runs_[t + 1] - 1.
};

}  // namespace daumier::rig
