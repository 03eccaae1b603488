#pragma once
#include <opencv2/core.hpp>

/// OpenCV's imgcodecs, loaded at the first call: with it come more than a hundred libraries, which takes a program 0.1 s.
namespace daumier::render {

/// cv::imdecode. @throws Error if the library cannot be loaded; cv::Exception as it does.
cv::Mat OpenCvDecode(const cv::Mat& bytes, int flags);

}  // namespace daumier::render
