#include "render/exif.h"

#include "render/jpeg.h"

#include <cstddef>
#include <cstdint>

namespace daumier::render {
namespace {

enum class ByteOrder { kLittle, kBig };

/// An unsigned number of `size` bytes; 0 beyond the end.
uint32_t NumberAt(std::string_view bytes, size_t at, size_t size, ByteOrder order) {
  if (at > bytes.size() || size > bytes.size() - at) return 0;
  uint32_t value = 0;
  for (size_t i = 0; i < size; ++i)
    value = value << 8 | static_cast<uint8_t>(bytes[at + (order == ByteOrder::kBig ? i : size - 1 - i)]);
  return value;
}

/// Of a TIFF header and the directory that it points to.
int TiffOrientation(std::string_view tiff) {
  constexpr uint32_t kTag = 0x0112, kShort = 3, kLong = 4;
  if (!tiff.starts_with("II") && !tiff.starts_with("MM")) return 1;
  const ByteOrder order = tiff[0] == 'I' ? ByteOrder::kLittle : ByteOrder::kBig;
  const size_t directory = NumberAt(tiff, 4, 4, order), count = NumberAt(tiff, directory, 2, order);
  for (size_t i = 0; i < count; ++i) {
    const size_t entry = directory + 2 + 12 * i;
    if (entry + 12 > tiff.size()) break;
    if (NumberAt(tiff, entry, 2, order) != kTag) continue;
    const uint32_t type = NumberAt(tiff, entry + 2, 2, order);
    const uint32_t value = type == kShort  ? NumberAt(tiff, entry + 8, 2, order)
                           : type == kLong ? NumberAt(tiff, entry + 8, 4, order)
                                           : 1;
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

std::string_view PngExif(std::string_view bytes) {
  for (size_t at = 8; at + 12 <= bytes.size();) {
    const size_t length = NumberAt(bytes, at, 4, ByteOrder::kBig);
    if (length > bytes.size() - at - 12) break;
    if (bytes.substr(at + 4, 4) == "eXIf") return bytes.substr(at + 8, length);
    at += 12 + length;
  }
  return {};
}

std::string_view WebpExif(std::string_view bytes) {
  for (size_t at = 12; at + 8 <= bytes.size();) {
    const size_t length = NumberAt(bytes, at + 4, 4, ByteOrder::kLittle);
    if (length > bytes.size() - at - 8) break;
    if (bytes.substr(at, 4) == "EXIF") {
      std::string_view exif = bytes.substr(at + 8, length);
      if (constexpr std::string_view kName("Exif\0\0", 6); exif.starts_with(kName)) exif.remove_prefix(kName.size());
      return exif;
    }
    at += 8 + length + length % 2;
  }
  return {};
}

}  // namespace

int ExifOrientation(std::string_view bytes) {
  if (IsJpeg(bytes)) return TiffOrientation(FirstJpeg(bytes).exif);
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return TiffOrientation(PngExif(bytes));
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return TiffOrientation(WebpExif(bytes));
  return 1;
}

}  // namespace daumier::render
