#include "render/opencv_codecs.h"

#include "core/late_library.h"

#include <opencv2/imgcodecs.hpp>

namespace daumier::render {
namespace {

// The type is that of the header; the name is that of the library, where types are part of a name.
using Decode = cv::Mat(cv::InputArray, int);
constexpr const char* kDecode = "_ZN2cv8imdecodeERKNS_11_InputArrayEi";

}  // namespace

cv::Mat OpenCvDecode(const cv::Mat& bytes, int flags) {
  static const LateLibrary library("libopencv_imgcodecs.so." CV_VERSION, "reads WebP, BMP and TIFF pictures");
  static Decode* const decode = library[kDecode];
  return decode(bytes, flags);
}

}  // namespace daumier::render
