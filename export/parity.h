#pragma once
#include "core/json.h"
#include "export/exported_function.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::exporting {

/// Largest difference allowed between an output of LibTorch and of ONNX Runtime, in the output's own unit.
inline constexpr double kParityTolerance = 1e-4;

struct ParityReport {
  std::optional<std::string> runtime;  ///< Absent: there is no ONNX Runtime here, and nothing was compared.
  std::vector<int64_t> batch_sizes;
  std::vector<std::string> output_names;
  std::vector<double> max_abs_diffs;  ///< One an output, over all batch sizes; empty without a runtime.

  double max_abs_diff() const;
};

/// Compares the outputs of LibTorch and of ONNX Runtime for the same samples of the function's inputs, at batch sizes
/// 1, 2 and 5. Deterministic in seed. `scratch` is a folder for files in between.
/// @throws Error naming the output, the difference and the batch size if one exceeds kParityTolerance or is not a
/// number.
ParityReport CheckParity(const std::filesystem::path& model, const ExportedFunction& function, uint64_t seed,
                         const std::filesystem::path& scratch);

/// parity.json: format_version, runtime (text or null), opset, max_abs_diff (number or null), tolerance, batch_sizes,
/// outputs.
Json ParityToJson(const ParityReport& report);

}  // namespace daumier::exporting
