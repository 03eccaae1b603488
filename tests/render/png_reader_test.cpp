#include "render/png_reader.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <png.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace daumier::render {
namespace {

struct PngKind {
  int colour_type, depth;
  bool is_interlaced = false, has_transparency = false;
};

/// 13 x 11 pixels of arbitrary bytes, written by libpng itself. Of a transparent kind, palette entry 0 or the value 1 is.
std::string WrittenByLibpng(const PngKind& kind) {
  constexpr int kWidth = 13, kHeight = 11;
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, png_size_t count) {
        static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<char*>(data), count);
      },
      nullptr);
  png_set_IHDR(png, info, kWidth, kHeight, kind.depth, kind.colour_type,
               kind.is_interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette(size_t(1) << std::min(kind.depth, 8));
  for (size_t i = 0; i < palette.size(); ++i)
    palette[i] = {png_byte(37 * i + 5), png_byte(91 * i + 7), png_byte(151 * i + 2)};
  if (kind.colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), int(palette.size()));
  png_byte opacity = 0;
  png_color_16 transparent{.index = 0, .red = 1, .green = 1, .blue = 1, .gray = 1};
  if (kind.has_transparency) png_set_tRNS(png, info, &opacity, 1, &transparent);
  png_write_info(png, info);
  std::vector<std::vector<png_byte>> rows(kHeight, std::vector<png_byte>(png_get_rowbytes(png, info)));
  std::vector<png_bytep> pointers;
  uint32_t state = 9;
  for (std::vector<png_byte>& row : rows) {
    for (png_byte& byte : row) byte = png_byte((state = state * 1664525u + 1013904223u) >> 24);
    if (kind.has_transparency)
      std::fill_n(row.begin(), 6, png_byte(kind.colour_type == PNG_COLOR_TYPE_PALETTE ? 0 : 1));
    pointers.push_back(row.data());
  }
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

cv::Mat ByOpenCv(const std::string& bytes) {
  const cv::Mat buffer(1, int(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  cv::Mat pixels = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  if (pixels.channels() == 3) cv::cvtColor(pixels, pixels, cv::COLOR_BGR2RGB);
  if (pixels.channels() == 4) cv::cvtColor(pixels, pixels, cv::COLOR_BGRA2RGBA);
  return pixels;
}

TEST(DecodePng, GivesThePixelsThatOpenCvGives) {
  for (const bool is_interlaced : {false, true}) {
    for (const auto& [type, depth] : std::vector<std::pair<int, int>>{{PNG_COLOR_TYPE_GRAY, 1},
                                                                      {PNG_COLOR_TYPE_GRAY, 2},
                                                                      {PNG_COLOR_TYPE_GRAY, 4},
                                                                      {PNG_COLOR_TYPE_GRAY, 8},
                                                                      {PNG_COLOR_TYPE_GRAY, 16},
                                                                      {PNG_COLOR_TYPE_RGB, 8},
                                                                      {PNG_COLOR_TYPE_RGB, 16},
                                                                      {PNG_COLOR_TYPE_RGBA, 8},
                                                                      {PNG_COLOR_TYPE_RGBA, 16},
                                                                      {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
                                                                      {PNG_COLOR_TYPE_PALETTE, 1},
                                                                      {PNG_COLOR_TYPE_PALETTE, 4},
                                                                      {PNG_COLOR_TYPE_PALETTE, 8}}) {
      const std::string bytes = WrittenByLibpng({type, depth, is_interlaced});
      const cv::Mat ours = DecodePng(bytes, "a.png"), theirs = ByOpenCv(bytes);
      ASSERT_EQ(ours.size(), theirs.size());
      ASSERT_EQ(ours.type(), theirs.type()) << type << " " << depth;
      EXPECT_EQ(cv::norm(ours, theirs, cv::NORM_INF), 0) << type << " " << depth << " " << is_interlaced;
    }
  }
}

TEST(DecodePng, AValueOrAPaletteEntryMayBeTransparent) {
  for (const int type : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_PALETTE}) {
    const cv::Mat pixels = DecodePng(WrittenByLibpng({type, 8, false, true}), "a.png");
    ASSERT_EQ(pixels.type(), CV_8UC4) << type;
    const int first_opaque = type == PNG_COLOR_TYPE_RGB ? 2 : 6;  // Six bytes of each row are transparent.
    EXPECT_EQ(pixels.at<cv::Vec4b>(3, first_opaque - 1)[3], 0) << type;
    EXPECT_EQ(pixels.at<cv::Vec4b>(3, first_opaque + 1)[3], 255) << type;
  }
}

TEST(DecodePng, WhatLibpngRefusesIsNamedWithItsReason) {
  std::string bytes = WrittenByLibpng({PNG_COLOR_TYPE_PALETTE, 8});
  const size_t palette = bytes.find("PLTE");
  const size_t length = 4 + 4 + 3 * 256 + 4;
  bytes.erase(palette - 4, length);
  testing::ExpectError([&] { DecodePng(bytes, "a.png"); }, "a.png: a PNG that libpng cannot read: IDAT: Missing PLTE");
}

}  // namespace
}  // namespace daumier::render
