#pragma once
#include "faces/head_material.h"

#include <Eigen/Core>

namespace daumier::rig {

/// Display RGB in [0, 1] of a material of a head without a texture.
Eigen::Vector3f MaterialColour(faces::HeadMaterial material);

}  // namespace daumier::rig
