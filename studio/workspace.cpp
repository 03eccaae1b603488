#include "studio/workspace.h"

#include "core/error.h"
#include "core/files.h"
#include "studio/api.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

namespace daumier::studio {

namespace fs = std::filesystem;

NumberedFolders::NumberedFolders(fs::path folder, char prefix) : folder_(std::move(folder)), prefix_(prefix) {
  MakeDirectory(folder_);
}

bool NumberedFolders::IsName(std::string_view name) const {
  constexpr size_t kMostDigits = 9;
  return name.size() >= 6 && name.size() <= 2 + kMostDigits && name[0] == prefix_ && name[1] == '-' &&
         std::ranges::all_of(name.substr(2), [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<std::string> NumberedFolders::Names() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    std::string name = entry.path().filename().string();
    if (entry.is_directory() && IsName(name)) names.push_back(std::move(name));
  }
  std::ranges::sort(names, {}, [](const std::string& name) { return std::pair(name.size(), name); });
  return names;
}

std::string NumberedFolders::Add() {
  const std::vector<std::string> names = Names();
  int greatest = 0;
  if (!names.empty()) std::from_chars(names.back().data() + 2, names.back().data() + names.back().size(), greatest);
  last_ = std::max(last_, greatest) + 1;
  std::string name = fmt::format("{}-{:04}", prefix_, last_);
  MakeDirectory(folder_ / name);
  return name;
}

bool NumberedFolders::Has(std::string_view name) const {
  return IsName(name) && fs::is_directory(folder_ / name);
}

fs::path NumberedFolders::Of(std::string_view name) const {
  if (!Has(name)) throw NotFound(fmt::format("there is no '{}'", name.substr(0, 40)));
  return folder_ / name;
}

void NumberedFolders::Remove(std::string_view name) {
  std::error_code failure;
  fs::remove_all(Of(name), failure);
  DAUMIER_CHECK(!failure, "{}: {}", (folder_ / name).string(), failure.message());
}

std::string KeptName(std::string_view name, std::string_view otherwise) {
  constexpr size_t kMost = 80;
  std::string kept;
  size_t count = 0;
  for (size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (c == '\xC2' && i + 1 < name.size() && static_cast<unsigned char>(name[i + 1]) < 0xA0) {
      ++i;  // Control characters from U+0080 to U+009F.
      continue;
    }
    const bool begins_character = (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    if (begins_character && ++count > kMost) break;
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) kept += c;
  }
  const size_t first = kept.find_first_not_of(' ');
  if (first == std::string::npos) return std::string(otherwise);
  return kept.substr(first, kept.find_last_not_of(' ') + 1 - first);
}

}  // namespace daumier::studio
