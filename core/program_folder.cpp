#include "core/program_folder.h"

#include <dlfcn.h>
#include <link.h>

namespace daumier {

namespace fs = std::filesystem;

fs::path ProgramFolder() {
  std::error_code error;
  Dl_info info{};
  const link_map* object = nullptr;
  const bool is_found = dladdr1(reinterpret_cast<void*>(&ProgramFolder), &info,
                                reinterpret_cast<void**>(const_cast<link_map**>(&object)), RTLD_DL_LINKMAP) != 0;
  const bool is_library = is_found && object != nullptr && object->l_name[0] != '\0';  // The program's own is empty.
  return (is_library ? fs::canonical(object->l_name, error) : fs::read_symlink("/proc/self/exe", error)).parent_path();
}

std::optional<fs::path> NearestAbove(const fs::path& folder, const std::function<bool(const fs::path&)>& holds) {
  for (fs::path here = folder; !here.empty(); here = here.parent_path()) {
    if (holds(here)) return here;
    if (here == here.parent_path()) break;
  }
  return std::nullopt;
}

}  // namespace daumier
