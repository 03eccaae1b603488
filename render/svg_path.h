#pragma once
#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::render {

struct SvgPolyline {
  std::vector<Eigen::Vector2d> points;
};

/// Reads a list of numbers as SVG writes them: separated by white space, one comma, or nothing where a sign or a second
/// decimal point begins the next ("1-2.5.3" is 1, -2.5, 0.3).
class SvgNumbers {
 public:
  explicit SvgNumbers(std::string_view text) : text_(text) {}

  /// Skips white space, and with it one comma after a number.
  void SkipSeparators();
  bool AtEnd() const { return position_ == text_.size(); }
  char Peek() const { return text_[position_]; }
  char Take() { return text_[position_++]; }
  size_t position() const { return position_; }

  /// Whether the next character can begin a number.
  bool AtNumber() const;
  /// @throws Error with the position if there is no number, or none that a double can hold.
  double Number();
  /// '0' or '1', which need no separator after them. @throws Error with the position.
  bool Flag();

 private:
  [[noreturn]] void Fail(std::string_view expected) const;

  std::string_view text_;
  size_t position_ = 0;
  bool after_number_ = false;  ///< And no comma since.
};

/// Path data as polylines, one a subpath.
struct SvgPath {
  std::vector<SvgPolyline> polylines;
  std::optional<std::string> error;  ///< Position and cause, where the data end before their end.
};

/// The polylines of path data [SVG 1.1, 8.3]: M L H V C S Q T A Z, absolute and relative. Curves are replaced by chords
/// that leave them by `tolerance` at most. A closed subpath ends where it begins. A subpath of one point alone paints
/// nothing and is left out, unless it is closed or has a segment: points that all coincide are one point. Data that do
/// not follow the grammar or hold a number that is not finite are read up to the segment of their first error
/// [SVG 2, 9.5.4].
/// @throws Error if the tolerance is not positive.
SvgPath ParseSvgPath(std::string_view data, double tolerance);

}  // namespace daumier::render
