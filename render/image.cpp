#include "render/image.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/exif.h"
#include "render/jpeg.h"
#include "render/jpeg_codec.h"
#include "render/opencv_bridge.h"
#include "render/opencv_codecs.h"
#include "render/png.h"
#include "render/png_reader.h"
#include "render/png_writer.h"

#include <array>
#include <limits>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

namespace daumier::render {
namespace {

/// Brightness of the darkest share of what is opaque, in [0, 255], above which it cannot be seen on white.
constexpr double kDarkestOpaque = 0.02;
constexpr int kInvisibleOnWhite = 170;

/// The brightness that a share of the opaque pixels, counted by their opacity, stay below; 0 if all is transparent.
int OpaqueQuantile(const cv::Mat& rgba, double share) {
  std::array<int64_t, 256> opacity_at{};
  int64_t total = 0;
  for (int row = 0; row < rgba.rows; ++row) {
    for (int column = 0; column < rgba.cols; ++column) {
      const auto& pixel = rgba.at<cv::Vec4b>(row, column);
      const int brightness = (299 * pixel[0] + 587 * pixel[1] + 114 * pixel[2] + 500) / 1000;
      opacity_at[brightness] += pixel[3];
      total += pixel[3];
    }
  }
  int brightness = 0;
  for (int64_t below = opacity_at[0]; brightness < 255 && static_cast<double>(below) < share * total;) {
    below += opacity_at[++brightness];
  }
  return brightness;
}

/// 8-bit RGB over white; over black what could not be seen there: light lines without a ground.
cv::Mat LayOverPaper(const cv::Mat& rgba) {
  const int paper = OpaqueQuantile(rgba, kDarkestOpaque) > kInvisibleOnWhite ? 0 : 255;
  cv::Mat rgb(rgba.size(), CV_8UC3);
  for (int row = 0; row < rgba.rows; ++row) {
    for (int column = 0; column < rgba.cols; ++column) {
      const auto& from = rgba.at<cv::Vec4b>(row, column);
      auto& to = rgb.at<cv::Vec3b>(row, column);
      const int alpha = from[3];
      for (int channel = 0; channel < 3; ++channel) {
        to[channel] = static_cast<uint8_t>((from[channel] * alpha + paper * (255 - alpha) + 127) / 255);
      }
    }
  }
  return rgb;
}

/// The first picture of the file, grey or RGB. @throws Error if it is cut.
cv::Mat PixelsOfJpeg(std::string_view bytes, std::string_view name) {
  const JpegExtent extent = FirstJpeg(bytes);
  DAUMIER_CHECK(extent.has_scan, "{}: truncated JPEG", name);
  DecodedJpeg decoded = DecodeJpeg(extent.picture);
  DAUMIER_CHECK(decoded.is_whole || extent.has_end, "{}: truncated JPEG: rows are missing at its end", name);
  DAUMIER_CHECK(!decoded.pixels.empty(), "{}: not a readable JPEG: {}. Export it again", name, decoded.complaint);
  if (!decoded.is_whole) log::Warn("{}: parts of the JPEG are damaged or missing: {}", name, decoded.complaint);
  if (!extent.has_end) log::Warn("{}: the JPEG lacks its end marker; all of its pixels are there", name);
  return decoded.pixels;
}

/// Grey, RGB or RGBA of a file of another format; empty if it cannot be read.
cv::Mat PixelsByOpenCv(std::string_view bytes) {
  if (bytes.size() > size_t(std::numeric_limits<int>::max())) return {};
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  try {
    cv::Mat pixels = OpenCvDecode(buffer, cv::IMREAD_UNCHANGED);
    if (pixels.channels() == 3) cv::cvtColor(pixels, pixels, cv::COLOR_BGR2RGB);
    if (pixels.channels() == 4) cv::cvtColor(pixels, pixels, cv::COLOR_BGRA2RGBA);
    return pixels;
  } catch (const cv::Exception&) {
    return {};
  }
}

/// The picture as its Exif orientation, from 1 to 8, says that it is shown.
cv::Mat Turned(const cv::Mat& stored, int orientation) {
  cv::Mat turned = stored;
  if (orientation >= 5) cv::transpose(stored, turned);
  // What is left of each: 2 and 6 mirror left and right, 4 and 8 top and bottom, 3 and 7 both.
  const bool left_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool top_bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  cv::Mat result = turned;
  if (left_right) cv::flip(turned, result, 1), turned = result.clone();
  if (top_bottom) cv::flip(turned, result, 0);
  return result;
}

/// OpenCV's own text of a lack of memory speaks of its source files.
int ThrowLackOfMemory(int code, const char*, const char*, const char*, int, void*) {
  if (code == cv::Error::StsNoMem) throw std::bad_alloc();
  return 0;
}

}  // namespace

Image::Image(int height, int width, int channels, uint8_t value) : height(height), width(width), channels(channels) {
  DAUMIER_CHECK(height >= 0 && width >= 0 && (channels == 1 || channels == 3),
                "an image of {} x {} x {}, expected H x W x 1 or H x W x 3", height, width, channels);
  pixels.assign(size_t(height) * width * channels, value);
}

Image DecodeImage(std::string_view bytes, std::string_view name) {
  static const cv::ErrorCallback before = cv::redirectError(ThrowLackOfMemory);
  static_cast<void>(before);
  DAUMIER_CHECK(!bytes.empty(), "{}: the file is empty", name);
  cv::Mat decoded = IsJpeg(bytes)  ? PixelsOfJpeg(bytes, name)
                    : IsPng(bytes) ? DecodePng(bytes, name)
                                   : PixelsByOpenCv(bytes);
  DAUMIER_CHECK(!decoded.empty(), "{}: not a readable picture, or truncated (expected PNG, JPEG, WebP, BMP or TIFF)",
                name);
  decoded = Turned(decoded, ExifOrientation(bytes));
  if (decoded.depth() == CV_16U) decoded.convertTo(decoded, CV_8U, 1.0 / 257.0);
  DAUMIER_CHECK(decoded.depth() == CV_8U, "{}: neither 8 nor 16 bits a channel", name);

  const cv::Mat result = decoded.channels() == 4 ? LayOverPaper(decoded) : decoded;
  Image image(result.rows, result.cols, result.channels());
  result.copyTo(MatView(image));
  return image;
}

Image ReadImage(const std::filesystem::path& path) {
  return DecodeImage(ReadFile(path), path.string());
}

std::string EncodeImage(const Image& image, ImageFormat format, int jpeg_quality) {
  DAUMIER_CHECK(!image.pixels.empty(), "the picture to encode is empty");
  return format == ImageFormat::kPng ? EncodePng(image) : EncodeJpeg(image, jpeg_quality);
}

void WriteImage(const std::filesystem::path& path, const Image& image, int jpeg_quality) {
  const std::string extension = path.extension().string();
  DAUMIER_CHECK(extension == ".png" || extension == ".jpg" || extension == ".jpeg",
                "{}: pictures are written as .png, .jpg or .jpeg", path.string());
  DAUMIER_CHECK(!image.pixels.empty(), "{}: the picture to write is empty", path.string());
  WriteFileAtomically(path,
                      EncodeImage(image, extension == ".png" ? ImageFormat::kPng : ImageFormat::kJpeg, jpeg_quality));
}

}  // namespace daumier::render
