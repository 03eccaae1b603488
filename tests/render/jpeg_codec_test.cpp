#include "render/jpeg_codec.h"

#include "render/opencv_bridge.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cstdio>  // jpeglib.h needs its types.

#include <jpeglib.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdlib>

namespace daumier::render {
namespace {

/// A soft picture with some noise, so that files have data in every block.
Image SoftNoise(int height, int width, int channels) {
  Image image(height, width, channels);
  uint32_t state = 3;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    state = state * 1664525u + 1013904223u;
    image.pixels[i] = uint8_t((i / 5) % 200 + (state >> 27));
  }
  return image;
}

std::string JpegByOpenCv(const Image& image, const std::vector<int>& options) {
  cv::Mat pixels = MatView(image).clone();
  if (image.channels == 3) cv::cvtColor(pixels, pixels, cv::COLOR_RGB2BGR);
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", pixels, bytes, options);
  return {bytes.begin(), bytes.end()};
}

cv::Mat RgbByOpenCv(const std::string& jpeg) {
  const cv::Mat buffer(1, int(jpeg.size()), CV_8UC1, const_cast<char*>(jpeg.data()));
  cv::Mat pixels = cv::imdecode(buffer, cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
  if (pixels.channels() == 3) cv::cvtColor(pixels, pixels, cv::COLOR_BGR2RGB);
  return pixels;
}

TEST(EncodeJpeg, WritesWhatOpenCvWrites) {
  for (const int channels : {1, 3})
    for (const int quality : {30, 88, 100}) {
      const Image image = SoftNoise(37, 53, channels);
      EXPECT_EQ(EncodeJpeg(image, quality), JpegByOpenCv(image, {cv::IMWRITE_JPEG_QUALITY, quality})) << quality;
    }
}

TEST(EncodeJpeg, APictureThatIsTooLargeForJpegIsRefused) {
  Image image;
  image.width = 70000, image.height = 1, image.channels = 1;
  image.pixels.resize(70000);
  testing::ExpectError([&] { EncodeJpeg(image, 88); }, "libjpeg cannot encode a picture: Maximum supported image");
}

TEST(DecodeJpeg, GivesThePixelsThatOpenCvGives) {
  for (const int channels : {1, 3})
    for (const int progressive : {0, 1})
      for (const int restart : {0, 3}) {
        const std::string jpeg = JpegByOpenCv(SoftNoise(45, 61, channels), {cv::IMWRITE_JPEG_PROGRESSIVE, progressive,
                                                                            cv::IMWRITE_JPEG_RST_INTERVAL, restart});
        const DecodedJpeg decoded = DecodeJpeg(jpeg);
        const cv::Mat expected = RgbByOpenCv(jpeg);
        EXPECT_TRUE(decoded.is_whole);
        EXPECT_EQ(decoded.complaint, "");
        ASSERT_EQ(decoded.pixels.type(), expected.type());
        ASSERT_EQ(decoded.pixels.size(), expected.size());
        EXPECT_EQ(cv::norm(decoded.pixels, expected, cv::NORM_INF), 0);
      }
}

TEST(DecodeJpeg, EveryCutOfTheDataIsFound) {
  for (const int progressive : {0, 1}) {
    const std::string jpeg = JpegByOpenCv(SoftNoise(40, 40, 3), {cv::IMWRITE_JPEG_PROGRESSIVE, progressive});
    const std::string without_end = jpeg.substr(0, jpeg.size() - 2);
    EXPECT_TRUE(DecodeJpeg(without_end).is_whole);
    for (size_t cut = 3; cut < 400; cut += 13)
      EXPECT_FALSE(DecodeJpeg(without_end.substr(0, without_end.size() - cut)).is_whole) << progressive << " " << cut;
  }
}

TEST(DecodeJpeg, AProgressivePictureThatLacksWholeScansIsNotWhole) {
  const std::string jpeg = JpegByOpenCv(SoftNoise(40, 40, 3), {cv::IMWRITE_JPEG_PROGRESSIVE, 1});
  const size_t last_tables = jpeg.rfind("\xFF\xC4");
  ASSERT_NE(last_tables, std::string::npos);
  EXPECT_FALSE(DecodeJpeg(jpeg.substr(0, last_tables) + "\xFF\xD9").is_whole);
}

TEST(DecodeJpeg, WhatIsUnreadableSaysWhy) {
  const DecodedJpeg decoded = DecodeJpeg("\xFF\xD8\xFF no picture");
  EXPECT_TRUE(decoded.pixels.empty());
  EXPECT_FALSE(decoded.is_whole);
  EXPECT_NE(decoded.complaint, "");
}

/// One colour, as CMYK at the best quality; with an Adobe marker, which means that values are inverted.
std::string CmykJpeg(const std::array<uint8_t, 4>& colour, bool with_adobe_marker) {
  jpeg_compress_struct writer{};
  jpeg_error_mgr errors{};
  writer.err = jpeg_std_error(&errors);
  jpeg_create_compress(&writer);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&writer, &bytes, &size);
  writer.image_width = 8, writer.image_height = 8;
  writer.input_components = 4;
  writer.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&writer);
  jpeg_set_quality(&writer, 100, TRUE);
  writer.write_Adobe_marker = boolean(with_adobe_marker);
  jpeg_start_compress(&writer, TRUE);
  std::vector<uint8_t> row;
  for (int i = 0; i < 8; ++i) row.insert(row.end(), colour.begin(), colour.end());
  JSAMPROW pointer = row.data();
  for (int i = 0; i < 8; ++i) jpeg_write_scanlines(&writer, &pointer, 1);
  jpeg_finish_compress(&writer);
  jpeg_destroy_compress(&writer);
  std::string jpeg(reinterpret_cast<char*>(bytes), size);
  std::free(bytes);
  return jpeg;
}

TEST(DecodeJpeg, OfCmykIsWhatTheInksLetThrough) {
  // Cyan 40 %, magenta none, yellow all, black 20 %: red 0.6 x 0.8, green 1 x 0.8, blue 0.
  const std::array<int, 3> expected = {122, 204, 0};
  for (const bool inverted : {false, true}) {
    std::array<uint8_t, 4> inks = {102, 0, 255, 51};
    if (inverted)
      for (uint8_t& ink : inks) ink = uint8_t(255 - ink);
    const DecodedJpeg decoded = DecodeJpeg(CmykJpeg(inks, inverted));
    ASSERT_EQ(decoded.pixels.type(), CV_8UC3);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(decoded.pixels.at<cv::Vec3b>(3, 3)[channel], expected[size_t(channel)], 2) << inverted;
  }
}

}  // namespace
}  // namespace daumier::render
