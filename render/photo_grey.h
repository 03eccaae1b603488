#pragma once
#include "render/image.h"
#include "render/opencv_bridge.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace daumier::render {

/// The least of the channels: white paper has it large, a coloured desk does not.
inline cv::Mat LeastChannel(const Image& picture) {
  if (picture.channels == 1) return MatView(picture).clone();
  std::vector<cv::Mat> channels;
  cv::split(MatView(picture), channels);
  return cv::min(channels[0], cv::min(channels[1], channels[2]));
}

/// A grey picture whose longer side is no longer than a number of pixels.
inline cv::Mat ShrunkTo(const cv::Mat& grey, int side) {
  const double scale = std::min(1.0, static_cast<double>(side) / std::max(grey.rows, grey.cols));
  if (scale == 1.0) return grey;
  cv::Mat shrunk;
  cv::resize(grey, shrunk,
             {std::max(1, static_cast<int>(std::lround(scale * grey.cols))),
              std::max(1, static_cast<int>(std::lround(scale * grey.rows)))},
             0, 0, cv::INTER_AREA);
  return shrunk;
}

}  // namespace daumier::render
