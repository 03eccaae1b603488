#include "datasets/build/landmark_file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>

namespace daumier::datasets {
namespace {

constexpr int kNumLandmarks = 68;

void AppendNumbers(const Json& json, std::vector<double>& numbers) {
  if (json.is_array()) {
    for (const Json& entry : json) AppendNumbers(entry, numbers);
  } else if (json.is_null()) {  // JSON has no NaN.
    numbers.push_back(std::numeric_limits<double>::quiet_NaN());
  } else {
    numbers.push_back(json.get<double>());
  }
}

std::vector<double> ParseWords(std::string_view text, const std::string& name) {
  std::vector<double> numbers;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with('#')) continue;
    constexpr std::string_view kBlank = " \t\r";
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
      if (line.empty()) break;
      const std::string_view word = line.substr(0, line.find_first_of(kBlank));
      double number = 0;
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      DAUMIER_CHECK(error == std::errc() && stop == word.data() + word.size(), "{}: '{}' is not a number", name, word);
      numbers.push_back(number);
      line.remove_prefix(word.size());
    }
  }
  return numbers;
}

/// All numbers of a file of words or of a JSON list.
std::vector<double> ReadNumbers(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  if (text.find_first_not_of(" \t\r\n") == text.find('[') && text.find('[') != std::string::npos) {
    std::vector<double> numbers;
    try {
      AppendNumbers(ParseJson(text, path.string()), numbers);
    } catch (const Json::exception& error) {
      throw Error(fmt::format("{}: malformed: {}", path.string(), error.what()));
    }
    return numbers;
  }
  return ParseWords(text, path.string());
}

std::vector<int> ToIntegers(const std::vector<double>& numbers, const std::filesystem::path& path) {
  std::vector<int> integers;
  for (const double number : numbers) {
    DAUMIER_CHECK(number == std::floor(number) && std::abs(number) < 1e9, "{}: {} is no vertex", path.string(), number);
    integers.push_back(static_cast<int>(number));
  }
  return integers;
}

}  // namespace

LandmarkFile::LandmarkFile(const std::filesystem::path& path, const std::filesystem::path& vertex_map) : path_(path) {
  const std::vector<double> numbers = ReadNumbers(path);
  DAUMIER_CHECK(numbers.size() == kNumLandmarks || numbers.size() == 3 * kNumLandmarks,
                "{}: {} numbers; expected 68 vertices, or x y z of 68 landmarks", path.string(), numbers.size());
  if (numbers.size() == 3 * kNumLandmarks) {
    for (int l = 0; l < kNumLandmarks; ++l) {
      const geometry::Vector3 place(numbers[3 * l], numbers[3 * l + 1], numbers[3 * l + 2]);
      if (place.allFinite()) places_[l] = place;
    }
    return;
  }
  vertices_ = ToIntegers(numbers, path);
  if (vertex_map.empty()) return;
  const std::vector<int> names = ToIntegers(ReadNumbers(vertex_map), vertex_map);
  std::map<int, int> vertex_of_name;
  for (size_t v = 0; v < names.size(); ++v) vertex_of_name.try_emplace(names[v], static_cast<int>(v));
  for (int& vertex : vertices_) {
    const auto found = vertex_of_name.find(vertex);
    vertex = found == vertex_of_name.end() ? -1 : found->second;
  }
}

MeshLandmarks LandmarkFile::On(const geometry::Points& vertices) const {
  if (vertices_.empty()) return places_;
  MeshLandmarks landmarks;
  for (int l = 0; l < kNumLandmarks; ++l) {
    if (vertices_[l] == -1) continue;
    DAUMIER_CHECK(vertices_[l] >= 0 && vertices_[l] < vertices.rows(),
                  "{}: landmark {} is vertex {}, but the mesh has {}; is a vertex map needed?", path_.string(), l,
                  vertices_[l], vertices.rows());
    landmarks[l] = vertices.row(vertices_[l]).transpose();
  }
  return landmarks;
}

}  // namespace daumier::datasets
