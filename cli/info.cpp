#include "cli/verb.h"
#include "core/runtime.h"
#include "systems/training_library.h"

#include <memory>

namespace daumier::cli {

Verb InfoVerb() {
  return {
      "info", "Versions, device, BLAS library and kernel, threads, measured speed",
      [](CLI::App& command) {
        auto as_json = std::make_shared<bool>(false);
        command.add_flag("--json", *as_json, "Print the result as JSON");
        return [as_json] {
          Json info = systems::LoadTrainingLibrary().describe();
          const BlasInfo blas = DescribeBlas();
          info["daumier"] = DAUMIER_VERSION;
          info["blas"] = {{"library", blas.library}, {"kernel", blas.kernel}, {"double_library", blas.double_library}};
          PrintResult(info, *as_json);
        };
      },
      /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
