#pragma once
#include "core/random.h"
#include "rig/arkit_names.h"
#include "rig/morph_targets.h"

namespace daumier::testing {

/// The 52 targets as random displacements of some vertices, of a centimetre.
inline rig::MorphTargets RandomTargets(int num_vertices, Rng& rng) {
  rig::MorphTargets targets{{rig::ArkitNames().begin(), rig::ArkitNames().end()},
                            Eigen::MatrixXf(3 * num_vertices, rig::kNumArkitNames)};
  for (float& x : targets.offsets.reshaped()) x = float(rng.Normal());
  return targets;
}

/// Weights of which about a third are not 0, within the limits of targets; tongueOut is 0.
inline Eigen::VectorXd RandomWeights(Rng& rng) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(rig::kNumArkitNames);
  for (double& w : weights)
    if (rng.Below(3) == 0) w = rng.Uniform(0, 0.6);
  const auto at = [&](const char* name) -> double& { return weights[*rig::FindArkitName(name)]; };
  at("mouthClose") = std::min(at("mouthClose"), at("jawOpen"));
  at("tongueOut") = 0;
  return weights;
}

}  // namespace daumier::testing
