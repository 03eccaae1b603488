#include "export/parity.h"

#include "core/error.h"
#include "core/random.h"
#include "export/onnx_graph.h"
#include "export/onnx_runtime.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <cmath>

namespace daumier::exporting {
namespace {

constexpr int kFormatVersion = 1;

/// Not a number if either is not a number somewhere.
double MaxAbsDiff(const torch::Tensor& output, const torch::Tensor& reference) {
  DAUMIER_CHECK(output.sizes() == reference.sizes(),
                "the output of ONNX Runtime has another shape than that of LibTorch");
  return (output - reference).abs().max().item<double>();
}

}  // namespace

double ParityReport::max_abs_diff() const {
  DAUMIER_CHECK(!max_abs_diffs.empty(), "nothing was compared");
  return *std::max_element(max_abs_diffs.begin(), max_abs_diffs.end());
}

ParityReport CheckParity(const std::filesystem::path& model, const ExportedFunction& function, uint64_t seed,
                         const std::filesystem::path& scratch) {
  at::NoGradGuard no_grad;
  ParityReport report{std::nullopt, {1, 2, 5}, function.output_names, {}};
  Rng rng = Stream(seed, "parity");
  std::vector<tensor::NamedTensors> runs;
  for (const int64_t batch : report.batch_sizes) {
    tensor::NamedTensors& run = runs.emplace_back();
    for (const ExportedInput& input : function.inputs) run[input.name] = input.sample(batch, rng);
  }
  const auto exported = RunInOnnxRuntime(model, runs, function.output_names, scratch);
  if (!exported.has_value()) return report;

  report.runtime = exported->runtime;
  report.max_abs_diffs.assign(function.output_names.size(), 0.0);
  for (size_t run = 0; run < runs.size(); ++run) {
    std::vector<torch::Tensor> given;
    for (const ExportedInput& input : function.inputs) given.push_back(runs[run].at(input.name));
    const auto references = function.forward(given);
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

Json ParityToJson(const ParityReport& report) {
  Json outputs = Json::object();
  for (size_t i = 0; i < report.output_names.size(); ++i) {
    outputs[report.output_names[i]] = report.max_abs_diffs.empty() ? Json() : Json(report.max_abs_diffs[i]);
  }
  return {{"format_version", kFormatVersion},
          {"runtime", report.runtime.has_value() ? Json(*report.runtime) : Json()},
          {"opset", kOpset},
          {"ir_version", kIrVersion},
          {"max_abs_diff", report.runtime.has_value() ? Json(report.max_abs_diff()) : Json()},
          {"tolerance", kParityTolerance},
          {"batch_sizes", report.batch_sizes},
          {"outputs", outputs}};
}

}  // namespace daumier::exporting
