#include "gltf/triangle_runs.h"

#include <algorithm>
#include <string>

namespace daumier::gltf {

Json TriangleRuns(const std::vector<faces::HeadMaterial>& materials, const std::vector<int>& neck_cap) {
  Json runs = {{"materials", Json::array()}};
  for (size_t f = 0; f < materials.size();) {
    size_t end = f;
    while (end < materials.size() && materials[end] == materials[f]) ++end;
    const auto named = std::ranges::find(faces::kHeadMaterials, materials[f], &faces::NamedHeadMaterial::material);
    runs["materials"].push_back({named->name, end - f});
    f = end;
  }
  for (size_t i = 0; i < neck_cap.size();) {
    size_t end = i;
    while (end < neck_cap.size() && neck_cap[end] - neck_cap[i] == int(end - i)) ++end;
    runs["neckCap"].push_back({neck_cap[i], end - i});
    i = end;
  }
  return runs;
}

std::optional<ReadTriangleRuns> ParseTriangleRuns(const Json& runs, int64_t num_triangles) {
  ReadTriangleRuns read;
  try {
    for (const Json& run : runs.at("materials")) {
      const auto named =
          std::ranges::find(faces::kHeadMaterials, run.at(0).get<std::string>(), &faces::NamedHeadMaterial::name);
      const auto count = run.at(1).get<int64_t>();
      if (named == faces::kHeadMaterials.end() || count < 0 || count > num_triangles - std::ssize(read.materials))
        return std::nullopt;
      read.materials.insert(read.materials.end(), size_t(count), named->material);
    }
    if (std::ssize(read.materials) != num_triangles) return std::nullopt;
    if (!runs.contains("neckCap")) return read;
    for (const Json& run : runs.at("neckCap")) {
      const auto first = run.at(0).get<int64_t>(), count = run.at(1).get<int64_t>();
      const int64_t least = read.neck_cap.empty() ? 0 : int64_t(read.neck_cap.back()) + 1;
      if (first < least || count < 0 || first > num_triangles || count > num_triangles - first) return std::nullopt;
      for (int64_t f = first; f < first + count; ++f) read.neck_cap.push_back(int(f));
    }
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return read;
}

}  // namespace daumier::gltf
