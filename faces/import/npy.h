#pragma once
#include "faces/import/number_array.h"

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace daumier::faces {

/// NumPy's .npy: magic "\x93NUMPY", version 1 to 3, header length, a Python dictionary {descr, fortran_order, shape},
/// the elements. Little-endian integers of 1 to 8 bytes and floats of 4 or 8.
/// @throws Error naming `name`: wrong magic or version, malformed header, an object array (which is a Python pickle) or
/// another element type, or a size that disagrees with the shape.
NumberArray ParseNpy(std::string_view bytes, const std::string& name);

/// The wanted arrays of an .npz, a zip archive of .npy files, by name without ".npy"; a wanted one that is not there is
/// left out. @throws Error as ForEachFile and ParseNpy.
NumberArrays ReadNpz(const std::filesystem::path& path, const std::set<std::string>& wanted);

}  // namespace daumier::faces
