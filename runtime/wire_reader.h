#pragma once
#include <cstdint>
#include <cstring>
#include <string_view>

namespace daumier::runtime {

/// Reads the fields of one message of Protocol Buffers' wire format, whose bytes it does not copy. Groups are refused.
class WireReader {
 public:
  /// depth: of the message in others, at most kDeepest. @throws Error if it is nested deeper.
  explicit WireReader(std::string_view bytes, int depth = 0);

  /// Moves to the next field; false at the end. @throws Error if the message is cut off or malformed.
  bool Next();
  int field() const { return field_; }

  /// The field's value. @throws Error if it is of another wire type.
  uint64_t Varint() const;
  int64_t Integer() const { return static_cast<int64_t>(Varint()); }
  float Real() const;
  std::string_view Bytes() const;
  WireReader Message() const { return WireReader(Bytes(), depth_ + 1); }
  /// Calls `add` for each integer of a repeated field, which may be packed.
  template <class Add>
  void Integers(const Add& add) const {
    if (type_ == kVarint) return add(Integer());
    WireReader packed(Bytes(), depth_ + 1);
    while (packed.position_ < packed.bytes_.size()) add(static_cast<int64_t>(packed.TakeVarint()));
  }
  /// Calls `add` for each number of a repeated field of float or double, which may be packed.
  template <class Number, class Add>
  void Numbers(const Add& add) const {
    if (type_ != kLength) CheckType(sizeof(Number) == sizeof(float) ? kFixed32 : kFixed64);
    CheckWhole(value_.size(), sizeof(Number));
    for (size_t i = 0; i < value_.size(); i += sizeof(Number)) {
      Number number;
      std::memcpy(&number, value_.data() + i, sizeof(number));
      add(number);
    }
  }

 private:
  static constexpr int kVarint = 0, kFixed64 = 1, kLength = 2, kFixed32 = 5;
  static constexpr int kDeepest = 16;

  uint64_t TakeVarint();
  std::string_view Take(uint64_t count);
  void CheckType(int type) const;
  static void CheckWhole(size_t bytes, size_t item);

  std::string_view bytes_;
  size_t position_ = 0;
  int depth_, field_ = 0, type_ = 0;
  uint64_t varint_ = 0;
  std::string_view value_;
};

}  // namespace daumier::runtime
