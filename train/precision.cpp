#include "train/precision.h"

#include "core/error.h"
#include "core/manifest.h"

namespace daumier::train {

std::string PrecisionForRun(const std::string& precision, const std::string& of_run) {
  if (precision == "force-bfloat16") return "bfloat16";
  return precision == "auto" ? of_run : precision;
}

std::string ResolvePrecision(const std::string& precision, const std::filesystem::path& run_directory,
                             const torch::Device& device, bool has_instructions) {
  const bool slow = device.is_cpu() && !has_instructions;
  std::string of_run = device.is_cpu() && has_instructions ? "bfloat16" : "float32";
  if (std::filesystem::exists(run_directory / "manifest.json"))
    of_run = ReadManifest(run_directory, "run").config.value("precision", std::string("float32"));
  const std::string resolved = PrecisionForRun(precision, of_run);
  if (resolved == "bfloat16" && slow && precision != "force-bfloat16")
    throw UsageError(fmt::format(
        "precision=\"{}\"{}: this processor, or ONEDNN_MAX_CPU_ISA, is without the bfloat16 instructions of AVX-512 "
        "and AMX. LibTorch would train some 20 times as slowly, and some of its sums would stop at 256. Use "
        "precision=\"float32\" for a new run, or precision=\"force-bfloat16\" all the same",
        precision, precision == "auto" ? " of a run in bfloat16" : ""));
  return resolved;
}

}  // namespace daumier::train
