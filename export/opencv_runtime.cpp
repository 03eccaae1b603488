#include "export/opencv_runtime.h"

#include "core/error.h"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/dnn.hpp>

#include <algorithm>

namespace daumier::exporting {
namespace {

/// While it lives, OpenCV prints nothing of the errors that it throws.
class SilentOpenCv {
 public:
  SilentOpenCv()
      : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)),
        callback_(cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; })) {}
  ~SilentOpenCv() {
    cv::redirectError(callback_);
    cv::utils::logging::setLogLevel(level_);
  }
  SilentOpenCv(const SilentOpenCv&) = delete;
  SilentOpenCv& operator=(const SilentOpenCv&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
  cv::ErrorCallback callback_;
};

/// Shares the memory of a contiguous float32 tensor.
cv::Mat ViewAsMat(const torch::Tensor& tensor) {
  const std::vector<int> sizes(tensor.sizes().begin(), tensor.sizes().end());
  return cv::Mat(sizes, CV_32F, tensor.data_ptr<float>());
}

torch::Tensor CopyOfMat(const cv::Mat& given) {
  const cv::Mat mat = given.isContinuous() ? given : given.clone();
  const std::vector<int64_t> sizes(mat.size.p, mat.size.p + mat.dims);
  return torch::from_blob(mat.data, sizes, torch::kFloat32).clone();
}

}  // namespace

OnnxOutputs RunInOpenCv(const std::filesystem::path& model, const std::vector<tensor::NamedTensors>& runs,
                        const std::vector<std::string>& output_names) {
  const SilentOpenCv silent;
  try {
    cv::dnn::Net network = cv::dnn::readNetFromONNX(model.string());
    network.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    const std::vector<cv::String> wanted(output_names.begin(), output_names.end());
    OnnxOutputs result{.runtime = OpenCvName(), .outputs = {}};
    for (const auto& run : runs) {
      std::vector<torch::Tensor> kept;
      for (const auto& [name, tensor] : run) {
        kept.push_back(tensor.detach().cpu().contiguous());
        network.setInput(ViewAsMat(kept.back()), name);
      }
      std::vector<cv::Mat> results;
      network.forward(results, wanted);
      tensor::NamedTensors& outputs = result.outputs.emplace_back();
      for (size_t i = 0; i < results.size(); ++i) outputs[output_names[i]] = CopyOfMat(results[i]);
    }
    return result;
  } catch (const cv::Exception& error) {
    std::string message = error.err;
    std::replace(message.begin(), message.end(), '\n', ' ');
    throw Error(fmt::format("OpenCV cannot run {}: {}", model.string(), message));
  }
}

std::string OpenCvName() {
  return fmt::format("OpenCV {}", cv::getVersionString());
}

}  // namespace daumier::exporting
