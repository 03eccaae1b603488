#include "core/json.h"

#include "core/error.h"
#include "core/files.h"

#include <algorithm>

namespace daumier {
namespace {

constexpr int kMaxDepth = 200;  ///< The library copies and writes values recursively.
constexpr size_t kMaxMessage = 300;

/// Calls visit(position) for the bytes outside of quoted text, until it returns true. Returns that position, or npos.
template <class Visit>
size_t FindOutsideQuotes(std::string_view text, Visit visit) {
  bool is_quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (is_quoted && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      is_quoted = !is_quoted;
    } else if (!is_quoted && visit(i)) {
      return i;
    }
  }
  return std::string_view::npos;
}

/// Where values are nested too deep, or npos.
size_t FindTooDeep(std::string_view text) {
  int depth = 0;
  return FindOutsideQuotes(text, [&](size_t i) {
    if (text[i] == ']' || text[i] == '}') --depth;
    return (text[i] == '[' || text[i] == '{') && ++depth > kMaxDepth;
  });
}

/// "line 2, column 8: ", both from 1; of a text of one line without the line.
std::string Place(std::string_view text, size_t position) {
  const std::string_view before = text.substr(0, position);
  const size_t line_begin = before.rfind('\n') + 1;  // 0 in the first line.
  const std::string column = fmt::format("column {}: ", position - line_begin + 1);
  if (text.find('\n') == std::string_view::npos) return column;
  return fmt::format("line {}, {}", std::ranges::count(before, '\n') + 1, column);
}

/// The number that is out of range, which the library names without its place: "... parsing '1e400'".
size_t FindNamedNumber(std::string_view text, std::string_view message) {
  const size_t begin = message.find('\'');
  const size_t end = message.rfind('\'');
  if (begin == std::string_view::npos || end <= begin + 1) return std::string_view::npos;
  const std::string_view number = message.substr(begin + 1, end - begin - 1);
  return FindOutsideQuotes(text, [&](size_t i) { return text.substr(i).starts_with(number); });
}

/// Bytes that are no UTF-8 never reach it: the library writes those of a text as codes.
std::string Shortened(std::string message) {
  if (message.size() <= kMaxMessage) return message;
  size_t end = kMaxMessage;
  while (end > 0 && (static_cast<unsigned char>(message[end]) & 0xC0) == 0x80) --end;
  return message.substr(0, end) + " ...";
}

[[noreturn]] void ThrowNotJson(const std::string& name, const std::string& what) {
  throw Error(fmt::format("{}: not JSON: {}", name, Shortened(what)));
}

}  // namespace

Json ParseJson(std::string_view text, const std::string& name) {
  if (const size_t position = FindTooDeep(text); position != std::string_view::npos)
    ThrowNotJson(name, fmt::format("{}values are nested more than {} deep", Place(text, position), kMaxDepth));
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    // "parse error at line 1, column 2: what"
    const std::string message = TextOf(error);
    const size_t colon = message.find(": ");
    const size_t position = std::min(text.size(), error.byte > 0 ? error.byte - 1 : 0);
    ThrowNotJson(name, Place(text, position) + (colon == std::string::npos ? message : message.substr(colon + 2)));
  } catch (const Json::exception& error) {
    const std::string message = TextOf(error);
    const size_t position = FindNamedNumber(text, message);
    ThrowNotJson(name, position == std::string_view::npos ? message : Place(text, position) + message);
  }
}

Json ReadJson(const std::filesystem::path& file) {
  return ParseJson(ReadFile(file), file.string());
}

std::optional<Json> TryParseJson(std::string_view text) {
  if (FindTooDeep(text) != std::string_view::npos) return std::nullopt;
  Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  return json.is_discarded() ? std::nullopt : std::optional<Json>(std::move(json));
}

std::string TextOf(const Json::exception& error) {
  const std::string_view text = error.what();
  const size_t end = text.find("] ");
  return std::string(text.starts_with("[json.exception.") && end != std::string_view::npos ? text.substr(end + 2)
                                                                                           : text);
}

}  // namespace daumier
