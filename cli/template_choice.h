#pragma once
#include <filesystem>
#include <string>

namespace daumier::cli {

/// What --template names: the template of a folder of faces, or that of a face source.
struct TemplateChoice {
  std::filesystem::path folder;  ///< Empty: `source` is used.
  std::string source;            ///< Empty where there is a folder.
};

/// @throws UsageError if `name` is neither a folder nor the name of a source.
TemplateChoice ChooseTemplate(const std::string& name);

}  // namespace daumier::cli
