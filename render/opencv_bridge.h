#pragma once
#include "render/image.h"

#include <opencv2/core.hpp>

/// For .cpp files of this room only: OpenCV stays out of the headers that others include.
namespace daumier::render {

/// A view of the image's own bytes, CV_8UC1 or CV_8UC3. No copy; valid while the image lives and keeps its size.
inline cv::Mat MatView(Image& image) {
  return {image.height, image.width, CV_8UC(image.channels), image.pixels.data()};
}
/// The same for reading: OpenCV has no matrix of const bytes.
inline const cv::Mat MatView(const Image& image) {
  return {image.height, image.width, CV_8UC(image.channels), const_cast<uint8_t*>(image.pixels.data())};
}

}  // namespace daumier::render
