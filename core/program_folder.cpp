#include "core/program_folder.h"

namespace daumier {

namespace fs = std::filesystem;

fs::path ProgramFolder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

std::optional<fs::path> NearestAbove(const fs::path& folder, const std::function<bool(const fs::path&)>& holds) {
  for (fs::path here = folder; !here.empty(); here = here.parent_path()) {
    if (holds(here)) return here;
    if (here == here.parent_path()) break;
  }
  return std::nullopt;
}

}  // namespace daumier
