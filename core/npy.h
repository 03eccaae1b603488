#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier {

/// A table of numbers as NumPy stores it: rows x columns, row-major.
struct NpyTable {
  int64_t rows = 0, columns = 0;
  std::vector<float> numbers;
};

/// The bytes of an .npy file (format 1.0, '<f4', C order, two axes); the same table gives the same bytes.
/// @throws Error unless there are rows x columns numbers.
std::string EncodeNpy(const NpyTable& table);
/// Reads '<f4' and '<f8' of two axes, in C order. @throws Error naming `name` and what was found: no .npy file, another type,
/// order or number of axes, truncated.
NpyTable DecodeNpy(std::string_view bytes, const std::string& name);

/// EncodeNpy into a file, atomically. @throws Error as WriteFileAtomically.
void WriteNpy(const std::filesystem::path& file, const NpyTable& table);
/// @throws Error as ReadFile and DecodeNpy.
NpyTable ReadNpy(const std::filesystem::path& file);

}  // namespace daumier
