#pragma once
#include "render/image.h"

#include <opencv2/core.hpp>

#include <string>
#include <string_view>

/// JPEG by libjpeg-turbo, whose messages are ours to say: it prints nothing.
namespace daumier::render {

struct DecodedJpeg {
  cv::Mat
      pixels;  ///< 8 bits, grey or RGB, as stored: not turned by Exif. Grey where data are missing. Empty if unreadable.
  bool is_whole = true;  ///< Every pixel is there at the accuracy of the file's last scan.
  std::string
      complaint;  ///< The first that libjpeg has to say: why it is unreadable, or what is odd; empty if nothing.
};

/// The first picture that begins at the first byte. CMYK becomes RGB without a colour profile; it is inverted if an Adobe
/// marker says so [Adobe Technical Note 5116]. Pictures over 2^30 pixels are unreadable.
DecodedJpeg DecodeJpeg(std::string_view bytes);

/// The bytes of a JPEG file of a picture that is not empty, colours at half resolution (4:2:0): those that OpenCV writes.
/// @throws Error with libjpeg's message if it fails.
std::string EncodeJpeg(const Image& image, int quality);

}  // namespace daumier::render
