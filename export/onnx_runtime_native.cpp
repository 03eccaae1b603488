#include "export/onnx_runtime_native.h"

#include "core/error.h"
#include "core/median_time.h"

#ifdef DAUMIER_HAS_ONNXRUNTIME
#include <onnxruntime_cxx_api.h>

namespace daumier::exporting {
namespace {

/// Contiguous float32 tensors, whose memory the values share.
Ort::Value ViewAsValue(const torch::Tensor& tensor) {
  const auto memory = Ort::MemoryInfo::CreateCpu(OrtArenaAllocator, OrtMemTypeDefault);
  const auto shape = tensor.sizes().vec();
  return Ort::Value::CreateTensor<float>(memory, tensor.data_ptr<float>(), tensor.numel(), shape.data(), shape.size());
}

torch::Tensor CopyOfValue(Ort::Value& value) {
  return torch::from_blob(value.GetTensorMutableData<float>(), value.GetTensorTypeAndShapeInfo().GetShape()).clone();
}

}  // namespace

bool HasNativeOnnxRuntime() {
  return true;
}

OnnxOutputs RunInNativeOnnxRuntime(const std::filesystem::path& model, const std::vector<tensor::NamedTensors>& runs,
                                   const std::vector<std::string>& output_names, int timed_runs) {
  try {
    Ort::Env environment(ORT_LOGGING_LEVEL_ERROR, "daumier");
    Ort::Session session(environment, model.c_str(), Ort::SessionOptions());
    std::vector<const char*> wanted;
    for (const auto& name : output_names) wanted.push_back(name.c_str());
    OnnxOutputs result{fmt::format("onnxruntime {}", OrtGetApiBase()->GetVersionString()), {}};
    for (const auto& run : runs) {
      std::vector<torch::Tensor> kept;
      std::vector<const char*> names;
      std::vector<Ort::Value> values;
      for (const auto& [name, tensor] : run) {
        kept.push_back(tensor.detach().cpu().contiguous());
        names.push_back(name.c_str());
        values.push_back(ViewAsValue(kept.back()));
      }
      const auto run_session = [&] {
        return session.Run(Ort::RunOptions(), names.data(), values.data(), values.size(), wanted.data(), wanted.size());
      };
      auto results = run_session();
      if (timed_runs > 0) result.milliseconds.push_back(MedianMs(run_session, timed_runs));
      tensor::NamedTensors& outputs = result.outputs.emplace_back();
      for (size_t i = 0; i < results.size(); ++i) outputs[output_names[i]] = CopyOfValue(results[i]);
    }
    return result;
  } catch (const Ort::Exception& error) {
    throw Error(fmt::format("ONNX Runtime cannot run {}: {}", model.string(), error.what()));
  }
}

}  // namespace daumier::exporting

#else

namespace daumier::exporting {

bool HasNativeOnnxRuntime() {
  return false;
}

OnnxOutputs RunInNativeOnnxRuntime(const std::filesystem::path&, const std::vector<tensor::NamedTensors>&,
                                   const std::vector<std::string>&, int) {
  throw Error("this build has no native ONNX Runtime");
}

}  // namespace daumier::exporting

#endif
