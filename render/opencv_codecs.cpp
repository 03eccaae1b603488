#include "render/opencv_codecs.h"

#include "core/error.h"

#include <dlfcn.h>

#include <opencv2/imgcodecs.hpp>

namespace daumier::render {
namespace {

constexpr const char* kLibrary = "libopencv_imgcodecs.so." CV_VERSION;

// The type is that of the header; the name is that of the library, where types are part of a name.
using Decode = cv::Mat(cv::InputArray, int);
constexpr const char* kDecode = "_ZN2cv8imdecodeERKNS_11_InputArrayEi";

/// cv::imdecode of the library, which stays loaded.
Decode* LoadDecode() {
  void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  DAUMIER_CHECK(library != nullptr,
                "{} cannot be loaded, which reads WebP, BMP and TIFF pictures. Install it: ./dev setup", kLibrary);
  auto* const decode = reinterpret_cast<Decode*>(dlsym(library, kDecode));
  DAUMIER_CHECK(decode != nullptr, "{} has no {}. Install the OpenCV that Daumier was built with", kLibrary, kDecode);
  return decode;
}

}  // namespace

cv::Mat OpenCvDecode(const cv::Mat& bytes, int flags) {
  static Decode* const decode = LoadDecode();
  return decode(bytes, flags);
}

}  // namespace daumier::render
