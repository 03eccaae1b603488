#include "core/safetensors.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace daumier {
namespace {

static_assert(std::endian::native == std::endian::little,
              "safetensors are little-endian and are mapped without conversion");

constexpr size_t kLengthBytes = 8;
constexpr uint64_t kMaxHeaderBytes = 100'000'000;  // The limit of the reference implementation.
constexpr size_t kDataAlignment = 64;
const char* const kMetadataKey = "__metadata__";
const char* const kVersionKey = "format_version";

struct DtypeName {
  Dtype dtype;
  const char* name;
  size_t item_size;
};
constexpr DtypeName kDtypeNames[] = {{Dtype::kU8, "U8", 1},   {Dtype::kI32, "I32", 4}, {Dtype::kI64, "I64", 8},
                                     {Dtype::kF32, "F32", 4}, {Dtype::kF64, "F64", 8}, {Dtype::kI8, "I8", 1},
                                     {Dtype::kI16, "I16", 2}, {Dtype::kF16, "F16", 2}};

const DtypeName& Find(Dtype dtype) {
  return *std::find_if(std::begin(kDtypeNames), std::end(kDtypeNames), [&](const auto& e) { return e.dtype == dtype; });
}

Dtype ParseDtype(const std::string& name) {
  for (const DtypeName& entry : kDtypeNames) {
    if (name == entry.name) return entry.dtype;
  }
  throw Error(fmt::format("unknown dtype '{}'", name));
}

/// Product of the sizes times the bytes of an item. @throws Error on negative sizes and on overflow.
uint64_t NumBytes(const std::vector<int64_t>& shape, Dtype dtype) {
  uint64_t num_bytes = ItemSize(dtype);
  for (const int64_t size : shape) {
    DAUMIER_CHECK(size >= 0 && !__builtin_mul_overflow(num_bytes, static_cast<uint64_t>(size), &num_bytes),
                  "impossible shape [{}]", fmt::join(shape, ", "));
  }
  return num_bytes;
}

uint64_t NonNegative(const Json& json) {
  DAUMIER_CHECK(json.is_number_unsigned(), "{} is no size", json.dump());
  return json.get<uint64_t>();
}

std::vector<int64_t> ParseShape(const Json& json) {
  DAUMIER_CHECK(json.is_array(), "shape is no list");
  std::vector<int64_t> shape;
  for (const Json& size : json) {
    const uint64_t value = NonNegative(size);
    DAUMIER_CHECK(value <= static_cast<uint64_t>(std::numeric_limits<int64_t>::max()), "impossible size {}", value);
    shape.push_back(static_cast<int64_t>(value));
  }
  return shape;
}

/// Where an array lies: bytes [begin, end) of the data section.
struct Extent {
  uint64_t begin, end;
  std::string name;
};

struct ParsedArray {
  ArrayView view;
  Extent extent;
};

/// `data_start` is the position of the data section in the file.
ParsedArray ParseArray(const std::string& name, const Json& entry, std::string_view data, size_t data_start) {
  DAUMIER_CHECK(entry.is_object() && entry.size() == 3 && entry.contains("dtype") && entry["dtype"].is_string() &&
                    entry.contains("shape") && entry.contains("data_offsets") && entry["data_offsets"].is_array() &&
                    entry["data_offsets"].size() == 2,
                "malformed entry");
  ArrayView view{ParseDtype(entry["dtype"].get<std::string>()), ParseShape(entry["shape"]), nullptr};
  const Extent extent{NonNegative(entry["data_offsets"][0]), NonNegative(entry["data_offsets"][1]), name};
  DAUMIER_CHECK(extent.begin <= extent.end && extent.end <= data.size(),
                "bytes {} to {} lie outside of the file's {} bytes of data; it is truncated or corrupt", extent.begin,
                extent.end, data.size());
  const uint64_t num_bytes = NumBytes(view.shape, view.dtype);
  DAUMIER_CHECK(extent.end - extent.begin == num_bytes, "has {} bytes, but its shape needs {}",
                extent.end - extent.begin, num_bytes);
  DAUMIER_CHECK((data_start + extent.begin) % ItemSize(view.dtype) == 0, "not aligned to its element size");
  view.data = data.data() + extent.begin;
  return {std::move(view), extent};
}

/// The format has neither overlaps nor holes nor a tail.
void CheckExtents(std::vector<Extent> extents, size_t data_size) {
  std::sort(extents.begin(), extents.end(),
            [](const Extent& a, const Extent& b) { return std::tie(a.begin, a.end) < std::tie(b.begin, b.end); });
  uint64_t position = 0;
  for (const Extent& extent : extents) {
    DAUMIER_CHECK(extent.begin >= position, "array '{}' overlaps another", extent.name);
    DAUMIER_CHECK(extent.begin == position, "{} unused bytes before array '{}'", extent.begin - position, extent.name);
    position = extent.end;
  }
  DAUMIER_CHECK(position == data_size, "{} bytes after the last array", data_size - position);
}

void CheckVersion(const std::map<std::string, std::string>& metadata) {
  const auto found = metadata.find(kVersionKey);
  if (found == metadata.end()) return;  // Written by another program.
  DAUMIER_CHECK(found->second == std::to_string(SafetensorsWriter::kFormatVersion),
                "format_version is '{}', this program reads {}; a newer one may have written it", found->second,
                SafetensorsWriter::kFormatVersion);
}

}  // namespace

size_t ItemSize(Dtype dtype) {
  return Find(dtype).item_size;
}

int64_t ArrayView::size() const {
  int64_t count = 1;
  for (const int64_t size : shape) count *= size;
  return count;
}

SafetensorsFile::SafetensorsFile(const std::filesystem::path& path)
    : path_(path), file_(std::make_shared<const MappedFile>(path)) {
  const std::string_view bytes = file_->bytes();
  try {
    DAUMIER_CHECK(bytes.size() >= kLengthBytes, "truncated: {} bytes", bytes.size());
    uint64_t header_size = 0;
    std::memcpy(&header_size, bytes.data(), kLengthBytes);
    DAUMIER_CHECK(header_size <= kMaxHeaderBytes && header_size <= bytes.size() - kLengthBytes,
                  "header of {} bytes in a file of {}; it is truncated, corrupt or of another format", header_size,
                  bytes.size());
    const size_t data_start = kLengthBytes + header_size;
    const std::string_view data = bytes.substr(data_start);
    const Json header = TryParseJson(bytes.substr(kLengthBytes, header_size)).value_or(Json());
    DAUMIER_CHECK(header.is_object(), "malformed header");

    std::vector<Extent> extents;
    for (const auto& [name, entry] : header.items()) {
      if (name == kMetadataKey) {
        DAUMIER_CHECK(entry.is_object(), "malformed metadata");
        for (const auto& [key, value] : entry.items()) {
          DAUMIER_CHECK(value.is_string(), "metadata '{}' is no text", key);
          metadata_[key] = value.get<std::string>();
        }
        CheckVersion(metadata_);
        continue;
      }
      try {
        ParsedArray parsed = ParseArray(name, entry, data, data_start);
        extents.push_back(parsed.extent);
        const bool is_new = arrays_.emplace(name, std::move(parsed.view)).second;
        DAUMIER_CHECK(is_new, "occurs twice");
      } catch (const Error& error) {
        throw Error(fmt::format("array '{}': {}", name, error.what()));
      }
    }
    CheckExtents(std::move(extents), data.size());
  } catch (const Error& error) {
    throw Error(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

const ArrayView& SafetensorsFile::at(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found != arrays_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : arrays_) names.push_back(entry.first);
  throw Error(fmt::format("{} has no array '{}'; it has: {}", path_.string(), name, fmt::join(names, ", ")));
}

void SafetensorsWriter::AddBytes(const std::string& name, Dtype dtype, const std::vector<int64_t>& shape,
                                 const void* data, size_t num_bytes) {
  DAUMIER_CHECK(name != kMetadataKey, "the array name '{}' is reserved", name);
  DAUMIER_CHECK(arrays_.count(name) == 0, "array '{}' is added twice", name);
  const uint64_t needed = NumBytes(shape, dtype);
  DAUMIER_CHECK(num_bytes == needed, "array '{}' of shape [{}] needs {} bytes, got {}", name, fmt::join(shape, ", "),
                needed, num_bytes);
  arrays_[name] = {dtype, shape, std::string(static_cast<const char*>(data), num_bytes)};
}

std::string SafetensorsWriter::Write(const std::filesystem::path& path) const {
  using Entry = decltype(arrays_)::value_type;
  std::vector<const Entry*> entries;
  for (const Entry& entry : arrays_) entries.push_back(&entry);
  std::stable_sort(entries.begin(), entries.end(), [](const Entry* a, const Entry* b) {
    return ItemSize(a->second.dtype) > ItemSize(b->second.dtype);
  });

  Json header = Json::object();
  header[kMetadataKey][kVersionKey] = std::to_string(kFormatVersion);
  for (const auto& [key, value] : metadata_) header[kMetadataKey][key] = value;
  size_t offset = 0;
  for (const Entry* entry : entries) {
    const auto& [name, array] = *entry;
    header[name] = {{"dtype", Find(array.dtype).name},
                    {"shape", array.shape},
                    {"data_offsets", {offset, offset + array.bytes.size()}}};
    offset += array.bytes.size();
  }
  std::string text = header.dump();
  text.append((kDataAlignment - (kLengthBytes + text.size()) % kDataAlignment) % kDataAlignment, ' ');

  std::string bytes(kLengthBytes, '\0');
  const uint64_t header_size = text.size();
  std::memcpy(bytes.data(), &header_size, kLengthBytes);
  bytes.reserve(kLengthBytes + text.size() + offset);
  bytes += text;
  for (const Entry* entry : entries) bytes += entry->second.bytes;
  WriteFileAtomically(path, bytes);
  return Sha256(bytes);
}

}  // namespace daumier
