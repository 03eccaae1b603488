#pragma once
#include "core/json.h"
#include "studio/workspace.h"

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

namespace daumier::studio {

/// Files that a person dropped on the page, each in a folder u-NNNN under its own name. The folder is emptied first: uploads last
/// as long as the program. Thread-safe.
class Uploads {
 public:
  static constexpr size_t kMostKept = 50;

  explicit Uploads(const std::filesystem::path& folder);

  /// {id, name, kind: picture, drawing, mesh, clip, session or other, looks_like: portrait, drawing or null}, by the name's ending
  /// and the content. @throws UsageError if it is empty.
  Json Add(std::string_view name, std::string_view bytes);
  /// @throws NotFound.
  std::filesystem::path FileOf(std::string_view id) const;

 private:
  mutable std::mutex mutex_;
  NumberedFolders folders_;
};

/// The name of a file without folders, with letters, digits, '.', '_' and '-' alone, that begins with a letter or digit.
std::string SafeFileName(std::string_view name);

}  // namespace daumier::studio
