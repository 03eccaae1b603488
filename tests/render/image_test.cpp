#include "render/image.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/opencv_bridge.h"
#include "tests/render/oriented_pictures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>
#include <new>
#include <string>

namespace daumier::render {
namespace {

using testing::Encoded;

/// Smooth, with three different channels: red grows to the right, green downwards.
Image Gradient(int height, int width, int channels) {
  Image image(height, width, channels);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (int channel = 0; channel < channels; ++channel) {
        image.at(row, column, channel) = static_cast<uint8_t>(channel == 0 ? 4 * column : channel == 1 ? 5 * row : 77);
      }
    }
  }
  return image;
}

TEST(ImageFile, PngRoundTripIsExact) {
  const testing::TempDir folder;
  for (const int channels : {1, 3}) {
    const Image image = Gradient(23, 31, channels);
    WriteImage(folder / "image.png", image);
    EXPECT_EQ(ReadImage(folder / "image.png"), image) << channels;
  }
}

TEST(ImageFile, JpegKeepsChannelsInOrder) {
  const testing::TempDir folder;
  const Image image = Gradient(40, 60, 3);
  for (const char* name : {"image.jpg", "image.jpeg"}) {
    WriteImage(folder / name, image, 95);
    const Image read = ReadImage(folder / name);
    ASSERT_EQ(read.channels, 3);
    EXPECT_NEAR(read.at(20, 50, 0), 200, 8);
    EXPECT_NEAR(read.at(20, 50, 1), 100, 8);
    EXPECT_NEAR(read.at(20, 50, 2), 77, 8);
  }
}

TEST(ImageFile, PngIsRgbOnDisk) {
  const testing::TempDir folder;
  Image red(1, 1, 3, 0);
  red.at(0, 0, 0) = 255;
  WriteImage(folder / "red.png", red);
  const cv::Mat bgr = cv::imread((folder / "red.png").string());
  EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 255));
}

TEST(ImageFile, SamePictureGivesSameBytesAndLeavesNoTemporaryFile) {
  const testing::TempDir folder;
  const Image image = Gradient(20, 20, 3);
  WriteImage(folder / "a.png", image);
  WriteImage(folder / "b.png", image);
  EXPECT_EQ(ReadFile(folder / "a.png"), ReadFile(folder / "b.png"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(ImageFile, WriteRefusesUnknownExtensionEmptyPictureAndMissingFolder) {
  const testing::TempDir folder;
  EXPECT_THROW(WriteImage(folder / "image.bmp", Gradient(4, 4, 1)), Error);
  EXPECT_THROW(WriteImage(folder / "image.png", Image()), Error);
  EXPECT_THROW(WriteImage(folder / "missing" / "image.png", Gradient(4, 4, 1)), Error);
}

TEST(EncodeImage, GivesTheBytesOfTheFiles) {
  const testing::TempDir folder;
  const Image image = Gradient(6, 5, 3);
  WriteImage(folder / "a.png", image);
  WriteImage(folder / "a.jpg", image, 93);
  EXPECT_EQ(EncodeImage(image, ImageFormat::kPng), ReadFile(folder / "a.png"));
  EXPECT_EQ(EncodeImage(image, ImageFormat::kJpeg, 93), ReadFile(folder / "a.jpg"));
  EXPECT_THROW(EncodeImage(Image(), ImageFormat::kPng), Error);
}

TEST(ImageFile, ErrorsNameTheFile) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "noise.png", "this is no picture");
  for (const char* name : {"noise.png", "missing.png"}) {
    testing::ExpectError([&] { ReadImage(folder / name); }, name);
  }
}

TEST(DecodeImage, RefusesTruncatedPictures) {
  const cv::Mat noise = [] {
    cv::Mat matrix(64, 64, CV_8UC3);
    cv::RNG rng(7);
    rng.fill(matrix, cv::RNG::UNIFORM, 0, 256);
    return matrix;
  }();
  for (const std::string extension : {".png", ".jpg"}) {
    const std::string bytes = Encoded(extension, noise);
    EXPECT_NO_THROW(DecodeImage(bytes, "whole")) << extension;
    for (const size_t size : {size_t{0}, size_t{1}, size_t{10}, bytes.size() / 2, bytes.size() - 20}) {
      EXPECT_THROW(DecodeImage(bytes.substr(0, size), "part"), Error) << extension << " " << size;
    }
  }
}

TEST(DecodeImage, LaysLightLinesOnNothingOverBlack) {
  // Opaque at one row; half opaque at another.
  cv::Mat bgra(6, 8, CV_8UC4, cv::Scalar(0, 0, 0, 0));
  bgra.row(2).setTo(cv::Scalar(240, 250, 255, 255));
  bgra.row(4).setTo(cv::Scalar(255, 255, 255, 128));
  const Image light = DecodeImage(Encoded(".png", bgra), "light");
  EXPECT_EQ(light.at(0, 0), 0);
  EXPECT_EQ(light.at(2, 3), 255);
  EXPECT_EQ(light.at(4, 3), 128);
  // A dark line on an opaque light shape is seen on white.
  bgra.row(3).setTo(cv::Scalar(0, 0, 0, 255));
  EXPECT_EQ(DecodeImage(Encoded(".png", bgra), "sticker").at(0, 0), 255);
  bgra.setTo(cv::Scalar(255, 255, 255, 0));
  EXPECT_EQ(DecodeImage(Encoded(".png", bgra), "nothing").at(0, 0), 255);
}

TEST(DecodeImage, LaysTransparencyOverWhite) {
  cv::Mat bgra(1, 3, CV_8UC4);
  bgra.at<cv::Vec4b>(0, 0) = {10, 20, 30, 255};
  bgra.at<cv::Vec4b>(0, 1) = {0, 0, 0, 0};
  bgra.at<cv::Vec4b>(0, 2) = {0, 0, 255, 51};  // One fifth red over white.
  const Image image = DecodeImage(Encoded(".png", bgra), "alpha");
  ASSERT_EQ(image.channels, 3);
  const std::vector<uint8_t> expected = {30, 20, 10, 255, 255, 255, 255, 204, 204};
  EXPECT_EQ(image.pixels, expected);
}

TEST(DecodeImage, RoundsSixteenBitsToEight) {
  const cv::Mat grey = (cv::Mat_<uint16_t>(1, 3) << 0, 257 * 100 + 20, 65535);
  const Image image = DecodeImage(Encoded(".png", grey), "deep");
  EXPECT_EQ(image.channels, 1);
  EXPECT_EQ(image.pixels, (std::vector<uint8_t>{0, 100, 255}));
}

TEST(DecodeImage, TurnsEveryFormatAsItsOrientationSays) {
  const cv::Mat stored = testing::SixBlocks();
  const std::string jpeg = Encoded(".jpg", stored), png = Encoded(".png", stored);
  const std::string webp = Encoded(".webp", stored, {cv::IMWRITE_WEBP_QUALITY, 101});
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const std::string exif = testing::ExifData(orientation, orientation % 2 == 0);
    for (const auto& [name, bytes] : {std::pair{"JPEG", testing::JpegWithExif(jpeg, exif)},
                                      {"PNG", testing::PngWithExif(png, exif)},
                                      {"WebP", testing::WebpWithExif(webp, exif, stored.cols, stored.rows)},
                                      {"TIFF", testing::TiffOf(stored, orientation)}}) {
      const Image image = DecodeImage(bytes, name);
      ASSERT_EQ(image.height, orientation < 5 ? 32 : 48) << name << " " << orientation;
      ASSERT_EQ(image.width, orientation < 5 ? 48 : 32) << name << " " << orientation;
      for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 3; ++column) {
          const auto [y, x] = testing::ShownBlock(orientation, row, column);
          EXPECT_NEAR(image.at(16 * y + 8, 16 * x + 8), 40 * (3 * row + column), 3) << name << " " << orientation;
        }
      }
    }
  }
}

TEST(DecodeImage, ReadsTheFirstPictureOfAJpegWithMoreBehind) {
  const std::string jpeg = Encoded(".jpg", testing::SixBlocks()), other = Encoded(".jpg", cv::Mat(8, 8, CV_8UC1));
  const Image alone = DecodeImage(jpeg, "alone");
  EXPECT_EQ(DecodeImage(jpeg + "ftypmp42 \xFF\xDA movie", "with a movie"), alone);
  EXPECT_EQ(DecodeImage(jpeg + other, "with a second picture"), alone);
}

TEST(DecodeImage, ReadsAJpegThatLacksItsEndMarkerAloneWithAWarning) {
  testing::AllowWarnings();
  for (const int progressive : {0, 1}) {
    const std::string jpeg = Encoded(".jpg", testing::SixBlocks(), {cv::IMWRITE_JPEG_PROGRESSIVE, progressive});
    const int before = log::NumWarnings();
    EXPECT_EQ(DecodeImage(jpeg.substr(0, jpeg.size() - 2), "without end"), DecodeImage(jpeg, "whole"));
    EXPECT_EQ(log::NumWarnings(), before + 1);
    testing::ExpectError([&] { DecodeImage(jpeg.substr(0, jpeg.size() - 6), "cut.jpg"); }, "cut.jpg: truncated JPEG");
  }
}

TEST(DecodeImage, OfACutJpegPrintsNothing) {
  const std::string jpeg = Encoded(".jpg", testing::SixBlocks());
  ::testing::internal::CaptureStderr();
  testing::ExpectError([&] { DecodeImage(jpeg.substr(0, jpeg.size() - 6), "cut.jpg"); }, "cut.jpg: truncated JPEG");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(DecodeImage, ALackOfMemoryInOpenCvIsTheStandardException) {
  DecodeImage(EncodeImage(Image(2, 2, 3, 7), ImageFormat::kPng), "a.png");
  EXPECT_THROW(CV_Error(cv::Error::StsNoMem, "none is left"), std::bad_alloc);
  EXPECT_THROW(CV_Error(cv::Error::StsBadArg, "a wrong word"), cv::Exception);
}

TEST(DecodeImage, OfAnEmptyFileSaysThatItIsEmpty) {
  testing::ExpectError([] { DecodeImage("", "nothing.png"); }, "nothing.png: the file is empty");
}

TEST(Image, RefusesImpossibleSizes) {
  EXPECT_THROW(Image(2, 2, 2), Error);
  EXPECT_THROW(Image(-1, 2, 3), Error);
  EXPECT_EQ(Image(2, 3, 1, 9).pixels, std::vector<uint8_t>(6, 9));
}

}  // namespace
}  // namespace daumier::render
