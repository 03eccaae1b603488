#include "cli/verb.h"
#include "core/runtime.h"
#include "tensor/runtime.h"

#include <memory>

namespace daumier::cli {

Verb InfoVerb() {
  return {"info", "Versions, device, BLAS library and kernel, threads, measured speed", [](CLI::App& command) {
            auto as_json = std::make_shared<bool>(false);
            command.add_flag("--json", *as_json, "Machine-readable");
            return [as_json] {
              const BlasInfo blas = DescribeBlas();
              PrintResult({{"daumier", DAUMIER_VERSION},
                           {"libtorch", tensor::TorchVersion()},
                           {"device", tensor::DescribeDevice()},
                           {"threads", tensor::NumThreads()},
                           {"blas", {{"library", blas.library}, {"kernel", blas.kernel}}},
                           {"sgemm_gflops", MeasureSgemm()}},
                          *as_json);
            };
          }};
}

}  // namespace daumier::cli
