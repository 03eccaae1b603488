#pragma once
#include "core/error.h"
#include "core/files.h"
#include "core/half.h"
#include "core/json.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace daumier {

enum class Dtype { kU8, kI32, kI64, kF32, kF64, kI8, kI16, kF16 };

size_t ItemSize(Dtype dtype);
template <class T>
constexpr Dtype DtypeOf();
template <>
constexpr Dtype DtypeOf<uint8_t>() {
  return Dtype::kU8;
}
template <>
constexpr Dtype DtypeOf<int32_t>() {
  return Dtype::kI32;
}
template <>
constexpr Dtype DtypeOf<int64_t>() {
  return Dtype::kI64;
}
template <>
constexpr Dtype DtypeOf<float>() {
  return Dtype::kF32;
}
template <>
constexpr Dtype DtypeOf<double>() {
  return Dtype::kF64;
}
template <>
constexpr Dtype DtypeOf<int8_t>() {
  return Dtype::kI8;
}
template <>
constexpr Dtype DtypeOf<int16_t>() {
  return Dtype::kI16;
}
template <>
constexpr Dtype DtypeOf<Half>() {
  return Dtype::kF16;
}

/// An array inside a mapped file, row-major. Valid as long as its SafetensorsFile (or a copy of it) lives.
struct ArrayView {
  Dtype dtype;
  std::vector<int64_t> shape;
  const void* data;

  int64_t size() const;
  /// @throws Error if the array holds another type.
  template <class T>
  std::span<const T> As() const {
    DAUMIER_CHECK(dtype == DtypeOf<T>(), "array has another element type than requested");
    return {static_cast<const T*>(data), static_cast<size_t>(size())};
  }
};

/// Reads the safetensors format (8-byte little-endian header length, JSON header, raw arrays) by memory mapping.
/// Cheap to copy: copies share the mapping.
class SafetensorsFile {
 public:
  /// @throws Error naming file and cause: missing, truncated, malformed header, overlapping or out-of-file arrays,
  /// arrays that are not aligned to their element size, unknown dtype, unsupported `format_version` in the metadata.
  explicit SafetensorsFile(const std::filesystem::path& path);

  /// @throws Error naming the file, the array and the arrays of the file.
  const ArrayView& at(const std::string& name) const;
  bool contains(const std::string& name) const { return arrays_.count(name) == 1; }
  const std::map<std::string, ArrayView>& arrays() const { return arrays_; }
  /// The `__metadata__` map of text to text.
  const std::map<std::string, std::string>& metadata() const { return metadata_; }

 private:
  std::filesystem::path path_;
  std::shared_ptr<const MappedFile> file_;
  std::map<std::string, ArrayView> arrays_;
  std::map<std::string, std::string> metadata_;
};

/// Collects arrays and writes them atomically; equal content gives equal bytes, whatever the order of adding. The
/// arrays lie without holes, as the format demands: those of the largest element first, then by name, so that each one
/// is aligned to its element size. The first starts at a multiple of 64. The metadata get a `format_version`.
class SafetensorsWriter {
 public:
  static constexpr int kFormatVersion = 1;

  template <class T>
  void Add(const std::string& name, const std::vector<int64_t>& shape, std::span<const T> values) {
    AddBytes(name, DtypeOf<T>(), shape, values.data(), values.size_bytes());
  }
  /// @throws Error if the name is taken or reserved, or if the bytes do not fill the shape.
  void AddBytes(const std::string& name, Dtype dtype, const std::vector<int64_t>& shape, const void* data,
                size_t num_bytes);
  void SetMetadata(const std::string& key, const std::string& value) { metadata_[key] = value; }
  /// Returns the SHA-256 of what was written. @throws Error as WriteFileAtomically.
  std::string Write(const std::filesystem::path& path) const;

 private:
  struct Array {
    Dtype dtype;
    std::vector<int64_t> shape;
    std::string bytes;
  };
  std::map<std::string, Array> arrays_;
  std::map<std::string, std::string> metadata_;
};

}  // namespace daumier
