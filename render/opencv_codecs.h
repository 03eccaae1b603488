#pragma once
#include <opencv2/core.hpp>

#include <string>
#include <vector>

/// OpenCV's imgcodecs, loaded at the first call: with it come more than a hundred libraries, which takes a program 0.1 s.
namespace daumier::render {

/// cv::imdecode. @throws Error if the library cannot be loaded; cv::Exception as it does.
cv::Mat OpenCvDecode(const cv::Mat& bytes, int flags);

/// cv::imencode, likewise.
bool OpenCvEncode(const std::string& extension, const cv::Mat& image, std::vector<uint8_t>& bytes,
                  const std::vector<int>& parameters);

}  // namespace daumier::render
