#include "render/opencv_codecs.h"

#include "core/error.h"

#include <dlfcn.h>

#include <opencv2/imgcodecs.hpp>

namespace daumier::render {
namespace {

// The types are those of the header; the names are those of the library, where types are part of a name.
using Decode = cv::Mat(cv::InputArray, int);
using Encode = bool(const cv::String&, cv::InputArray, std::vector<uchar>&, const std::vector<int>&);
static_assert(std::is_same_v<decltype(cv::imencode), Encode>);
constexpr const char* kLibrary = "libopencv_imgcodecs.so." CV_VERSION;
constexpr const char* kDecode = "_ZN2cv8imdecodeERKNS_11_InputArrayEi";
constexpr const char* kEncode =
    "_ZN2cv8imencodeERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEERKNS_11_InputArrayERSt6vectorIhSaIhEERKSB_"
    "IiSaIiEE";

/// A function of the library, which stays loaded.
template <class Function>
Function* FunctionOf(const char* name) {
  static void* const library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  DAUMIER_CHECK(library != nullptr, "{} cannot be loaded, which reads pictures. Install it: ./dev setup", kLibrary);
  auto* const function = reinterpret_cast<Function*>(dlsym(library, name));
  DAUMIER_CHECK(function != nullptr, "{} has no {}. Install the OpenCV that Daumier was built with", kLibrary, name);
  return function;
}

}  // namespace

cv::Mat OpenCvDecode(const cv::Mat& bytes, int flags) {
  static Decode* const decode = FunctionOf<Decode>(kDecode);
  return decode(bytes, flags);
}

bool OpenCvEncode(const std::string& extension, const cv::Mat& image, std::vector<uint8_t>& bytes,
                  const std::vector<int>& parameters) {
  static Encode* const encode = FunctionOf<Encode>(kEncode);
  return encode(extension, image, bytes, parameters);
}

}  // namespace daumier::render
