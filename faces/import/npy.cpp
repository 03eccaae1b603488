#include "faces/import/npy.h"

#include "core/error.h"
#include "faces/archive.h"

#include <charconv>
#include <cstring>

namespace daumier::faces {

namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

NumberArray::Type TypeOf(const std::string& descr, const std::string& name) {
  using Type = NumberArray::Type;
  static const std::map<std::string, Type> types = {{"i1", Type::kI8},  {"u1", Type::kU8},  {"b1", Type::kU8},
                                                    {"i2", Type::kI16}, {"u2", Type::kU16}, {"i4", Type::kI32},
                                                    {"u4", Type::kU32}, {"i8", Type::kI64}, {"u8", Type::kU64},
                                                    {"f4", Type::kF32}, {"f8", Type::kF64}};
  DAUMIER_CHECK(descr.find('O') == std::string::npos,
                "{}: holds Python objects (dtype '{}'), which only Python can load; export it as plain arrays", name,
                descr);
  DAUMIER_CHECK(!descr.starts_with('>'), "{}: big-endian elements ('{}') are not read; save it on a usual machine",
                name, descr);
  const size_t begin = !descr.empty() && std::strchr("<|=", descr[0]) != nullptr ? 1 : 0;
  const auto found = types.find(descr.substr(begin));
  DAUMIER_CHECK(found != types.end(), "{}: elements of type '{}' are not read; it has to be whole numbers or floats",
                name, descr);
  return found->second;
}

/// The little dictionary of a header: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 2), }.
class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  void Read() {
    Expect('{');
    while (!Accept('}')) {
      const std::string key = Quoted();
      Expect(':');
      if (key == "descr") {
        descr = Quoted();
      } else if (key == "fortran_order") {
        is_fortran = Word() == "True";
      } else if (key == "shape") {
        ReadShape();
        has_shape_ = true;
      } else {
        Fail();
      }
      Accept(',');
    }
    if (descr.empty() || !has_shape_) Fail();
  }

  std::string descr;
  bool is_fortran = false;
  std::vector<int64_t> shape;

 private:
  [[noreturn]] void Fail() const { throw Error(fmt::format("{}: malformed .npy header", name_)); }
  bool Accept(char c) {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\n')) rest_.remove_prefix(1);
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void Expect(char c) {
    if (!Accept(c)) Fail();
  }
  std::string Quoted() {
    const char quote = Accept('\'') ? '\'' : '"';
    if (quote == '"') {
      // A list denotes a structured type.
      if (Accept('[')) throw Error(fmt::format("{}: a structured array; it has to be whole numbers or floats", name_));
      Expect('"');
    }
    const size_t end = rest_.find(quote);
    if (end == std::string_view::npos) Fail();
    const std::string text(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return text;
  }
  std::string Word() {
    Accept(' ');
    size_t end = 0;
    while (end < rest_.size() && std::isalpha(static_cast<unsigned char>(rest_[end]))) ++end;
    const std::string word(rest_.substr(0, end));
    if (word != "True" && word != "False") Fail();
    rest_.remove_prefix(end);
    return word;
  }
  void ReadShape() {
    Expect('(');
    while (!Accept(')')) {
      Accept(' ');
      int64_t size = 0;
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), size);
      if (error != std::errc()) Fail();
      rest_.remove_prefix(end - rest_.data());
      shape.push_back(size);
      Accept(',');
    }
  }

  std::string_view rest_;
  const std::string& name_;
  bool has_shape_ = false;
};

}  // namespace

NumberArray ParseNpy(std::string_view bytes, const std::string& name) {
  DAUMIER_CHECK(bytes.size() >= 10 && bytes.starts_with(kMagic), "{}: not a .npy array", name);
  const int version = static_cast<unsigned char>(bytes[6]);
  DAUMIER_CHECK(version >= 1 && version <= 3, "{}: .npy version {} is not known; versions 1 to 3 are read", name,
                version);
  const size_t length_bytes = version == 1 ? 2 : 4, begin = kMagic.size() + 2 + length_bytes;
  DAUMIER_CHECK(bytes.size() >= begin, "{}: truncated amid its header", name);
  uint32_t length = 0;
  std::memcpy(&length, bytes.data() + kMagic.size() + 2, length_bytes);
  DAUMIER_CHECK(length <= bytes.size() - begin, "{}: a header of {} bytes in a file of {}", name, length, bytes.size());
  HeaderReader header(bytes.substr(begin, length), name);
  header.Read();
  const NumberArray::Type type = TypeOf(header.descr, name);
  return {type, header.shape, header.is_fortran ? NumberArray::Order::kColumnMajor : NumberArray::Order::kRowMajor,
          std::string(bytes.substr(begin + length)), name};
}

NumberArrays ReadNpz(const std::filesystem::path& path, const std::set<std::string>& wanted) {
  const auto array_name = [](const std::string& file) { return std::filesystem::path(file).stem().string(); };
  NumberArrays arrays;
  ForEachFile(
      path, [&](const std::string& file) { return file.ends_with(".npy") && wanted.count(array_name(file)) == 1; },
      [&](const std::string& file, std::string_view bytes) {
        const std::string array = array_name(file);
        arrays[array] = ParseNpy(bytes, fmt::format("{}: {}", path.string(), array));
      });
  return arrays;
}

}  // namespace daumier::faces
