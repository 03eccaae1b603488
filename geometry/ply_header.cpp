#include "geometry/ply_header.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace daumier::geometry {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{{"char", PlyType::kInt8},
                                                                          {"uchar", PlyType::kUint8},
                                                                          {"short", PlyType::kInt16},
                                                                          {"ushort", PlyType::kUint16},
                                                                          {"int", PlyType::kInt32},
                                                                          {"uint", PlyType::kUint32},
                                                                          {"float", PlyType::kFloat32},
                                                                          {"double", PlyType::kFloat64},
                                                                          {"int8", PlyType::kInt8},
                                                                          {"uint8", PlyType::kUint8},
                                                                          {"int16", PlyType::kInt16},
                                                                          {"uint16", PlyType::kUint16},
                                                                          {"int32", PlyType::kInt32},
                                                                          {"uint32", PlyType::kUint32},
                                                                          {"float32", PlyType::kFloat32},
                                                                          {"float64", PlyType::kFloat64}}};

constexpr std::string_view kBlanks = " \t\r";

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = line.find_first_not_of(kBlanks); at != line.npos; at = line.find_first_not_of(kBlanks, at)) {
    const size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

/// What a file shows of its text in a message: short, without control characters.
std::string Shown(std::string_view text) {
  constexpr size_t kLongest = 40;
  std::string shown(text.substr(0, kLongest));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return shown;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  PlyHeader Parse() {
    CheckMagic();
    bool has_format = false;
    for (;;) {
      const std::string_view line = NextLine();
      const auto words = Words(line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        ReadFormat(words, line);
        has_format = true;
      } else if (words[0] == "element") {
        ReadElement(words, line);
      } else if (words[0] == "property") {
        ReadProperty(words, line);
      } else {
        Refuse(line, "format, comment, obj_info, element, property or end_header");
      }
    }
    DAUMIER_CHECK(has_format, "{}: malformed PLY header (found no line 'format', expected one)", name_);
    header_.num_bytes = at_;
    return std::move(header_);
  }

 private:
  /// The first line also sets the line ending: a CR alone only if the line itself ends so. Thus the first byte of
  /// binary data is never read as half of a line end.
  void CheckMagic() {
    const size_t end = bytes_.substr(0, 3) == "ply" ? bytes_.find_first_not_of(" \t", 3) : bytes_.npos;
    const bool is_ply = end != bytes_.npos && (bytes_[end] == '\n' || bytes_[end] == '\r');
    DAUMIER_CHECK(is_ply, "{}: not a PLY file (found '{}', expected 'ply' in its first line)", name_,
                  Shown(bytes_.substr(0, bytes_.find_first_of("\r\n"))));
    if (bytes_[end] == '\r' && bytes_.substr(end, 2) != "\r\n") line_end_ = '\r';
    NextLine();
  }

  std::string_view NextLine() {
    const size_t end = bytes_.find(line_end_, at_);
    DAUMIER_CHECK(end != bytes_.npos, "{}: cut amid its header (found no end_header). Export or copy the file again.",
                  name_);
    const std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return line;
  }

  [[noreturn]] void Refuse(std::string_view line, std::string_view expected) const {
    throw Error(fmt::format("{}: malformed PLY header (found '{}', expected {})", name_, Shown(line), expected));
  }

  void ReadFormat(const std::vector<std::string_view>& words, std::string_view line) {
    constexpr std::array<std::pair<std::string_view, PlyFormat>, 3> kFormats = {
        {{"ascii", PlyFormat::kAscii},
         {"binary_little_endian", PlyFormat::kLittleEndian},
         {"binary_big_endian", PlyFormat::kBigEndian}}};
    const auto format = std::find_if(kFormats.begin(), kFormats.end(),
                                     [&](const auto& entry) { return words.size() > 1 && words[1] == entry.first; });
    if (words.size() != 3 || format == kFormats.end() || words[2] != "1.0")
      Refuse(line, "format ascii, binary_little_endian or binary_big_endian 1.0");
    header_.format = format->second;
  }

  void ReadElement(const std::vector<std::string_view>& words, std::string_view line) {
    if (words.size() != 3) Refuse(line, "element NAME COUNT");
    PlyElement element{std::string(words[1])};
    const char* const end = words[2].data() + words[2].size();
    const auto [position, error] = std::from_chars(words[2].data(), end, element.count);
    if (error != std::errc() || position != end) Refuse(line, "element NAME COUNT with a count of 0 or more");
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) Refuse(line, "every element once");
    }
    header_.elements.push_back(std::move(element));
  }

  void ReadProperty(const std::vector<std::string_view>& words, std::string_view line) {
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (header_.elements.empty() || words.size() != (is_list ? 5 : 3))
      Refuse(line, "property TYPE NAME or property list TYPE TYPE NAME behind an element");
    PlyProperty property{std::string(words.back()), ReadType(words[words.size() - 2], line)};
    if (is_list) property.count_type = ReadType(words[2], line);
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType ReadType(std::string_view word, std::string_view line) const {
    const auto type =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& entry) { return word == entry.first; });
    if (type == kTypes.end()) Refuse(line, "a type such as int or float64");
    return type->second;
  }

  std::string_view bytes_, name_;
  size_t at_ = 0;
  char line_end_ = '\n';
  PlyHeader header_;
};

}  // namespace

size_t SizeOf(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    default:
      return 8;
  }
}

std::optional<size_t> PlyElement::Find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property) return i;
  }
  return std::nullopt;
}

PlyHeader ParsePlyHeader(std::string_view bytes, std::string_view name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const size_t begin = bytes.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  PlyHeader header = HeaderParser(bytes.substr(begin), name).Parse();
  header.num_bytes += begin;
  return header;
}

}  // namespace daumier::geometry
