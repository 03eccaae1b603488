#include "render/draw.h"

#include "core/error.h"
#include "render/opencv_bridge.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace daumier::render {
namespace {

/// Text is drawn larger by this factor and averaged down: the font's strokes are one unit wide and ragged at small
/// sizes.
constexpr int kOversampling = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

struct TextLayout {
  double scale;   ///< Of the font, at kOversampling.
  int thickness;  ///< At kOversampling.
  cv::Size size;  ///< Of ascenders only, at kOversampling.
  int baseline;
};

TextLayout LayOutText(const std::string& text, const TextStyle& style) {
  TextLayout layout{};
  // The font's capitals are 22 units high at scale 1; they take 0.55 of the line.
  layout.scale = 0.55 * style.height * kOversampling / 22.0;
  layout.thickness =
      std::max(1, static_cast<int>(std::lround(style.height * kOversampling * (style.bold ? 0.115 : 0.075))));
  layout.size = cv::getTextSize(text, kFont, layout.scale, layout.thickness, &layout.baseline);
  return layout;
}

/// R, G, B as the image has them: a grey image gets the luma.
uint8_t ChannelOf(const Rgb& colour, int channel, int num_channels) {
  if (num_channels == 3) return colour[channel];
  return static_cast<uint8_t>(std::lround(0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2]));
}

}  // namespace

double TextWidth(std::string_view text, const TextStyle& style) {
  return text.empty() ? 0.0 : LayOutText(std::string(text), style).size.width / static_cast<double>(kOversampling);
}

TextStyle FittedTextStyle(std::string_view text, TextStyle style, double max_width) {
  const double width = TextWidth(text, style);
  if (width > max_width) style.height *= max_width / width;
  return style;
}

void DrawText(Image& image, std::string_view text, double x, double top, const TextStyle& style) {
  if (text.empty()) return;
  std::string ascii(text);
  // Of a character of several bytes, one '?' is shown.
  std::erase_if(ascii, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; });
  std::replace_if(
      ascii.begin(), ascii.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }, '?');

  const TextLayout layout = LayOutText(ascii, style);
  const int margin = 2;
  const int mask_width = layout.size.width / kOversampling + 2 * margin + 1;
  const int mask_height = static_cast<int>(std::ceil(style.height)) + 2 * margin;
  cv::Mat large(mask_height * kOversampling, mask_width * kOversampling, CV_8UC1, cv::Scalar(0));
  const double baseline = margin + 0.5 * style.height + 0.5 * 0.55 * style.height;
  cv::putText(large, ascii, {margin * kOversampling, static_cast<int>(std::lround(baseline * kOversampling))}, kFont,
              layout.scale, cv::Scalar(255), layout.thickness, cv::LINE_AA);
  cv::Mat mask;
  cv::resize(large, mask, {mask_width, mask_height}, 0, 0, cv::INTER_AREA);

  const double width = layout.size.width / static_cast<double>(kOversampling);
  const double shift = style.align == TextAlign::kLeft ? 0.0 : style.align == TextAlign::kCentre ? 0.5 * width : width;
  const int left = static_cast<int>(std::lround(x - shift)) - margin;
  const int first_row = static_cast<int>(std::lround(top)) - margin;
  for (int row = std::max(0, -first_row); row < mask_height && first_row + row < image.height; ++row) {
    for (int column = std::max(0, -left); column < mask_width && left + column < image.width; ++column) {
      const int alpha = mask.at<uint8_t>(row, column);
      for (int channel = 0; channel < image.channels; ++channel) {
        uint8_t& value = image.at(first_row + row, left + column, channel);
        value = static_cast<uint8_t>(
            (value * (255 - alpha) + ChannelOf(style.colour, channel, image.channels) * alpha + 127) / 255);
      }
    }
  }
}

void FillRectangle(Image& image, int top, int left, int height, int width, const Rgb& colour) {
  for (int row = std::max(0, top); row < std::min(image.height, top + height); ++row) {
    for (int column = std::max(0, left); column < std::min(image.width, left + width); ++column) {
      for (int channel = 0; channel < image.channels; ++channel) {
        image.at(row, column, channel) = ChannelOf(colour, channel, image.channels);
      }
    }
  }
}

void Paste(Image& image, const Image& source, int top, int left) {
  DAUMIER_CHECK(image.channels >= source.channels, "an RGB image cannot be pasted into a grey one");
  for (int row = std::max(0, -top); row < source.height && top + row < image.height; ++row) {
    for (int column = std::max(0, -left); column < source.width && left + column < image.width; ++column) {
      for (int channel = 0; channel < image.channels; ++channel) {
        image.at(top + row, left + column, channel) = source.at(row, column, std::min(channel, source.channels - 1));
      }
    }
  }
}

Image ToRgb(const Image& image) {
  if (image.channels == 3) return image;
  Image result(image.height, image.width, 3);
  Paste(result, image, 0, 0);
  return result;
}

Image Resize(const Image& image, int height, int width) {
  DAUMIER_CHECK(height > 0 && width > 0, "an image is resized to {} x {}", height, width);
  DAUMIER_CHECK(!image.pixels.empty(), "an empty image is resized");
  Image result(height, width, image.channels);
  const bool smaller = height <= image.height && width <= image.width;
  cv::Mat to = MatView(result);
  cv::resize(MatView(image), to, {width, height}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  return result;
}

}  // namespace daumier::render
