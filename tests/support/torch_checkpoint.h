#pragma once
#include "core/array.h"
#include "tests/support/corruption.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Writes files as torch.save does, byte by byte: an uncompressed zip archive with a pickle of protocol 2 and a file of
/// each storage.
namespace daumier::testing {

template <class T>
void AppendNumber(std::string& bytes, T number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(T));
}

/// The CRC-32 of zip, bit by bit.
inline uint32_t ZipChecksum(std::string_view bytes) {
  uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<uint8_t>(byte);
    for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

enum class ZipSizes { k32, k64 };

/// An archive of stored files. k64: sizes lie in extra fields of 64 bits, as those of files beyond 4 GB do.
inline std::string ZipOf(const std::vector<std::pair<std::string, std::string>>& files,
                         ZipSizes sizes = ZipSizes::k32) {
  std::string bytes, directory;
  const bool is64 = sizes == ZipSizes::k64;
  for (const auto& [name, content] : files) {
    const uint32_t offset = uint32_t(bytes.size()), size = uint32_t(content.size());
    std::string extra;
    if (is64) {
      AppendNumber<uint16_t>(extra, 1);
      AppendNumber<uint16_t>(extra, 16);
      AppendNumber<uint64_t>(extra, size);
      AppendNumber<uint64_t>(extra, size);
    }
    std::string common;  // From "version needed" to "length of the extra field".
    for (const uint16_t number : {uint16_t(is64 ? 45 : 20), uint16_t(0), uint16_t(0), uint16_t(0), uint16_t(0x21)})
      AppendNumber<uint16_t>(common, number);
    AppendNumber<uint32_t>(common, ZipChecksum(content));
    for (int i = 0; i < 2; ++i) AppendNumber<uint32_t>(common, is64 ? ~0u : size);
    AppendNumber<uint16_t>(common, uint16_t(name.size()));
    AppendNumber<uint16_t>(common, uint16_t(extra.size()));
    bytes += "PK\x03\x04" + common + name + extra + content;
    directory += std::string("PK\x01\x02", 4);
    AppendNumber<uint16_t>(directory, 45);
    directory += common + std::string(10, '\0');  // Comment, disk, attributes.
    AppendNumber<uint32_t>(directory, offset);
    directory += name + extra;
  }
  const uint32_t begin = uint32_t(bytes.size());
  bytes += directory + std::string("PK\x05\x06\0\0\0\0", 8);
  for (int i = 0; i < 2; ++i) AppendNumber<uint16_t>(bytes, uint16_t(files.size()));
  AppendNumber<uint32_t>(bytes, uint32_t(directory.size()));
  AppendNumber<uint32_t>(bytes, begin);
  return bytes + std::string(2, '\0');
}

/// Operations of a pickle of protocol 2.
struct PickleText {
  static std::string Text(const std::string& text) {
    std::string bytes = "X";
    AppendNumber<uint32_t>(bytes, uint32_t(text.size()));
    return bytes + text;
  }
  static std::string Integer(int64_t number) {
    std::string bytes = "J";
    AppendNumber<int32_t>(bytes, int32_t(number));
    return bytes;
  }
  static std::string Name(const std::string& module, const std::string& name) {
    return "c" + module + "\n" + name + "\n";
  }
  static std::string Tuple(const std::string& items) { return "(" + items + "t"; }
  static std::string Empty() { return Name("collections", "OrderedDict") + ")R"; }
  /// A tensor of `shape` in a storage of elements of a type.
  static std::string Tensor(const std::string& type, const std::string& storage, int64_t storage_size, int64_t offset,
                            const std::vector<int64_t>& shape, const std::vector<int64_t>& strides) {
    const auto integers = [](const std::vector<int64_t>& numbers) {
      std::string items;
      for (const int64_t number : numbers) items += Integer(number);
      return Tuple(items);
    };
    return Name("torch._utils", "_rebuild_tensor_v2") +
           Tuple(Tuple(Text("storage") + Name("torch", type) + Text(storage) + Text("cuda:0") + Integer(storage_size)) +
                 "Q" + Integer(offset) + integers(shape) + integers(strides) + "\x89" + Empty()) +
           "R";
  }
  static std::string File(const std::string& value) { return "\x80\x02" + value + "."; }
};

inline std::vector<int64_t> StridesOf(const std::vector<int64_t>& shape) {
  std::vector<int64_t> strides(shape.size(), 1);
  for (size_t k = shape.size(); k-- > 1;) strides[k - 1] = strides[k] * shape[k];
  return strides;
}

/// Writes {"epoch": 3, "model": state}, each tensor in a storage of its own.
inline void WriteTorchState(const std::filesystem::path& path, const NamedArrays& state,
                            ZipSizes sizes = ZipSizes::k32) {
  const std::string folder = path.stem().string() + "/";
  std::vector<std::pair<std::string, std::string>> files(1);
  std::string items;
  for (const auto& [name, array] : state) {
    const std::string key = std::to_string(files.size() - 1);
    const auto size = std::ssize(array.values);
    items +=
        PickleText::Text(name) + PickleText::Tensor("FloatStorage", key, size, 0, array.shape, StridesOf(array.shape));
    files.emplace_back(folder + "data/" + key,
                       std::string(reinterpret_cast<const char*>(array.values.data()), size_t(size) * sizeof(float)));
  }
  files[0] = {folder + "data.pkl",
              PickleText::File("}(" + PickleText::Text("epoch") + PickleText::Integer(3) + PickleText::Text("model") +
                               PickleText::Empty() + "(" + items + "uu")};
  files.emplace_back(folder + "version", "3\n");
  WriteQuickly(path, ZipOf(files, sizes));
}

}  // namespace daumier::testing
