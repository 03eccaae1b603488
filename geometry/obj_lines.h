#pragma once
#include <cstddef>
#include <cstring>
#include <string_view>

namespace daumier::geometry {

/// Walks over the lines of a Wavefront OBJ text. Lines end with LF, CR LF or CR; a line of a keyword with v or f in
/// front continues behind a backslash at its end; a byte order mark of UTF-8 is skipped. Messages of errors begin with
/// "name:line: ". Keeps references to text and name.
class ObjLines {
 public:
  /// @throws Error naming the text if it is UTF-16.
  ObjLines(std::string_view text, std::string_view name);

  /// Moves to the first character of the next line that is not blank; false after the last line.
  bool Next();
  /// Whether the line is the last of the text and lacks its line end: it may be cut.
  bool IsOpen() const { return line_end_ == end_; }

  /// Whether the line is `keyword` followed by a blank; moves behind it.
  bool Accept(std::string_view keyword) {
    const auto size = static_cast<std::ptrdiff_t>(keyword.size());
    if (line_end_ - position_ <= size || std::memcmp(position_, keyword.data(), keyword.size()) != 0 ||
        !IsBlank(position_[size]))
      return false;
    position_ += size + 1;
    return true;
  }
  /// Whether the line, or all but a comment, is read; skips blanks.
  bool AtEnd() {
    SkipBlanks();
    return position_ == line_end_ || *position_ == '#';
  }
  /// Whether a word ends here.
  bool AtWordEnd() const { return position_ == line_end_ || IsBlank(*position_) || *position_ == '#'; }
  /// Whether the next character is `c`; moves behind it.
  bool Skip(char c) {
    if (position_ == line_end_ || *position_ != c) return false;
    ++position_;
    return true;
  }

  /// The number that comes next, to the end of its word, as ParseNumber. @throws Error with `problem`.
  double ReadNumber(const char* problem);
  /// The whole number that comes next; more of its word may follow. @throws Error with `problem`.
  int ReadIndex(const char* problem);

  /// @throws Error "name:line: problem" unless the condition holds.
  void Check(bool condition, const char* problem) const {
    if (!condition) Refuse(problem);
  }

 private:
  bool IsBlank(char c) const {
    return c == ' ' || c == '\t' || (is_continued_ && (c == '\\' || c == '\r' || c == '\n'));
  }
  void SkipBlanks() {
    while (position_ != line_end_ && IsBlank(*position_)) ++position_;
  }
  [[noreturn]] void Refuse(const char* problem) const;
  /// Ends the line at the next line end.
  void FindLineEnd();
  /// Whether the line continues behind its line end.
  bool Continues() const;

  std::string_view name_;
  const char* next_;
  const char* end_;
  const char* position_ = nullptr;
  const char* line_begin_ = nullptr;
  const char* line_end_ = nullptr;
  int number_ = 0;                 ///< Of the line, counted from 1.
  int num_ends_ = 1;               ///< Line ends from this line to the next one.
  bool has_lone_returns_ = false;  ///< Some lines end with CR alone.
  bool is_continued_ = false;
};

}  // namespace daumier::geometry
