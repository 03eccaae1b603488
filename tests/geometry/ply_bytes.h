#pragma once
#include "geometry/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace daumier::testing {

using geometry::PlyFormat;

constexpr PlyFormat kPlyFormats[] = {PlyFormat::kAscii, PlyFormat::kLittleEndian, PlyFormat::kBigEndian};

/// The bytes of a PLY file, number by number; test hosts are little-endian.
class PlyBytes {
 public:
  /// `header`: the lines between format and end_header.
  PlyBytes(PlyFormat format, const std::string& header) : format_(format) {
    const char* const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    bytes_ = fmt::format("ply\nformat {} 1.0\n{}end_header\n", names[static_cast<int>(format)], header);
  }

  template <class T>
  PlyBytes& Add(T value) {
    if (format_ == PlyFormat::kAscii) {
      bytes_ += fmt::format("{} ", static_cast<double>(value));
      return *this;
    }
    char own[sizeof(T)];
    std::memcpy(own, &value, sizeof(T));
    if (format_ == PlyFormat::kBigEndian) std::reverse(own, own + sizeof(T));
    bytes_.append(own, sizeof(T));
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  PlyFormat format_;
  std::string bytes_;
};

}  // namespace daumier::testing
