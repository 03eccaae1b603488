#include "geometry/obj_lines.h"

#include "core/error.h"
#include "geometry/number_text.h"

#include <charconv>
#include <cstring>

namespace daumier::geometry {
namespace {

/// Whether a CR that no LF follows is among the bytes.
bool HasLoneReturn(std::string_view text) {
  for (size_t at = text.find('\r'); at != text.npos; at = text.find('\r', at + 1)) {
    if (text.substr(at + 1, 1) != "\n") return true;
  }
  return false;
}

}  // namespace

ObjLines::ObjLines(std::string_view text, std::string_view name)
    : name_(name),
      next_(text.data()),
      end_(text.data() + text.size()),
      line_end_(next_),
      has_lone_returns_(HasLoneReturn(text)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  DAUMIER_CHECK(!text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF"),
                "{}: not an OBJ file (found text in UTF-16, expected ASCII or UTF-8). Save it again as UTF-8.", name);
  if (text.starts_with(kByteOrderMark)) next_ += kByteOrderMark.size();
}

void ObjLines::FindLineEnd() {
  const auto left = static_cast<size_t>(end_ - next_);
  const void* end = nullptr;
  if (has_lone_returns_) {
    const size_t at = std::string_view(next_, left).find_first_of("\r\n");
    if (at != std::string_view::npos) end = next_ + at;
  } else if (left > 0) {
    end = std::memchr(next_, '\n', left);
  }
  line_end_ = end == nullptr ? end_ : static_cast<const char*>(end);
  next_ = line_end_ == end_ ? end_ : line_end_ + 1;
  if (line_end_ == end_) return;
  if (*line_end_ == '\r' && next_ != end_ && *next_ == '\n') ++next_;
  if (line_end_ > line_begin_ && line_end_[-1] == '\r') --line_end_;
}

bool ObjLines::Continues() const {
  if (line_end_ == line_begin_ || line_end_[-1] != '\\') return false;
  const std::string_view line(position_, static_cast<size_t>(line_end_ - position_));
  // Names and comments may end with a backslash (a folder of Windows).
  return (line[0] == 'v' || line[0] == 'f') && line.find('#') == line.npos;
}

bool ObjLines::Next() {
  if (next_ == end_) return false;
  number_ += num_ends_;
  num_ends_ = 1;
  is_continued_ = false;
  position_ = line_begin_ = next_;
  FindLineEnd();
  SkipBlanks();
  while (Continues()) {
    is_continued_ = true;
    if (next_ == end_) break;
    ++num_ends_;
    FindLineEnd();
  }
  return true;
}

double ObjLines::ReadNumber(const char* problem) {
  double value = 0;
  const auto [end, error] = std::from_chars(position_, line_end_, value);
  if (error == std::errc() && (end == line_end_ || IsBlank(*end))) {
    position_ = end;
    return value;
  }
  const char* const begin = position_;
  while (position_ != line_end_ && !IsBlank(*position_)) ++position_;
  std::string_view word(begin, static_cast<size_t>(position_ - begin));
  auto number = ParseNumber(word);
  if (!number) {
    word = word.substr(0, word.find('#'));  // A comment that no blank precedes.
    number = ParseNumber(word);
  }
  DAUMIER_CHECK(number.has_value(), "{}:{}: {} (found '{}', expected one such as -0.25)", name_, number_, problem,
                word.substr(0, 40));
  position_ = begin + word.size();
  return *number;
}

int ObjLines::ReadIndex(const char* problem) {
  if (position_ != line_end_ && *position_ == '+') ++position_;
  int value = 0;
  const auto [end, error] = std::from_chars(position_, line_end_, value);
  Check(error == std::errc(), problem);
  position_ = end;
  return value;
}

void ObjLines::Refuse(const char* problem) const {
  throw Error(fmt::format("{}:{}: {}", name_, number_, problem));
}

}  // namespace daumier::geometry
