#pragma once
#include <algorithm>
#include <string>
#include <string_view>

/// For the SVG reader's files only: text as CSS and XML compare it.
namespace daumier::render {

inline constexpr std::string_view kSvgSpace = " \t\r\n\f";

/// Without the white space at both ends.
inline std::string_view Trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(kSvgSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSvgSpace) - begin + 1);
}

/// ASCII capitals replaced by small letters.
inline std::string Lowered(std::string_view text) {
  std::string lowered(text);
  for (char& c : lowered)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lowered;
}

/// Calls `visit` with each word between white space.
template <class Visit>
void ForEachWord(std::string_view text, Visit&& visit) {
  while (!(text = Trimmed(text)).empty()) {
    const std::string_view word = text.substr(0, text.find_first_of(kSvgSpace));
    visit(word);
    text.remove_prefix(word.size());
  }
}

}  // namespace daumier::render
