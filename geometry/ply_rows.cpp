#include "geometry/ply_rows.h"

#include "core/error.h"
#include "geometry/number_text.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace daumier::geometry {
namespace {

constexpr std::string_view kWhiteSpace = " \t\r\n\v\f";

template <class T>
double Load(const char* bytes, bool swap) {
  char own[sizeof(T)];
  std::memcpy(own, bytes, sizeof(T));
  if (swap) std::reverse(own, own + sizeof(T));
  T value;
  std::memcpy(&value, own, sizeof(T));
  return static_cast<double>(value);
}

double LoadNumber(const char* bytes, PlyType type, bool swap) {
  switch (type) {
    case PlyType::kInt8:
      return Load<int8_t>(bytes, swap);
    case PlyType::kUint8:
      return Load<uint8_t>(bytes, swap);
    case PlyType::kInt16:
      return Load<int16_t>(bytes, swap);
    case PlyType::kUint16:
      return Load<uint16_t>(bytes, swap);
    case PlyType::kInt32:
      return Load<int32_t>(bytes, swap);
    case PlyType::kUint32:
      return Load<uint32_t>(bytes, swap);
    case PlyType::kFloat32:
      return Load<float>(bytes, swap);
    default:
      return Load<double>(bytes, swap);
  }
}

/// The least number of bytes of a number; in ASCII a digit and a separator.
size_t LeastSize(PlyFormat format, PlyType type) {
  return format == PlyFormat::kAscii ? 2 : SizeOf(type);
}

}  // namespace

void PlyRows::Begin(const PlyElement& element) {
  element_ = &element;
  row_ = 0;
  size_t row_size = 0;
  for (const PlyProperty& property : element.properties)
    row_size += LeastSize(format_, property.count_type.value_or(property.type));
  if (row_size == 0) return;
  // The last number of an ASCII file needs no separator.
  const uint64_t most = (bytes_.size() + (format_ == PlyFormat::kAscii ? 1 : 0)) / row_size;
  DAUMIER_CHECK(
      element.count <= most,
      "{}: truncated PLY file (found {} bytes for element {}, expected {} rows of at least {} bytes). Export or "
      "copy the file again.",
      name_, bytes_.size(), element.name, element.count, row_size);
}

void PlyRows::Refuse(const std::string& problem) const {
  throw Error(fmt::format("{}: row {} of element {}: {}", name_, row_, element_->name, problem));
}

std::string_view PlyRows::NextWord() {
  const size_t begin = std::min(bytes_.find_first_not_of(kWhiteSpace), bytes_.size());
  const size_t end = std::min(bytes_.find_first_of(kWhiteSpace, begin), bytes_.size());
  const std::string_view word = bytes_.substr(begin, end - begin);
  bytes_.remove_prefix(end);
  return word;
}

double PlyRows::ReadText(const PlyProperty& property) {
  std::string_view word = NextWord();
  while (word == "comment" || word == "obj_info") {
    bytes_.remove_prefix(std::min(bytes_.find_first_of("\r\n"), bytes_.size()));
    word = NextWord();
  }
  if (word.empty()) {
    Refuse(fmt::format("truncated PLY file (found its end, expected {} of {} rows). Export or copy the file again.",
                       property.name, element_->count));
  }
  const auto value = ParseNumber(word);
  if (!value) Refuse(fmt::format("{} is malformed (found '{}', expected a number)", property.name, word.substr(0, 40)));
  return *value;
}

double PlyRows::ReadNumber(PlyType type, const PlyProperty& property) {
  if (format_ == PlyFormat::kAscii) return ReadText(property);
  const size_t size = SizeOf(type);
  if (bytes_.size() < size) {
    Refuse(fmt::format("truncated PLY file (found {} bytes, expected {} for {}). Export or copy the file again.",
                       bytes_.size(), size, property.name));
  }
  const bool is_native = (format_ == PlyFormat::kLittleEndian) == (std::endian::native == std::endian::little);
  const double value = LoadNumber(bytes_.data(), type, !is_native);
  bytes_.remove_prefix(size);
  return value;
}

double PlyRows::Read(const PlyProperty& property) {
  return ReadNumber(property.type, property);
}

int PlyRows::ReadIndex(const PlyProperty& property, int64_t low, int64_t high, const char* what) {
  return ToIndex(Read(property), low, high, what, *this);
}

size_t PlyRows::BeginList(const PlyProperty& property) {
  const double count = ReadNumber(*property.count_type, property);
  const size_t most = (bytes_.size() + (format_ == PlyFormat::kAscii ? 1 : 0)) / LeastSize(format_, property.type);
  if (!(count >= 0 && count <= static_cast<double>(most) && count == std::floor(count))) {
    Refuse(fmt::format(
        "{} is damaged (found a list of {} numbers, expected 0 to the {} that the rest of the file can hold)",
        property.name, count, most));
  }
  return static_cast<size_t>(count);
}

void PlyRows::ReadList(const PlyProperty& property, std::vector<double>& values) {
  values.resize(BeginList(property));
  for (double& value : values) value = ReadNumber(property.type, property);
}

void PlyRows::Skip(const PlyProperty& property) {
  const size_t count = property.count_type ? BeginList(property) : 1;
  for (size_t i = 0; i < count; ++i) ReadNumber(property.type, property);
}

int ToIndex(double value, int64_t low, int64_t high, const char* what, const PlyRows& rows) {
  if (!(value >= static_cast<double>(low) && value < static_cast<double>(high) && value == std::floor(value))) {
    rows.Refuse(fmt::format("{} is out of range (found {}, expected a whole number from {} to {})", what, value, low,
                            high - 1));
  }
  return static_cast<int>(value);
}

}  // namespace daumier::geometry
