#include "studio/uploads.h"

#include "core/error.h"
#include "core/files.h"
#include "render/image.h"
#include "studio/api.h"
#include "systems/picture_content.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

constexpr char kFolderPrefix = 'u';

fs::path Emptied(const fs::path& folder) {
  std::error_code failure;
  fs::remove_all(folder, failure);
  return folder;
}

/// "picture" where its bytes are one.
std::string KindOf(const fs::path& file, std::string_view bytes) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (ending == ".svg" || ending == ".svgz") return "drawing";
  if (ending == ".obj" || ending == ".ply") return "mesh";
  if (ending == ".csv" || ending == ".bvh") return "clip";
  if (ending == ".json") {
    const Json json = TryParseJson(bytes).value_or(Json());
    return json.is_object() && json.contains("sheet") ? "session" : "clip";
  }
  constexpr std::array kPictures = {".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff", ".gif"};
  return std::ranges::count(kPictures, ending) > 0 ? "picture" : "other";
}

/// Errors name the file and not the folder.
render::Image ReadPicture(const fs::path& file) {
  try {
    return render::ReadImage(file);
  } catch (const Error& error) {
    throw UsageError(WithoutFolder(error.what(), file.parent_path()));
  }
}

}  // namespace

std::string SafeFileName(std::string_view name) {
  constexpr size_t kMost = 80;
  name = name.substr(name.find_last_of("/\\") + 1);
  std::string safe;
  for (const unsigned char c : name) safe += std::isalnum(c) || c == '.' || c == '_' || c == '-' ? char(c) : '_';
  if (safe.empty() || !std::isalnum(static_cast<unsigned char>(safe.front()))) safe.insert(0, "file");
  if (safe.size() <= kMost) return safe;
  const size_t dot = safe.find_last_of('.');  // The ending says what the file is.
  const std::string ending = dot == std::string::npos || safe.size() - dot > 8 ? "" : safe.substr(dot);
  return safe.substr(0, kMost - ending.size()) + ending;
}

Uploads::Uploads(const fs::path& folder) : folders_(Emptied(folder), kFolderPrefix) {}

Json Uploads::Add(std::string_view given_name, std::string_view bytes) {
  if (bytes.empty()) throw UsageError("the file is empty");
  const std::string name = SafeFileName(given_name);
  fs::path file;
  std::string id;
  {
    const std::scoped_lock lock(mutex_);
    id = folders_.Add();
    file = folders_.Of(id) / name;
    const std::vector<std::string> all = folders_.Names();
    for (size_t i = 0; i + kMostKept < all.size(); ++i) folders_.Remove(all[i]);
  }
  WriteFileAtomically(file, bytes);
  Json json = {{"id", id}, {"name", name}, {"kind", KindOf(file, bytes)}, {"looks_like", nullptr}};
  if (json["kind"] == "drawing") json["looks_like"] = "drawing";
  if (json["kind"] != "picture") return json;
  const render::Image picture = ReadPicture(file);
  json["looks_like"] = systems::LineDrawings().suits(picture) > 0 ? "drawing" : "portrait";
  json["size"] = {picture.width, picture.height};
  return json;
}

fs::path Uploads::FileOf(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  for (const fs::directory_entry& entry : fs::directory_iterator(folders_.Of(id)))
    if (!entry.path().filename().string().starts_with('.')) return entry.path();
  throw NotFound("the file is not there any more; drop it again");
}

}  // namespace daumier::studio
