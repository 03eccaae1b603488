#pragma once
#include "faces/import/number_array.h"

#include <filesystem>
#include <set>
#include <string>

namespace daumier::faces {

/// The wanted data sets of an HDF5 file by their paths ("shape/model/mean"); one that is not there is left out.
/// Integers of 1 to 8 bytes and floats of 4 or 8, row-major.
/// @throws Error naming file and data set: no HDF5 file, truncated, or other elements than numbers.
NumberArrays ReadHdf5(const std::filesystem::path& path, const std::set<std::string>& wanted);

/// The names of the groups and data sets at the top of an HDF5 file. @throws Error naming a file that is none, or
/// truncated.
std::set<std::string> Hdf5Names(const std::filesystem::path& path);

}  // namespace daumier::faces
