#include "core/toml_bounds.h"

#include <fmt/format.h>

#include <algorithm>

namespace daumier {
namespace {

constexpr int kMaxDots = 100, kMaxBrackets = 32;

size_t LengthOfRun(std::string_view text, size_t begin) {
  size_t end = begin;
  while (end < text.size() && text[end] == text[begin]) ++end;
  return end - begin;
}

/// The end of the quoted text at `begin`, one past its last quote. One of a single line ends at the line's end at the
/// latest.
size_t EndOfQuotes(std::string_view text, size_t begin) {
  const char quote = text[begin];
  const bool has_escapes = quote == '"';
  const size_t opening = LengthOfRun(text, begin);
  if (opening == 2) return begin + 2;
  const bool has_lines = opening >= 3;
  for (size_t i = begin + (has_lines ? 3 : 1); i < text.size(); ++i) {
    if (has_escapes && text[i] == '\\' && (has_lines || i + 1 >= text.size() || text[i + 1] != '\n')) {
      ++i;
    } else if (!has_lines && text[i] == '\n') {
      return i;
    } else if (text[i] == quote) {
      if (!has_lines) return i + 1;
      const size_t run = LengthOfRun(text, i);
      if (run >= 3) return i + std::min<size_t>(run, 5);  // Up to two belong to the text.
      i += run - 1;
    }
  }
  return text.size();
}

}  // namespace

std::string TooDeepInToml(std::string_view text) {
  int dots = 0, brackets = 0;
  for (size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = EndOfQuotes(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '.') ++dots;
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots = 0;
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (dots > kMaxDots || brackets > kMaxBrackets) {
      const auto line = std::ranges::count(text.substr(0, i), '\n') + 1;
      return dots > kMaxDots ? fmt::format("line {}: a key has more than {} dots", line, kMaxDots)
                             : fmt::format("line {}: values are nested more than {} deep", line, kMaxBrackets);
    }
    ++i;
  }
  return "";
}

}  // namespace daumier
