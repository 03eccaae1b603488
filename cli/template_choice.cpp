#include "cli/template_choice.h"

#include "core/error.h"
#include "faces/source.h"

#include <algorithm>

namespace daumier::cli {

TemplateChoice ChooseTemplate(const std::string& name) {
  namespace fs = std::filesystem;
  if (fs::is_directory(name)) {
    if (!fs::exists(fs::path(name) / "template.json"))
      throw UsageError(fmt::format("--template {}: this is no folder of faces (it has no template.json)", name));
    return {name, ""};
  }
  const std::vector<std::string> names = faces::SourceNames();
  if (std::find(names.begin(), names.end(), name) != names.end()) return {{}, name};
  const char* found = fs::exists(name) ? "this is a file" : "there is no such folder";
  throw UsageError(fmt::format("--template '{}': {} (expected a folder of faces, makehuman or ict)", name, found));
}

}  // namespace daumier::cli
