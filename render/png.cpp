#include "render/png.h"

#include "core/error.h"

#include <zlib.h>

#include <array>
#include <cstdint>

namespace daumier::render {
namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1A\n", 8);
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

/// Whether the bytes of the chunks IDAT are one whole zlib stream.
class ZlibCheck {
 public:
  explicit ZlibCheck(std::string_view name) : name_(name) {
    DAUMIER_CHECK(inflateInit(&stream_) == Z_OK, "{}: no memory for reading a PNG", name_);
  }
  ~ZlibCheck() { inflateEnd(&stream_); }
  ZlibCheck(const ZlibCheck&) = delete;
  ZlibCheck& operator=(const ZlibCheck&) = delete;

  void Add(std::string_view data) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
    stream_.avail_in = static_cast<uInt>(data.size());
    while (!is_whole_ && stream_.avail_in > 0) {
      stream_.next_out = ignored_.data();
      stream_.avail_out = static_cast<uInt>(ignored_.size());
      const int state = inflate(&stream_, Z_NO_FLUSH);
      is_whole_ = state == Z_STREAM_END;
      DAUMIER_CHECK(is_whole_ || state == Z_OK, "{}: the pixels of the PNG are damaged: zlib: {}. Export it again",
                    name_, stream_.msg != nullptr ? stream_.msg : "unexpected end");
    }
  }

  bool is_whole() const { return is_whole_; }

 private:
  std::string_view name_;
  z_stream stream_{};
  std::array<Bytef, 65536> ignored_{};
  bool is_whole_ = false;
};

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

std::string PixelChunksOfPng(std::string_view bytes, std::string_view name) {
  constexpr size_t kAroundData = 12;  // Length, type, checksum.
  constexpr std::string_view kEnd("\0\0\0\0IEND\xAE\x42\x60\x82", kAroundData);
  std::string chunks(kPngSignature);
  ZlibCheck pixels(name);
  size_t offset = kPngSignature.size();
  while (bytes.size() - offset >= kAroundData) {
    const size_t length = BigEndian32(bytes, offset);
    if (length > bytes.size() - offset - kAroundData) break;
    const std::string_view chunk = bytes.substr(offset, kAroundData + length), type = chunk.substr(4, 4);
    offset += chunk.size();
    if (type == "IEND") break;
    if (type != "IHDR" && type != "PLTE" && type != "tRNS" && type != "IDAT") continue;
    const auto* const checked = reinterpret_cast<const Bytef*>(chunk.data() + 4);
    DAUMIER_CHECK(crc32(0, checked, static_cast<uInt>(4 + length)) == BigEndian32(chunk, 8 + length),
                  "{}: the PNG is damaged: the checksum of its chunk {} differs. Export it again", name, type);
    if (type == "IDAT") pixels.Add(chunk.substr(8, length));
    chunks += chunk;
  }
  DAUMIER_CHECK(pixels.is_whole(), "{}: truncated PNG: pixels are missing at its end", name);
  return chunks.append(kEnd);
}

}  // namespace daumier::render
