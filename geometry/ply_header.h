#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::geometry {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of a number in a binary file.
size_t SizeOf(PlyType type);

/// A number of each row of an element, or a list of numbers behind its count.
struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count_type{};  ///< Of a list.
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;  ///< Rows that the header claims; a damaged file can claim any number.
  std::vector<PlyProperty> properties{};

  /// Index of a property, of several with the name the first.
  std::optional<size_t> Find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;  ///< In the order of their rows.
  size_t num_bytes = 0;              ///< Before the first row.
};

/// Reads the header of a PLY file [Turk 1994]. Comments, obj_info and a byte order mark of UTF-8
/// are skipped; lines end with LF, CR LF or CR; types
/// have their old (char, float) or new names (int8, float32).
/// @throws Error "name: what is wrong (found X, expected Y)": another kind of file, no end_header, an unknown format,
/// version, keyword or type, a property before the first element, two elements of one name.
PlyHeader ParsePlyHeader(std::string_view bytes, std::string_view name);

}  // namespace daumier::geometry
