#include "runtime/wire_reader.h"

#include "core/error.h"

#include <cstring>

namespace daumier::runtime {

WireReader::WireReader(std::string_view bytes, int depth) : bytes_(bytes), depth_(depth) {
  DAUMIER_CHECK(depth <= kDeepest, "messages are nested more than {} deep", kDeepest);
}

uint64_t WireReader::TakeVarint() {
  uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    DAUMIER_CHECK(position_ < bytes_.size(), "the file ends within a number");
    const auto byte = static_cast<uint8_t>(bytes_[position_++]);
    value |= uint64_t(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
  throw Error("a number has more than 64 bits");
}

std::string_view WireReader::Take(uint64_t count) {
  DAUMIER_CHECK(count <= bytes_.size() - position_, "the file ends within a field of {} bytes", count);
  const std::string_view taken = bytes_.substr(position_, count);
  position_ += count;
  return taken;
}

bool WireReader::Next() {
  if (position_ == bytes_.size()) return false;
  const uint64_t tag = TakeVarint();
  DAUMIER_CHECK(tag >> 3 > 0 && tag >> 3 < 1u << 29, "a field has the number {}", tag >> 3);
  field_ = int(tag >> 3);
  type_ = int(tag & 7);
  switch (type_) {
    case kVarint:
      varint_ = TakeVarint();
      return true;
    case kFixed64:
      value_ = Take(8);
      return true;
    case kLength:
      value_ = Take(TakeVarint());
      return true;
    case kFixed32:
      value_ = Take(4);
      return true;
    default:
      throw Error(fmt::format("field {} has the wire type {}", field_, type_));
  }
}

void WireReader::CheckType(int type) const {
  DAUMIER_CHECK(type_ == type, "field {} has the wire type {}, expected {}", field_, type_, type);
}

void WireReader::CheckWhole(size_t bytes, size_t item) {
  DAUMIER_CHECK(bytes % item == 0, "{} bytes hold no numbers of {} bytes", bytes, item);
}

uint64_t WireReader::Varint() const {
  CheckType(kVarint);
  return varint_;
}

float WireReader::Real() const {
  CheckType(kFixed32);
  float value;
  std::memcpy(&value, value_.data(), sizeof(value));
  return value;
}

std::string_view WireReader::Bytes() const {
  CheckType(kLength);
  return value_;
}

}  // namespace daumier::runtime
