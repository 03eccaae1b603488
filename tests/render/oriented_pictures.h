#pragma once
#include "render/image.h"

#include <zlib.h>
#include <array>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

/// Pictures with an Exif orientation, made by hand.
namespace daumier::testing {

inline std::string Encoded(const std::string& extension, const cv::Mat& matrix, const std::vector<int>& options = {}) {
  std::vector<uint8_t> bytes;
  cv::imencode(extension, matrix, bytes, options);
  return {bytes.begin(), bytes.end()};
}

/// 32 rows, 48 columns, in blocks of 16 of one grey each: 0, 40, ..., 200 row by row.
inline cv::Mat SixBlocks() {
  cv::Mat grey(32, 48, CV_8UC1);
  for (int row = 0; row < grey.rows; ++row)
    for (int column = 0; column < grey.cols; ++column)
      grey.at<uint8_t>(row, column) = uint8_t(40 * (3 * (row / 16) + column / 16));
  return grey;
}

/// Where a stored block is shown [Exif 2.32, tag 274]: which side row 0 is, and which side column 0.
inline std::array<int, 2> ShownBlock(int orientation, int row, int column) {
  const int last_row = 1 - row, last_column = 2 - column;
  switch (orientation) {
    case 2:
      return {row, last_column};  // Row 0 on top, column 0 on the right.
    case 3:
      return {last_row, last_column};  // Bottom, right.
    case 4:
      return {last_row, column};  // Bottom, left.
    case 5:
      return {column, row};  // Left, top.
    case 6:
      return {column, last_row};  // Right, top.
    case 7:
      return {last_column, last_row};  // Right, bottom.
    case 8:
      return {last_column, row};  // Left, bottom.
    default:
      return {row, column};
  }
}

inline std::string LittleEndian(uint32_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += char(value >> (8 * i) & 0xFF);
  return bytes;
}
inline std::string BigEndian(uint32_t value, int size) {
  const std::string bytes = LittleEndian(value, size);
  return {bytes.rbegin(), bytes.rend()};
}

/// A TIFF header and a directory with the orientation alone.
inline std::string ExifData(int orientation, bool big_endian = false) {
  const auto number = [big_endian](uint32_t value, int size) {
    return big_endian ? BigEndian(value, size) : LittleEndian(value, size);
  };
  return (big_endian ? "MM" : "II") + number(42, 2) + number(8, 4) + number(1, 2) + number(0x0112, 2) + number(3, 2) +
         number(1, 4) + number(uint32_t(orientation), 2) + number(0, 2) + number(0, 4);
}

inline std::string JpegWithExif(std::string jpeg, const std::string& exif) {
  const std::string content = std::string("Exif\0\0", 6) + exif;
  return jpeg.insert(2, "\xFF\xE1" + BigEndian(uint32_t(content.size() + 2), 2) + content);
}

inline std::string PngWithExif(std::string png, const std::string& exif) {
  const std::string content = "eXIf" + exif;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(content.data()), uInt(content.size()));
  constexpr size_t kAfterHeader = 8 + 25;
  return png.insert(kAfterHeader, BigEndian(uint32_t(exif.size()), 4) + content + BigEndian(uint32_t(crc), 4));
}

/// A WebP of one chunk as an extended one.
inline std::string WebpWithExif(const std::string& webp, const std::string& exif, int width, int height) {
  const std::string features =
      LittleEndian(8, 4) + LittleEndian(uint32_t(width - 1), 3) + LittleEndian(uint32_t(height - 1), 3);
  const std::string body = "WEBPVP8X" + LittleEndian(10, 4) + features + webp.substr(12) + "EXIF" +
                           LittleEndian(uint32_t(exif.size()), 4) + exif + std::string(exif.size() % 2, '\0');
  return "RIFF" + LittleEndian(uint32_t(body.size()), 4) + body;
}

/// A grey TIFF without compression.
inline std::string TiffOf(const cv::Mat& grey, int orientation) {
  struct Entry {
    uint32_t tag, type, value;
  };
  constexpr uint32_t kShort = 3, kLong = 4;
  const auto width = uint32_t(grey.cols), height = uint32_t(grey.rows);
  const std::vector<Entry> entries = {{256, kShort, width},
                                      {257, kShort, height},
                                      {258, kShort, 8},
                                      {259, kShort, 1},
                                      {262, kShort, 1},
                                      {273, kLong, 8},
                                      {274, kShort, uint32_t(orientation)},
                                      {277, kShort, 1},
                                      {278, kShort, height},
                                      {279, kLong, width * height}};
  std::string bytes = "II" + LittleEndian(42, 2) + LittleEndian(8 + width * height, 4);
  bytes.append(reinterpret_cast<const char*>(grey.data), size_t(width) * height);
  bytes += LittleEndian(uint32_t(entries.size()), 2);
  for (const auto& [tag, type, value] : entries)
    bytes += LittleEndian(tag, 2) + LittleEndian(type, 2) + LittleEndian(1, 4) + LittleEndian(value, 4);
  return bytes + LittleEndian(0, 4);
}

}  // namespace daumier::testing
