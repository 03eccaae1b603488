#pragma once
#include "core/json.h"
#include "export/exported_function.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace daumier::exporting {

/// Largest difference allowed between an output of LibTorch and of ONNX Runtime, in the output's own unit.
inline constexpr double kParityTolerance = 1e-4;

/// Largest difference allowed in OpenCV, as a share of the output's largest value.
inline constexpr double kOpenCvTolerance = 1e-4;

/// What a runtime makes of a model that need not run there.
struct OtherRuntime {
  std::string runtime;
  std::vector<int64_t> batch_sizes;
  std::optional<double> max_relative_diff;  ///< From LibTorch, as a share of an output's largest value.
  std::optional<std::string> refusal;       ///< Why there are no outputs to compare.

  bool agrees() const { return max_relative_diff.has_value() && *max_relative_diff <= kOpenCvTolerance; }
};

struct ParityReport {
  std::optional<std::string> runtime;  ///< Absent: there is no ONNX Runtime here, and nothing was compared.
  std::vector<int64_t> batch_sizes;    ///< Of the comparison; empty without a runtime.
  std::vector<std::string> output_names;
  std::vector<double> max_abs_diffs;  ///< One an output, over all batch sizes; empty without a runtime.
  std::vector<OtherRuntime> others = {};
  std::map<std::string, std::string> sample_texts = {};  ///< By input: on what outputs were compared.

  double max_abs_diff() const;
};

/// Compares the outputs of LibTorch and of ONNX Runtime for the same samples of the function's inputs, at batch sizes
/// 1, 2 and 5. Deterministic in seed. `scratch` is a folder for files in between.
/// @throws Error naming the output, the difference and the batch size if one exceeds kParityTolerance or is not a
/// number. Then compares with OpenCV by CompareWithOpenCv, where any outcome is a finding and none an error.
ParityReport CheckParity(const std::filesystem::path& model, const ExportedFunction& function, uint64_t seed,
                         const std::filesystem::path& scratch);

/// The outputs of OpenCV's dnn module, at batch sizes 1, 2 and a number of channels of the model's convolutions:
/// OpenCV 4.6 takes a constant for each channel for one for each sample where both are of one number.
OtherRuntime CompareWithOpenCv(const std::filesystem::path& model, const ExportedFunction& function, uint64_t seed);

/// parity.json: format_version, runtime (text or null), opset, max_abs_diff (number or null), tolerance, batch_sizes,
/// inputs (name: what the samples are), outputs, other_runtimes (runtime, batch_sizes, max_relative_diff, refusal, tolerance).
Json ParityToJson(const ParityReport& report);

}  // namespace daumier::exporting
