#pragma once
#include "faces/import/number_array.h"

#include <filesystem>
#include <set>
#include <string>

namespace daumier::faces {

/// The wanted variables of a MATLAB 5 file (what MATLAB saves as -v6 and -v7, and SciPy's savemat): real, full numeric
/// matrices, plain or compressed by zlib. Other variables are skipped.
/// @throws Error naming file and variable: no MATLAB 5 file, version 7.3 (which is HDF5; save it again as -v7),
/// big-endian, truncated, sizes that disagree, a wanted variable that is complex, sparse or no numbers, or one that is
/// missing, with the names of those that the file has.
NumberArrays ReadMatFile(const std::filesystem::path& path, const std::set<std::string>& wanted);

}  // namespace daumier::faces
