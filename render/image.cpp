#include "render/image.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/exif.h"
#include "render/jpeg.h"
#include "render/opencv_bridge.h"
#include "render/opencv_codecs.h"
#include "render/png.h"
#include "render/png_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <limits>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

namespace daumier::render {
namespace {

/// Brightness of the darkest share of what is opaque, in [0, 255], above which it cannot be seen on white.
constexpr double kDarkestOpaque = 0.02;
constexpr int kInvisibleOnWhite = 170;

/// The brightness that a share of the opaque pixels, counted by their opacity, stay below; 0 if all is transparent.
int OpaqueQuantile(const cv::Mat& bgra, double share) {
  std::array<int64_t, 256> opacity_at{};
  int64_t total = 0;
  for (int row = 0; row < bgra.rows; ++row) {
    for (int column = 0; column < bgra.cols; ++column) {
      const auto& pixel = bgra.at<cv::Vec4b>(row, column);
      const int brightness = (114 * pixel[0] + 587 * pixel[1] + 299 * pixel[2] + 500) / 1000;
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
cv::Mat LayOverPaper(const cv::Mat& bgra) {
  const int paper = OpaqueQuantile(bgra, kDarkestOpaque) > kInvisibleOnWhite ? 0 : 255;
  cv::Mat rgb(bgra.size(), CV_8UC3);
  for (int row = 0; row < bgra.rows; ++row) {
    for (int column = 0; column < bgra.cols; ++column) {
      const auto& from = bgra.at<cv::Vec4b>(row, column);
      auto& to = rgb.at<cv::Vec3b>(row, column);
      const int alpha = from[3];
      for (int channel = 0; channel < 3; ++channel) {
        to[channel] = static_cast<uint8_t>((from[2 - channel] * alpha + paper * (255 - alpha) + 127) / 255);
      }
    }
  }
  return rgb;
}

/// Rows and columns as they are stored: our own code turns pictures, of every format alike.
cv::Mat DecodeWithOpenCv(std::string_view bytes) {
  if (bytes.empty() || bytes.size() > size_t(std::numeric_limits<int>::max())) return {};
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  try {
    return OpenCvDecode(
        buffer, IsJpeg(bytes) ? cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION : int(cv::IMREAD_UNCHANGED));
  } catch (const cv::Exception&) {
    return {};
  }
}

/// While it lives, stderr is discarded: libjpeg writes its own text there, and OpenCV offers no other way to hear of it.
/// One at a time; lines of other threads are lost meanwhile.
class SilentStderr {
 public:
  SilentStderr() : lock_(Mutex()), kept_(dup(STDERR_FILENO)) {
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nothing >= 0) dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) close(nothing);
  }
  ~SilentStderr() {
    if (kept_ < 0) return;
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  SilentStderr(const SilentStderr&) = delete;
  SilentStderr& operator=(const SilentStderr&) = delete;

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  int kept_;
};

/// A JPEG without its end marker, which libjpeg decodes without an error, grey where data are missing. Whether some are
/// is found by what follows them: if all pixels are there, none depends on it. Empty if some are missing.
cv::Mat DecodeWithoutEnd(std::string_view picture) {
  constexpr std::string_view kEndMarker = "\xFF\xD9";
  constexpr size_t kNumFollowing = 64;
  const SilentStderr silent;
  cv::Mat decoded;
  for (const char following : {'\x00', '\xB5', '\x6A'}) {
    const cv::Mat other =
        DecodeWithOpenCv(fmt::format("{}{}{}", picture, std::string(kNumFollowing, following), kEndMarker));
    if (other.empty()) return {};
    if (!decoded.empty() && (decoded.size() != other.size() || cv::norm(decoded, other, cv::NORM_INF) > 0)) return {};
    decoded = other;
  }
  return decoded;
}

/// @throws Error if the file is cut.
cv::Mat DecodeJpeg(std::string_view bytes, std::string_view name) {
  const JpegExtent extent = FirstJpeg(bytes);
  DAUMIER_CHECK(extent.has_scan, "{}: truncated JPEG", name);
  if (extent.has_end) return DecodeWithOpenCv(extent.picture);
  cv::Mat decoded = DecodeWithoutEnd(extent.picture);
  DAUMIER_CHECK(!decoded.empty(), "{}: truncated JPEG: rows are missing at its end", name);
  log::Warn("{}: the JPEG lacks its end marker; all of its pixels are there", name);
  return decoded;
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

}  // namespace

Image::Image(int height, int width, int channels, uint8_t value) : height(height), width(width), channels(channels) {
  DAUMIER_CHECK(height >= 0 && width >= 0 && (channels == 1 || channels == 3),
                "an image of {} x {} x {}, expected H x W x 1 or H x W x 3", height, width, channels);
  pixels.assign(size_t(height) * width * channels, value);
}

Image DecodeImage(std::string_view bytes, std::string_view name) {
  DAUMIER_CHECK(!bytes.empty(), "{}: the file is empty", name);
  if (IsPng(bytes)) CheckPngHeader(bytes, name);
  cv::Mat decoded = IsJpeg(bytes)  ? DecodeJpeg(bytes, name)
                    : IsPng(bytes) ? DecodeWithOpenCv(PixelChunksOfPng(bytes, name))
                                   : DecodeWithOpenCv(bytes);
  DAUMIER_CHECK(!decoded.empty(), "{}: not a readable picture, or truncated (expected PNG, JPEG, WebP, BMP or TIFF)",
                name);
  decoded = Turned(decoded, ExifOrientation(bytes));
  if (decoded.depth() == CV_16U) decoded.convertTo(decoded, CV_8U, 1.0 / 257.0);
  DAUMIER_CHECK(decoded.depth() == CV_8U, "{}: neither 8 nor 16 bits a channel", name);

  cv::Mat result;
  if (decoded.channels() == 4) {
    result = LayOverPaper(decoded);
  } else if (decoded.channels() == 3) {
    cv::cvtColor(decoded, result, cv::COLOR_BGR2RGB);
  } else {
    result = decoded;
  }
  Image image(result.rows, result.cols, result.channels());
  result.copyTo(MatView(image));
  return image;
}

Image ReadImage(const std::filesystem::path& path) {
  return DecodeImage(ReadFile(path), path.string());
}

std::string EncodeImage(const Image& image, ImageFormat format, int jpeg_quality) {
  DAUMIER_CHECK(!image.pixels.empty(), "the picture to encode is empty");
  if (format == ImageFormat::kPng) return EncodePng(image);
  cv::Mat encoded;
  if (image.channels == 3) {
    cv::cvtColor(MatView(image), encoded, cv::COLOR_RGB2BGR);
  } else {
    encoded = MatView(image);
  }
  std::vector<uint8_t> bytes;
  DAUMIER_CHECK(OpenCvEncode(".jpg", encoded, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality}),
                "a picture cannot be encoded");
  return {bytes.begin(), bytes.end()};
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
