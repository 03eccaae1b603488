#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::render {

/// H x W x C bytes, row-major, row 0 on top, RGB where C is 3 and grey where C is 1. Pixel (row, column) covers
/// [column, column + 1) x [row, row + 1); its centre is at (column + 0.5, row + 0.5). sRGB-encoded.
struct Image {
  int height = 0, width = 0, channels = 0;
  std::vector<uint8_t> pixels;

  Image() = default;
  /// @throws Error if a size is negative or channels is neither 1 nor 3.
  Image(int height, int width, int channels, uint8_t value = 255);
  uint8_t& at(int row, int column, int channel = 0) {
    return pixels[(size_t(row) * width + column) * channels + channel];
  }
  uint8_t at(int row, int column, int channel = 0) const {
    return pixels[(size_t(row) * width + column) * channels + channel];
  }
  bool operator==(const Image&) const = default;
};

using Rgb = std::array<uint8_t, 3>;

/// PNG, JPEG, WebP, BMP or TIFF as 8-bit grey or RGB: transparency is laid over white, or over black where all that is
/// opaque is too light for white, 16 bits are rounded to 8, and the picture is turned as its Exif data say
/// (ExifOrientation). Of a JPEG file the first picture is read, whatever follows it; one that lacks nothing but its end
/// marker is read with a warning.
/// @throws Error naming file and cause: missing, empty, not a picture, truncated.
Image ReadImage(const std::filesystem::path& path);
/// The same for a picture that is in memory; `name` is what errors call it.
Image DecodeImage(std::string_view bytes, std::string_view name);

enum class ImageFormat { kPng, kJpeg };

/// The bytes of a PNG or JPEG file; the same picture gives the same bytes. @throws Error if the picture is empty.
std::string EncodeImage(const Image& image, ImageFormat format, int jpeg_quality = 88);

/// EncodeImage as PNG or JPEG by the extension (".png", ".jpg", ".jpeg"), atomic.
/// @throws Error naming file and cause.
void WriteImage(const std::filesystem::path& path, const Image& image, int jpeg_quality = 88);

}  // namespace daumier::render
