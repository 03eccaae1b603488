#include "export/onnx_runtime.h"

#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/program_folder.h"
#include "export/onnx_runtime_native.h"

#include <cstdlib>

namespace daumier::exporting {
namespace {

namespace fs = std::filesystem;

constexpr double kTimeoutSeconds = 300;

/// The folder with run_onnx.mjs and the installed package.
std::optional<fs::path> NpmFolder() {
  const auto is_installed = [](const fs::path& folder) {
    return fs::exists(folder / "run_onnx.mjs") && fs::exists(folder / "node_modules/onnxruntime-node/package.json");
  };
  if (const char* folder = std::getenv("DAUMIER_NPM"); folder != nullptr) {
    return is_installed(folder) ? std::optional<fs::path>(folder) : std::nullopt;
  }
  const auto root =
      NearestAbove(ProgramFolder(), [&](const fs::path& here) { return is_installed(here / "tools/npm"); });
  return root ? std::optional<fs::path>(*root / "tools/npm") : std::nullopt;
}

void WriteRaw(const fs::path& file, const torch::Tensor& tensor) {
  DAUMIER_CHECK(tensor.scalar_type() == torch::kFloat32, "an input of ONNX Runtime is {}, expected float32",
                c10::toString(tensor.scalar_type()));
  const auto plain = tensor.detach().cpu().contiguous();
  WriteFileAtomically(file, {static_cast<const char*>(plain.data_ptr()), plain.nbytes()});
}

torch::Tensor ReadRaw(const fs::path& file, const std::vector<int64_t>& shape) {
  auto tensor = torch::empty(shape, torch::kFloat32);
  const std::string bytes = ReadFile(file);
  DAUMIER_CHECK(bytes.size() == tensor.nbytes(), "{} has {} bytes, expected {}", file.string(), bytes.size(),
                tensor.nbytes());
  std::copy(bytes.begin(), bytes.end(), static_cast<char*>(tensor.data_ptr()));
  return tensor;
}

/// Writes the inputs next to the request that tools/npm/run_onnx.mjs reads.
Json MakeRequest(const fs::path& model, const std::vector<tensor::NamedTensors>& runs,
                 const std::vector<std::string>& output_names, const fs::path& scratch, int timed_runs) {
  Json request = {{"model", fs::absolute(model).string()}, {"runs", Json::array()}, {"timed_runs", timed_runs}};
  for (size_t run = 0; run < runs.size(); ++run) {
    Json inputs = Json::array(), outputs = Json::array();
    for (const auto& [name, tensor] : runs[run]) {
      const auto file = fs::absolute(scratch / fmt::format("run{}_input{}.raw", run, inputs.size()));
      WriteRaw(file, tensor);
      inputs.push_back({{"name", name}, {"dims", tensor.sizes().vec()}, {"file", file.string()}});
    }
    for (const auto& name : output_names) {
      const auto file = fs::absolute(scratch / fmt::format("run{}_output{}.raw", run, outputs.size()));
      outputs.push_back({{"name", name}, {"file", file.string()}});
    }
    request["runs"].push_back({{"inputs", inputs}, {"outputs", outputs}});
  }
  return request;
}

std::optional<OnnxOutputs> RunInNode(const fs::path& model, const std::vector<tensor::NamedTensors>& runs,
                                     const std::vector<std::string>& output_names, const fs::path& scratch,
                                     int timed_runs) {
  const auto npm = NpmFolder();
  if (!npm.has_value()) return std::nullopt;
  const Json request = MakeRequest(model, runs, output_names, scratch, timed_runs);
  WriteFileAtomically(scratch / "request.json", request.dump());
  const auto child = RunChild({"node", (*npm / "run_onnx.mjs").string(), (scratch / "request.json").string()}, scratch,
                              {.timeout_seconds = kTimeoutSeconds});
  if (!child.has_value()) return std::nullopt;
  DAUMIER_CHECK(child->exit_code == 0, "ONNX Runtime cannot run {}: {}", model.string(), child->err);

  const Json reply = ParseJson(child->out, "the reply of run_onnx.mjs");
  OnnxOutputs result{.runtime = reply.at("runtime"), .outputs = {}, .milliseconds = reply.at("milliseconds")};
  for (size_t run = 0; run < runs.size(); ++run) {
    tensor::NamedTensors& outputs = result.outputs.emplace_back();
    for (const Json& output : request["runs"][run]["outputs"]) {
      const std::string name = output["name"];
      outputs[name] = ReadRaw(output["file"].get<std::string>(), reply.at("outputs")[run].at(name));
    }
  }
  return result;
}

}  // namespace

std::optional<OnnxOutputs> RunInOnnxRuntime(const fs::path& model, const std::vector<tensor::NamedTensors>& runs,
                                            const std::vector<std::string>& output_names, const fs::path& scratch,
                                            int timed_runs) {
  if (HasNativeOnnxRuntime()) return RunInNativeOnnxRuntime(model, runs, output_names, timed_runs);
  return RunInNode(model, runs, output_names, scratch, timed_runs);
}

}  // namespace daumier::exporting
