#pragma once
#include <filesystem>
#include <functional>
#include <optional>

namespace daumier {

/// The folder of the program that this code is in, or of the shared library (libdaumier.so); empty where the system does not say.
std::filesystem::path ProgramFolder();

/// The nearest of a folder and the folders above it for which `holds` is true: how the program finds what lies in its
/// repository (build/release/bin/daumier -> tools/npm) or where it is installed.
std::optional<std::filesystem::path> NearestAbove(const std::filesystem::path& folder,
                                                  const std::function<bool(const std::filesystem::path&)>& holds);

}  // namespace daumier
