#include "faces/import/mat_file.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/import/hdf5_file.h"

#include <fmt/ranges.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

namespace daumier::faces {

namespace {

constexpr size_t kMatHeaderBytes = 128, kTagBytes = 8;
constexpr uint32_t kMatrix = 14, kCompressed = 15;
constexpr uint32_t kComplexFlag = 0x800;
constexpr uint32_t kFirstNumericClass = 6, kLastNumericClass = 15;

uint32_t Word(std::string_view bytes, size_t at) {
  uint32_t word;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

struct Element {
  uint32_t type;
  std::string_view data;
};

/// Takes elements off the front of some bytes.
class ElementReader {
 public:
  ElementReader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  bool AtEnd() const { return rest_.size() < kTagBytes; }

  Element Next() {
    DAUMIER_CHECK(!AtEnd(), "{}: truncated: a data element is missing", name_);
    const uint32_t word = Word(rest_, 0), small_size = word >> 16;
    if (small_size != 0) {
      DAUMIER_CHECK(small_size <= 4, "{}: malformed: a small element of {} bytes", name_, small_size);
      const Element element{word & 0xffff, rest_.substr(4, small_size)};
      rest_.remove_prefix(kTagBytes);
      return element;
    }
    const size_t size = Word(rest_, 4);
    DAUMIER_CHECK(size <= rest_.size() - kTagBytes,
                  "{}: truncated: an element of {} bytes, {} are left. Copy or download the file again.", name_, size,
                  rest_.size() - kTagBytes);
    const Element element{word, rest_.substr(kTagBytes, size)};
    const size_t padded = word == kCompressed ? size : (size + 7) / 8 * 8;
    rest_.remove_prefix(std::min(kTagBytes + padded, rest_.size()));
    return element;
  }

 private:
  std::string_view rest_;
  const std::string& name_;
};

/// The first `size` bytes of what inflates.
std::string Inflate(std::string_view bytes, size_t size, const std::string& name) {
  std::string result(size, '\0');
  z_stream stream{};
  DAUMIER_CHECK(inflateInit(&stream) == Z_OK, "{}: zlib cannot start", name);
  // zlib's interface is older than const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(size);
  const int code = inflate(&stream, Z_SYNC_FLUSH);
  const bool is_good = (code == Z_OK || code == Z_STREAM_END || code == Z_BUF_ERROR) && stream.avail_out == 0;
  inflateEnd(&stream);
  DAUMIER_CHECK(is_good, "{}: a compressed variable is truncated or corrupt", name);
  return result;
}

std::optional<NumberArray::Type> TypeOf(uint32_t type) {
  using Type = NumberArray::Type;
  static const std::map<uint32_t, Type> types = {{1, Type::kI8},   {2, Type::kU8},  {3, Type::kI16}, {4, Type::kU16},
                                                 {5, Type::kI32},  {6, Type::kU32}, {7, Type::kF32}, {9, Type::kF64},
                                                 {12, Type::kI64}, {13, Type::kU64}};
  const auto found = types.find(type);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

/// What is found on the way through a file.
struct MatContent {
  std::set<std::string> names;  ///< Of all variables.
  NumberArrays arrays;          ///< The wanted ones.
};

/// Adds the variable, its array only if it is wanted.
void ReadMatrix(std::string_view bytes, const std::set<std::string>& wanted, const std::string& file,
                MatContent& content) {
  ElementReader reader(bytes, file);
  const Element flags = reader.Next(), sizes = reader.Next(), label = reader.Next();
  DAUMIER_CHECK(flags.data.size() == 8 && sizes.data.size() % 4 == 0, "{}: malformed variable header", file);
  const std::string variable(label.data);
  content.names.insert(variable);
  if (wanted.count(variable) == 0) return;
  const std::string name = fmt::format("{}: {}", file, variable);
  const uint32_t word = Word(flags.data, 0), kind = word & 0xff;
  DAUMIER_CHECK(kind >= kFirstNumericClass && kind <= kLastNumericClass && (word & kComplexFlag) == 0,
                "{} is no real, full matrix of numbers", name);
  std::vector<int64_t> shape;
  for (size_t at = 0; at < sizes.data.size(); at += 4) shape.push_back(static_cast<int32_t>(Word(sizes.data, at)));
  const Element values = reader.Next();
  const auto type = TypeOf(values.type);
  DAUMIER_CHECK(type.has_value(), "{}: elements of the unknown type {}", name, values.type);
  content.arrays[variable] = {*type, shape, NumberArray::Order::kColumnMajor, std::string(values.data), name};
}

/// Inflates the tag, which holds the size, and then the whole element.
void ReadCompressed(std::string_view bytes, const std::set<std::string>& wanted, const std::string& file,
                    MatContent& content) {
  const std::string tag = Inflate(bytes, kTagBytes, file);
  if (Word(tag, 0) != kMatrix) return;
  const size_t size = Word(tag, 4);
  constexpr size_t kMostInflated = 1100;  // zlib cannot do better than 1 : 1032
  DAUMIER_CHECK(size / kMostInflated <= bytes.size(), "{}: a variable of {} bytes in {} compressed ones", file, size,
                bytes.size());
  ReadMatrix(std::string_view(Inflate(bytes, kTagBytes + size, file)).substr(kTagBytes), wanted, file, content);
}

/// Names for a message: the first few, without control characters.
std::string Listed(const std::set<std::string>& names) {
  constexpr size_t kMostNames = 20, kLongest = 63;
  std::vector<std::string> shown;
  for (const std::string& name : names) {
    if (shown.size() == kMostNames) {
      shown.push_back(fmt::format("{} more", names.size() - kMostNames));
      break;
    }
    shown.push_back(name.substr(0, kLongest));
    std::replace_if(
        shown.back().begin(), shown.back().end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(shown, ", "));
}

[[noreturn]] void RefuseVersion73(const std::filesystem::path& path, const std::set<std::string>& wanted) {
  std::set<std::string> names;
  try {
    names = Hdf5Names(path);
  } catch (const Error&) {
    throw Error(fmt::format("{}: a damaged MATLAB 7.3 file. Copy or download it again.", path.string()));
  }
  throw Error(fmt::format(
      "{}: a MATLAB 7.3 file (found HDF5 with the variables {}; expected version 5 with {}). Save it again in "
      "MATLAB with -v7.",
      path.string(), Listed(names), Listed(wanted)));
}

}  // namespace

NumberArrays ReadMatFile(const std::filesystem::path& path, const std::set<std::string>& wanted) {
  const MappedFile mapped(path);
  const std::string_view bytes = mapped.bytes();
  const std::string file = path.string();
  if (bytes.starts_with("MATLAB 7.3")) RefuseVersion73(path, wanted);
  DAUMIER_CHECK(bytes.starts_with("MATLAB 5.0 MAT-file"),
                "{} is no MATLAB 5 file (-v6 or -v7; expected the variables {})", file, Listed(wanted));
  DAUMIER_CHECK(bytes.size() >= kMatHeaderBytes,
                "{}: truncated: {} bytes, a header has {}. Copy or download the file again.", file, bytes.size(),
                kMatHeaderBytes);
  DAUMIER_CHECK(bytes.substr(126, 2) == "IM", "{} was written on a big-endian machine, which is not read", file);
  MatContent content;
  ElementReader reader(bytes.substr(kMatHeaderBytes), file);
  while (!reader.AtEnd()) {
    const Element element = reader.Next();
    if (element.type == kMatrix) ReadMatrix(element.data, wanted, file, content);
    if (element.type == kCompressed) ReadCompressed(element.data, wanted, file, content);
  }
  for (const std::string& name : wanted) {
    DAUMIER_CHECK(content.arrays.count(name) == 1,
                  "{}: has no variable {} (found the variables {}; expected {}). It is another file, or cut.", file,
                  name, Listed(content.names), Listed(wanted));
  }
  return std::move(content.arrays);
}

}  // namespace daumier::faces
