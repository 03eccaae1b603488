#include "export/parity.h"

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "export/onnx_graph.h"
#include "export/onnx_runtime.h"
#include "export/opencv_runtime.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace daumier::exporting {
namespace {

constexpr int kFormatVersion = 1;

/// Not a number if either is not a number somewhere.
double MaxAbsDiff(const torch::Tensor& output, const torch::Tensor& reference) {
  DAUMIER_CHECK(output.sizes() == reference.sizes(),
                "the output of ONNX Runtime has another shape than that of LibTorch");
  return (output - reference).abs().max().item<double>();
}

/// The samples of each batch size.
std::vector<tensor::NamedTensors> SampleInputs(const ExportedFunction& function,
                                               const std::vector<int64_t>& batch_sizes, uint64_t seed) {
  Rng rng = Stream(seed, "parity");
  std::vector<tensor::NamedTensors> runs;
  for (const int64_t batch : batch_sizes) {
    tensor::NamedTensors& run = runs.emplace_back();
    for (const ExportedInput& input : function.inputs) run[input.name] = input.sample(batch, rng);
  }
  return runs;
}

std::vector<torch::Tensor> ReferenceOutputs(const ExportedFunction& function, const tensor::NamedTensors& run) {
  std::vector<torch::Tensor> given;
  for (const ExportedInput& input : function.inputs) given.push_back(run.at(input.name));
  return function.forward(given);
}

/// The least number of output channels above 2 of a convolution, up to 128; 5 where there is none.
int64_t ChannelCount(const std::filesystem::path& file) {
  onnx::ModelProto model;
  DAUMIER_CHECK(model.ParseFromString(ReadFile(file)), "{} is no ONNX file", file.string());
  std::set<std::string> weights;
  for (const auto& node : model.graph().node())
    if (node.op_type() == "Conv" && node.input_size() > 1) weights.insert(node.input(1));
  constexpr int64_t kMost = 128;
  int64_t count = kMost + 1;
  for (const auto& stored : model.graph().initializer())
    if (weights.count(stored.name()) == 1 && stored.dims_size() > 0 && stored.dims(0) > 2)
      count = std::min<int64_t>(count, stored.dims(0));
  return count <= kMost ? count : 5;
}

Json OrNull(const auto& optional) {
  return optional.has_value() ? Json(*optional) : Json();
}

}  // namespace

double ParityReport::max_abs_diff() const {
  DAUMIER_CHECK(!max_abs_diffs.empty(), "nothing was compared");
  return *std::max_element(max_abs_diffs.begin(), max_abs_diffs.end());
}

ParityReport CheckParity(const std::filesystem::path& model, const ExportedFunction& function, uint64_t seed,
                         const std::filesystem::path& scratch) {
  at::NoGradGuard no_grad;
  ParityReport report{std::nullopt, {1, 2, 5}, function.output_names, {}, {CompareWithOpenCv(model, function, seed)}};
  for (const ExportedInput& input : function.inputs) report.sample_texts[input.name] = input.sample_text;
  const std::vector<tensor::NamedTensors> runs = SampleInputs(function, report.batch_sizes, seed);
  const auto exported = RunInOnnxRuntime(model, runs, function.output_names, scratch);
  if (!exported.has_value()) {
    report.batch_sizes.clear();  // None was run.
    return report;
  }

  report.runtime = exported->runtime;
  report.max_abs_diffs.assign(function.output_names.size(), 0.0);
  for (size_t run = 0; run < runs.size(); ++run) {
    const auto references = ReferenceOutputs(function, runs[run]);
    for (size_t i = 0; i < references.size(); ++i) {
      const auto& name = function.output_names[i];
      const double difference = MaxAbsDiff(exported->outputs[run].at(name), references[i]);
      DAUMIER_CHECK(difference <= kParityTolerance,
                    "{} and LibTorch differ by {:.3g} in output '{}' at batch size {}; at most {:g} is allowed",
                    *report.runtime, std::abs(difference), name, report.batch_sizes[run], kParityTolerance);
      report.max_abs_diffs[i] = std::max(report.max_abs_diffs[i], difference);
    }
  }
  return report;
}

OtherRuntime CompareWithOpenCv(const std::filesystem::path& model, const ExportedFunction& function, uint64_t seed) {
  at::NoGradGuard no_grad;
  OtherRuntime other{OpenCvName(), {1, 2, ChannelCount(model)}, std::nullopt, std::nullopt};
  const std::vector<tensor::NamedTensors> runs = SampleInputs(function, other.batch_sizes, seed);
  try {
    const OnnxOutputs result = RunInOpenCv(model, runs, function.output_names);
    double worst = 0;
    for (size_t run = 0; run < runs.size(); ++run) {
      const auto references = ReferenceOutputs(function, runs[run]);
      for (size_t i = 0; i < references.size(); ++i) {
        const torch::Tensor& output = result.outputs[run].at(function.output_names[i]);
        DAUMIER_CHECK(output.sizes() == references[i].sizes(), "its output '{}' has another shape at batch size {}",
                      function.output_names[i], other.batch_sizes[run]);
        const double largest = references[i].abs().max().item<double>();
        const double difference = MaxAbsDiff(output, references[i]);
        DAUMIER_CHECK(std::isfinite(difference), "its output '{}' is not a number at batch size {}",
                      function.output_names[i], other.batch_sizes[run]);
        worst = std::max(worst, largest > 0 ? difference / largest : difference);
      }
    }
    other.max_relative_diff = worst;
  } catch (const Error& error) {
    other.refusal = error.what();
  }
  return other;
}

Json ParityToJson(const ParityReport& report) {
  Json outputs = Json::object();
  for (size_t i = 0; i < report.output_names.size(); ++i) {
    outputs[report.output_names[i]] = report.max_abs_diffs.empty() ? Json() : Json(report.max_abs_diffs[i]);
  }
  Json others = Json::array();
  for (const OtherRuntime& other : report.others)
    others.push_back({{"runtime", other.runtime},
                      {"batch_sizes", other.batch_sizes},
                      {"max_relative_diff", OrNull(other.max_relative_diff)},
                      {"refusal", OrNull(other.refusal)},
                      {"tolerance", kOpenCvTolerance}});
  return {{"format_version", kFormatVersion},
          {"runtime", report.runtime.has_value() ? Json(*report.runtime) : Json()},
          {"opset", kOpset},
          {"ir_version", kIrVersion},
          {"max_abs_diff", report.runtime.has_value() ? Json(report.max_abs_diff()) : Json()},
          {"tolerance", kParityTolerance},
          {"batch_sizes", report.batch_sizes},
          {"inputs", report.sample_texts},
          {"outputs", outputs},
          {"other_runtimes", others}};
}

}  // namespace daumier::exporting
