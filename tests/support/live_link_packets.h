#pragma once
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace daumier::testing {

inline void AppendWord(std::string& bytes, uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
}
inline void AppendFloat(std::string& bytes, float number) {
  AppendWord(bytes, std::bit_cast<uint32_t>(number));
}
inline void AppendText(std::string& bytes, const std::string& text) {
  AppendWord(bytes, uint32_t(text.size()));
  bytes += text;
}

/// A packet of Live Link Face up to its subject: all that is sent while there is no face.
inline std::string LiveLinkBytesWithoutFace(const std::string& device, const std::string& subject) {
  std::string bytes = "\x06";
  AppendText(bytes, device);
  AppendText(bytes, subject);
  return bytes;
}

/// A whole packet: frame 1234 and a half, 60 a second, and 61 values.
inline std::string LiveLinkBytes(const std::vector<float>& values,
                                 const std::string& device = "01234567-89AB-CDEF-0123-456789ABCDEF",
                                 const std::string& subject = "iPhone") {
  std::string bytes = LiveLinkBytesWithoutFace(device, subject);
  AppendWord(bytes, 1234);
  AppendFloat(bytes, 0.5f);
  AppendWord(bytes, 60);
  AppendWord(bytes, 1);
  bytes += static_cast<char>(values.size());
  for (const float value : values) AppendFloat(bytes, value);
  return bytes;
}

}  // namespace daumier::testing
