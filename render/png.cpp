#include "render/png.h"

#include "core/error.h"

#include <zlib.h>

#include <cstdint>

namespace daumier::render {
namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1A\n", 8);
constexpr uint32_t kMaxPngSide = 1u << 20;
constexpr uint64_t kMaxPngPixels = uint64_t{1} << 30;

uint32_t BigEndian32(std::string_view bytes, size_t offset) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

/// Grey and palettes have small depths, and palettes and those with several channels not all of the large ones.
bool BelongTogether(int bit_depth, int colour_type) {
  switch (colour_type) {
    case 0:
      return bit_depth == 1 || bit_depth == 2 || bit_depth == 4 || bit_depth == 8 || bit_depth == 16;
    case 3:
      return bit_depth == 1 || bit_depth == 2 || bit_depth == 4 || bit_depth == 8;
    case 2:
    case 4:
    case 6:
      return bit_depth == 8 || bit_depth == 16;
    default:
      return false;
  }
}

}  // namespace

bool IsPng(std::string_view bytes) {
  return bytes.starts_with(kPngSignature);
}

void CheckPngHeader(std::string_view bytes, std::string_view name) {
  // Signature, length of the data, type, 13 bytes of data, checksum of type and data.
  constexpr size_t kType = 12, kData = 16, kChecksum = 29, kEnd = 33;
  DAUMIER_CHECK(bytes.size() >= kEnd, "{}: truncated PNG: {} bytes", name, bytes.size());
  DAUMIER_CHECK(BigEndian32(bytes, 8) == kChecksum - kData && bytes.substr(kType, 4) == "IHDR",
                "{}: a PNG without a header (expected the chunk IHDR of 13 bytes first)", name);
  const auto* const checked = reinterpret_cast<const Bytef*>(bytes.data() + kType);
  DAUMIER_CHECK(crc32(0, checked, kChecksum - kType) == BigEndian32(bytes, kChecksum),
                "{}: the header of the PNG is damaged (its checksum differs)", name);
  const uint32_t width = BigEndian32(bytes, kData), height = BigEndian32(bytes, kData + 4);
  DAUMIER_CHECK(width >= 1 && height >= 1 && width <= kMaxPngSide && height <= kMaxPngSide &&
                    uint64_t{width} * height <= kMaxPngPixels,
                "{}: a PNG of {} x {} pixels (expected 1 to {} a side and at most {} in all)", name, width, height,
                kMaxPngSide, kMaxPngPixels);
  const auto field = [&](size_t i) { return int(static_cast<unsigned char>(bytes[kData + i])); };
  DAUMIER_CHECK(BelongTogether(field(8), field(9)), "{}: a PNG of bit depth {} and colour type {}, which do not exist",
                name, field(8), field(9));
  DAUMIER_CHECK(field(10) == 0 && field(11) == 0 && field(12) <= 1,
                "{}: a PNG of compression {}, filter {} and interlace {} (expected 0, 0, and 0 or 1)", name, field(10),
                field(11), field(12));
}

}  // namespace daumier::render
