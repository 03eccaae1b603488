#include "core/npy.h"

#include "core/error.h"
#include "core/files.h"

#include <cstring>
#include <regex>

namespace daumier {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";
constexpr size_t kNpyPrefix = 10;  ///< Magic, version, length of the header.
constexpr size_t kNpyAlignment = 64;

/// The headers that NumPy and EncodeNpy write.
const std::regex kNpyHeader(
    R"(\{'descr': '(<f[48])', 'fortran_order': (True|False), 'shape': \((\d{1,12}), (\d{1,12})\), \}\s*)");

}  // namespace

std::string EncodeNpy(const NpyTable& table) {
  DAUMIER_CHECK(
      table.rows >= 0 && table.columns >= 0 && table.rows * table.columns == static_cast<int64_t>(table.numbers.size()),
      "a table of {} x {} has {} numbers", table.rows, table.columns, table.numbers.size());
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", table.rows, table.columns);
  header.resize((kNpyPrefix + header.size() + kNpyAlignment) / kNpyAlignment * kNpyAlignment - kNpyPrefix, ' ');
  header.back() = '\n';
  std::string bytes(kNpyMagic);
  bytes += {1, 0, static_cast<char>(header.size() & 0xff), static_cast<char>(header.size() >> 8)};
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(table.numbers.data()), table.numbers.size() * sizeof(float));
  return bytes;
}

NpyTable DecodeNpy(std::string_view bytes, const std::string& name) {
  DAUMIER_CHECK(bytes.size() >= kNpyPrefix && bytes.starts_with(kNpyMagic), "{}: no .npy file", name);
  DAUMIER_CHECK(bytes[6] == 1, "{}: .npy version {} (expected 1)", name, int(bytes[6]));
  const size_t length = static_cast<uint8_t>(bytes[8]) | size_t{static_cast<uint8_t>(bytes[9])} << 8;
  DAUMIER_CHECK(bytes.size() >= kNpyPrefix + length, "{}: truncated in its header", name);
  const std::string header(bytes.substr(kNpyPrefix, length));
  std::smatch parts;
  DAUMIER_CHECK(std::regex_match(header, parts, kNpyHeader),
                "{}: it has the header {} (expected two axes of '<f4' or '<f8'). Write it by "
                "numpy.save(FILE, array.astype('<f4'))",
                name, header.substr(0, header.find_last_not_of(" \n") + 1));
  DAUMIER_CHECK(parts[2] == "False", "{}: it is in Fortran order. Write it by numpy.ascontiguousarray", name);
  NpyTable table{std::stoll(parts[3]), std::stoll(parts[4]), {}};
  const size_t size = parts[1] == "<f4" ? 4 : 8;
  const std::string_view data = bytes.substr(kNpyPrefix + length);
  const double expected = double(table.rows) * double(table.columns) * double(size);
  DAUMIER_CHECK(double(data.size()) == expected, "{}: {} bytes of numbers (expected {} x {} x {})", name, data.size(),
                table.rows, table.columns, size);
  table.numbers.resize(data.size() / size);
  if (size == 4) {
    std::memcpy(table.numbers.data(), data.data(), data.size());
  } else {
    for (size_t i = 0; i < table.numbers.size(); ++i) {
      double number = 0;
      std::memcpy(&number, data.data() + i * size, size);
      table.numbers[i] = static_cast<float>(number);
    }
  }
  return table;
}

void WriteNpy(const std::filesystem::path& file, const NpyTable& table) {
  WriteFileAtomically(file, EncodeNpy(table));
}

NpyTable ReadNpy(const std::filesystem::path& file) {
  return DecodeNpy(ReadFile(file), file.string());
}

}  // namespace daumier
