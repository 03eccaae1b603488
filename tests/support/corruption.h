#pragma once
#include "core/error.h"
#include "core/random.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

/// Damaged files: what readers have to refuse, or at least survive.
namespace daumier::testing {

/// Writes without flushing to disk, since a test that writes thousands of damaged files would wait for each.
inline void WriteQuickly(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Calls `read()` with the file at `path` cut after each of its bytes 0, ..., size - 1, and restores it at the end.
/// Returns how often read() threw daumier::Error; every other exception leaves.
template <class Read>
int CountRefusedTruncations(const std::filesystem::path& path, const std::string& bytes, Read read) {
  int num_refused = 0;
  for (size_t size = 0; size < bytes.size(); ++size) {
    WriteQuickly(path, std::string_view(bytes).substr(0, size));
    try {
      read();
    } catch (const Error&) {
      ++num_refused;
    }
  }
  WriteQuickly(path, bytes);
  return num_refused;
}

/// The same with `count` copies of the file in which one to three random bytes have other values.
template <class Read>
int CountRefusedFlips(const std::filesystem::path& path, const std::string& bytes, int count, Rng& rng, Read read) {
  int num_refused = 0;
  for (int i = 0; i < count; ++i) {
    std::string damaged = bytes;
    for (uint64_t flip = 0; flip <= rng.Below(3); ++flip) {
      damaged[rng.Below(damaged.size())] ^= static_cast<char>(1 + rng.Below(255));
    }
    WriteQuickly(path, damaged);
    try {
      read();
    } catch (const Error&) {
      ++num_refused;
    }
  }
  WriteQuickly(path, bytes);
  return num_refused;
}

}  // namespace daumier::testing
