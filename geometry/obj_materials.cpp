#include "geometry/obj_materials.h"

#include "core/files.h"
#include "core/log.h"

#include <algorithm>
#include <locale>
#include <map>
#include <sstream>
#include <string_view>

namespace daumier::geometry {
namespace {

namespace fs = std::filesystem;

/// The keyword of a line, and what follows without blanks at its ends.
struct KeywordLine {
  std::string_view keyword, rest;
};

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const size_t begin = text.find_first_not_of(kBlanks);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

template <class Visit>
void ForEachKeyword(std::string_view text, const Visit& visit) {
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = Trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const size_t space = std::min(line.find_first_of(" \t"), line.size());
    visit(KeywordLine{line.substr(0, space), Trimmed(line.substr(space))});
  }
}

std::vector<float> NumbersOf(std::string_view text) {
  std::vector<float> numbers;
  std::istringstream stream{std::string(text)};
  stream.imbue(std::locale::classic());
  for (float number = 0; stream >> number;) numbers.push_back(number);
  return numbers;
}

/// The file behind options such as `-bm 0.5`: all behind the last of them and its numbers.
std::string PictureName(std::string_view text) {
  while (text.starts_with('-')) {
    const size_t space = text.find_first_of(" \t");
    if (space == std::string_view::npos) return "";
    text = Trimmed(text.substr(space));
    for (;;) {  // Numbers and words of the option.
      const size_t end = std::min(text.find_first_of(" \t"), text.size());
      const std::string_view word = text.substr(0, end);
      const bool is_value = word == "on" || word == "off" || NumbersOf(word).size() == 1;
      if (!is_value || end == text.size()) break;
      text = Trimmed(text.substr(end));
    }
  }
  std::string name(text);
  std::ranges::replace(name, '\\', '/');
  return name;
}

void ReadLibrary(const fs::path& file, std::map<std::string, UsedMaterial, std::less<>>& known) {
  UsedMaterial* material = nullptr;
  ForEachKeyword(ReadFile(file), [&](const KeywordLine& line) {
    if (line.keyword == "newmtl") {
      material = &known.emplace(line.rest, UsedMaterial{std::string(line.rest)}).first->second;
      return;
    }
    if (material == nullptr) return;
    const std::vector<float> numbers = NumbersOf(line.rest);
    const auto unit = [](float value) { return std::clamp(value, 0.0f, 1.0f); };
    if (line.keyword == "Kd" && numbers.size() >= 3) {
      material->diffuse = {unit(numbers[0]), unit(numbers[1]), unit(numbers[2])};
    } else if (line.keyword == "d" && !numbers.empty()) {
      material->opacity = unit(numbers[0]);
    } else if (line.keyword == "Tr" && !numbers.empty()) {
      material->opacity = 1 - unit(numbers[0]);
    } else if (line.keyword == "map_Kd") {
      const std::string name = PictureName(line.rest);
      if (!name.empty()) material->picture = fs::path(name).is_absolute() ? fs::path(name) : file.parent_path() / name;
    }
  });
}

}  // namespace

UsedMaterials ReadUsedMaterials(const fs::path& obj) {
  UsedMaterials used;
  std::map<std::string, UsedMaterial, std::less<>> known;
  std::map<std::string, int, std::less<>> rows;
  int current = -1;
  const std::string text = ReadFile(obj);
  ForEachKeyword(text, [&](const KeywordLine& line) {
    if (line.keyword == "f" || line.keyword == "fo") {
      used.of_polygons.push_back(current);
    } else if (line.keyword == "mtllib") {
      const fs::path library = obj.parent_path() / std::string(line.rest);
      if (fs::exists(library)) {
        ReadLibrary(library, known);
      } else {
        log::Warn("{}: there is no {}: its materials are grey", obj.string(), library.string());
      }
    } else if (line.keyword == "usemtl") {
      const auto [place, is_new] = rows.emplace(line.rest, int(used.materials.size()));
      if (is_new) used.materials.push_back({std::string(line.rest)});
      current = place->second;
    }
  });
  for (UsedMaterial& material : used.materials)
    if (const auto found = known.find(material.name); found != known.end()) material = found->second;
  return used;
}

}  // namespace daumier::geometry
