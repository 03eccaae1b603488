#include "rig/blend.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::rig {
namespace {

BlendBlock BlockAt(const float* coordinates) {
  BlendBlock block;
  std::copy_n(coordinates, kBlendBlockFloats, block.values);
  return block;
}

bool Moves(const BlendBlock& block, float tolerance) {
  return std::ranges::any_of(block.values, [&](float value) { return !(std::abs(value) <= tolerance); });
}

}  // namespace

Blend::Blend(const geometry::Points& rest, const MorphTargets& targets, float tolerance_cm)
    : num_vertices_(static_cast<int>(rest.rows())),
      tail_begin_(3 * num_vertices_ / kBlendBlockFloats * kBlendBlockFloats) {
  const Eigen::Index num_coordinates = 3 * rest.rows(), num_targets = targets.offsets.cols();
  DAUMIER_CHECK(targets.num_targets() == num_targets, "{} names of targets for {} columns of offsets",
                targets.num_targets(), num_targets);
  DAUMIER_CHECK(targets.offsets.rows() == num_coordinates || num_targets == 0,
                "offsets of targets have {} rows, expected {} for {} vertices", targets.offsets.rows(), num_coordinates,
                rest.rows());
  const Eigen::VectorXf at_rest = Eigen::Map<const Eigen::VectorXd>(rest.data(), num_coordinates).cast<float>();
  for (int i = 0; i < tail_begin_; i += kBlendBlockFloats) rest_.push_back(BlockAt(at_rest.data() + i));
  rest_tail_.assign(at_rest.data() + tail_begin_, at_rest.data() + num_coordinates);
  first_runs_.push_back(0);
  for (Eigen::Index target = 0; target < num_targets; ++target) {
    const float* const column = targets.offsets.col(target).data();
    for (int block = 0; block * kBlendBlockFloats < tail_begin_; ++block) {
      const BlendBlock offset = BlockAt(column + block * kBlendBlockFloats);
      if (!Moves(offset, tolerance_cm)) continue;
      const bool is_first = static_cast<int>(runs_.size()) == first_runs_.back();
      const bool begins =
          is_first || block % kBlendChunkBlocks == 0 || block != runs_.back().first_block + runs_.back().num_blocks;
      if (begins) runs_.push_back({block, 0, static_cast<int32_t>(offsets_.size())});
      ++runs_.back().num_blocks;
      offsets_.push_back(offset);
    }
    tails_.insert(tails_.end(), column + tail_begin_, column + num_coordinates);
    first_runs_.push_back(static_cast<int>(runs_.size()));
  }
}

void Blend::Apply(std::span<const float> weights, std::span<float> positions) const {
  DAUMIER_CHECK(static_cast<int>(weights.size()) == num_targets(), "{} weights for {} targets", weights.size(),
                num_targets());
  DAUMIER_CHECK(positions.size() == size_t(3 * num_vertices_), "{} coordinates, expected {} for {} vertices",
                positions.size(), 3 * num_vertices_, num_vertices_);
  std::vector<BlendTerm> terms;
  terms.reserve(weights.size());
  std::copy(rest_tail_.begin(), rest_tail_.end(), positions.begin() + tail_begin_);
  for (int target = 0; target < num_targets(); ++target) {
    const float weight = weights[size_t(target)];
    if (weight == 0) continue;
    terms.push_back(
        {runs_.data() + first_runs_[size_t(target)], runs_.data() + first_runs_[size_t(target) + 1], weight});
    for (size_t i = 0; i < rest_tail_.size(); ++i)
      positions[size_t(tail_begin_) + i] += weight * tails_[size_t(target) * rest_tail_.size() + i];
  }
  SumBlocks(rest_.data(), offsets_.data(), terms.data(), static_cast<int>(terms.size()), static_cast<int>(rest_.size()),
            positions.data());
}

geometry::Points Blend::At(std::span<const float> weights) const {
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> positions(num_vertices_, 3);
  Apply(weights, {positions.data(), size_t(positions.size())});
  return positions.cast<double>();
}

}  // namespace daumier::rig
