#include "geometry/polygon_collector.h"

#include "core/error.h"
#include "core/log.h"
#include "geometry/corner_uv.h"

#include <algorithm>
#include <unordered_set>

namespace daumier::geometry {

void PolygonCollector::Add(std::span<const int> corners, std::span<const int> uv_corners) {
  DAUMIER_CHECK(corners.size() == uv_corners.size(), "UV of {} corners, expected {}", uv_corners.size(),
                corners.size());
  const size_t begin = mesh_.corners.size();
  sorted_.assign(corners.begin(), corners.end());
  std::sort(sorted_.begin(), sorted_.end());
  if (std::adjacent_find(sorted_.begin(), sorted_.end()) == sorted_.end()) {
    mesh_.corners.insert(mesh_.corners.end(), corners.begin(), corners.end());
    mesh_.uv_corners.insert(mesh_.uv_corners.end(), uv_corners.begin(), uv_corners.end());
  } else {
    ++num_repeating_;
    std::unordered_set<int> seen;
    for (size_t k = 0; k < corners.size(); ++k) {
      if (!seen.insert(corners[k]).second) continue;
      mesh_.corners.push_back(corners[k]);
      mesh_.uv_corners.push_back(uv_corners[k]);
    }
  }
  if (mesh_.corners.size() - begin < 3) {
    ++num_skipped_;
    mesh_.corners.resize(begin);
    mesh_.uv_corners.resize(begin);
    return;
  }
  mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
}

PolygonMesh PolygonCollector::Finish(Points vertices, TextureCoordinates uv, std::string_view name) && {
  if (mesh_.num_polygons() > 0 && num_repeating_ + num_skipped_ > 0) {
    log::Warn(
        "{}: {} polygons repeat a vertex, which is kept once; {} polygons with fewer than three corners are skipped",
        name, num_repeating_, num_skipped_);
  }
  mesh_.vertices = std::move(vertices);
  KeepWholeUv(std::move(uv), name);
  return std::move(mesh_);
}

void PolygonCollector::KeepWholeUv(TextureCoordinates uv, std::string_view name) {
  const auto& rows = mesh_.uv_corners;
  const auto is_missing = [&](int row) { return row == kNoUv || !uv.row(row).allFinite(); };
  const auto num_missing = uv.rows() == 0 ? rows.size() : size_t(std::count_if(rows.begin(), rows.end(), is_missing));
  if (num_missing == 0) {
    mesh_.uv = std::move(uv);
    if (!mesh_.uv.allFinite()) RemoveUnusedUv(mesh_);
    return;
  }
  if (num_missing < rows.size()) {
    log::Warn("{}: {} of {} corners have no UV (texture coordinate), so the UV of all is dropped", name, num_missing,
              rows.size());
  }
  mesh_.uv_corners.clear();
}

}  // namespace daumier::geometry
