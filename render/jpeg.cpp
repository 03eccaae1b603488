#include "render/jpeg.h"

#include <cstdint>

namespace daumier::render {
namespace {

constexpr uint8_t kStart = 0xD8, kEnd = 0xD9, kStartOfScan = 0xDA, kApp1 = 0xE1, kTemporary = 0x01;
constexpr std::string_view kExifName("Exif\0\0", 6);

bool IsRestart(uint8_t marker) {
  return marker >= 0xD0 && marker <= 0xD7;
}

/// The place of the next 0xFF that begins a marker within or after compressed data; the end if there is none.
size_t AfterCompressedData(std::string_view bytes, size_t at) {
  while ((at = bytes.find('\xFF', at)) != std::string_view::npos) {
    if (at + 1 == bytes.size()) break;
    const auto next = static_cast<uint8_t>(bytes[at + 1]);
    if (next == 0xFF) {
      ++at;
    } else if (next == 0x00 || IsRestart(next)) {
      at += 2;
    } else {
      return at;
    }
  }
  return bytes.size();
}

}  // namespace

bool IsJpeg(std::string_view bytes) {
  return bytes.starts_with("\xFF\xD8\xFF");
}

JpegExtent FirstJpeg(std::string_view bytes) {
  JpegExtent extent{.picture = bytes, .exif = {}};
  size_t at = 2;
  while (at + 1 < bytes.size()) {
    at = bytes.find('\xFF', at);  // As libjpeg does: bytes between segments are skipped.
    if (at == std::string_view::npos || at + 1 == bytes.size()) break;
    const auto marker = static_cast<uint8_t>(bytes[at + 1]);
    if (marker == 0xFF) {  // Padding.
      ++at;
      continue;
    }
    at += 2;
    if (marker == kEnd) {
      extent.picture = bytes.substr(0, at);
      extent.has_end = true;
      break;
    }
    if (marker == kStart || marker == kTemporary || IsRestart(marker)) continue;
    if (at + 2 > bytes.size()) break;
    const size_t length = size_t(static_cast<uint8_t>(bytes[at])) << 8 | static_cast<uint8_t>(bytes[at + 1]);
    if (length < 2 || at + length > bytes.size()) break;
    const std::string_view content = bytes.substr(at + 2, length - 2);
    if (marker == kApp1 && extent.exif.empty() && content.starts_with(kExifName))
      extent.exif = content.substr(kExifName.size());
    at += length;
    if (marker == kStartOfScan) {
      extent.has_scan = true;
      at = AfterCompressedData(bytes, at);
    }
  }
  return extent;
}

}  // namespace daumier::render
