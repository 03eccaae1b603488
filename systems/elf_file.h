#pragma once
#include <filesystem>

namespace daumier::systems {

/// Checks that a shared library is a whole ELF file of 64 bits: its program and section headers and the bytes of every
/// loaded segment lie within the file. The loader maps a truncated one without an error, and the process dies of SIGBUS
/// when it reads what is missing.
/// @throws Error naming the file and what is wrong.
void CheckElfIsWhole(const std::filesystem::path& file);

}  // namespace daumier::systems
