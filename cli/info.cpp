#include "cli/verb.h"
#include "core/runtime.h"

#include <ATen/Parallel.h>
#include <torch/cuda.h>
#include <torch/version.h>

#include <memory>

namespace daumier::cli {

Verb InfoVerb() {
  return {
      "info", "Versions, device, BLAS library and kernel, threads, measured speed", [](CLI::App& command) {
        auto as_json = std::make_shared<bool>(false);
        command.add_flag("--json", *as_json, "Machine-readable");
        return [as_json] {
          const BlasInfo blas = DescribeBlas();
          PrintResult(
              {{"daumier", DAUMIER_VERSION},
               {"libtorch", TORCH_VERSION},
               {"device", torch::cuda::is_available() ? "cuda" : "cpu"},
               {"threads", at::get_num_threads()},
               {"blas", {{"library", blas.library}, {"kernel", blas.kernel}, {"double_library", blas.double_library}}},
               {"sgemm_gflops", MeasureSgemm()}},
              *as_json);
        };
      }};
}

}  // namespace daumier::cli
