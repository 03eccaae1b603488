#pragma once
#include "geometry/ply_header.h"

#include <string>
#include <string_view>
#include <vector>

namespace daumier::geometry {

/// Reads the numbers behind a PLY header one after the other. Numbers of an ASCII file are separated by any white
/// space, spelled as ParseNumber; lines `comment` and `obj_info` between them are skipped. Every method throws Error "name: what is wrong (found X, expected Y)" where the bytes end early or hold no
/// such number; no count makes it allocate more than the bytes can hold.
class PlyRows {
 public:
  PlyRows(std::string_view bytes, PlyFormat format, std::string_view name)
      : bytes_(bytes), format_(format), name_(name) {}

  /// The rows of `element` come next. Checks that the bytes left can hold them. Keeps a reference.
  void Begin(const PlyElement& element);
  /// The next row, for messages.
  void NextRow() { ++row_; }

  /// The number that comes next; every integer type of the format is exact in double.
  double Read(const PlyProperty& property);
  /// The whole number in [low, high) that comes next; `what` names it in messages.
  int ReadIndex(const PlyProperty& property, int64_t low, int64_t high, const char* what);
  /// How many numbers the list that comes next has.
  size_t BeginList(const PlyProperty& property);
  void ReadList(const PlyProperty& property, std::vector<double>& values);
  void Skip(const PlyProperty& property);

  /// @throws Error "name: element row N: problem".
  [[noreturn]] void Refuse(const std::string& problem) const;

 private:
  double ReadNumber(PlyType type, const PlyProperty& property);
  std::string_view NextWord();
  double ReadText(const PlyProperty& property);

  std::string_view bytes_;  ///< What is left.
  PlyFormat format_;
  std::string_view name_;
  const PlyElement* element_ = nullptr;
  uint64_t row_ = 0;  ///< Counted from 1.
};

/// `value` as an index in [low, high). @throws Error as PlyRows::Refuse.
int ToIndex(double value, int64_t low, int64_t high, const char* what, const PlyRows& rows);

}  // namespace daumier::geometry
