#include "systems/portrait/picture_files.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <tuple>

namespace daumier::portrait {

namespace fs = std::filesystem;

const std::vector<std::string>& PictureExtensions() {
  static const std::vector<std::string> extensions = {".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff"};
  return extensions;
}

bool IsPictureFile(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return std::ranges::count(PictureExtensions(), extension) > 0 && !file.filename().string().starts_with('.');
}

std::vector<fs::path> PicturesIn(const fs::path& folder) {
  DAUMIER_CHECK(fs::is_directory(folder), "{} is no folder of pictures", folder.string());
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && IsPictureFile(entry.path())) files.push_back(entry.path());
  std::ranges::sort(files, {}, [](const fs::path& file) {
    const std::string stem = file.stem().string();
    return std::tuple(stem.size(), stem, file.extension().string());
  });
  return files;
}

void CheckFolders(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders)
    if (!folder.empty() && !fs::is_directory(folder)) throw UsageError(fmt::format("there is no folder {}", folder));
}

std::optional<fs::path> LandmarkFileIn(const fs::path& folder, const std::string& name) {
  for (const char* extension : {".pts", ".txt", ".json"}) {
    const fs::path file = folder / (name + extension);
    if (fs::is_regular_file(file)) return file;
  }
  return std::nullopt;
}

std::vector<systems::Input> ReadPicture(const fs::path& file) {
  std::vector<systems::Input> inputs;
  inputs.emplace_back(render::ReadImage(file));
  return inputs;
}

}  // namespace daumier::portrait
