#include "geometry/polygon_collector.h"

#include "core/error.h"
#include "core/log.h"
#include "geometry/corner_uv.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <string>
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
    ++num_short_;
    mesh_.corners.resize(begin);
    mesh_.uv_corners.resize(begin);
    return;
  }
  mesh_.offsets.push_back(static_cast<int>(mesh_.corners.size()));
}

PolygonMesh PolygonCollector::Finish(Points vertices, TextureCoordinates uv, std::string_view name) && {
  mesh_.vertices = std::move(vertices);
  const auto rows = mesh_.vertices.rowwise();
  const auto num_not_finite = std::count_if(rows.begin(), rows.end(), [](const auto& p) { return !p.allFinite(); });
  if (num_not_finite > 0) DropNotFinite();
  DAUMIER_CHECK(mesh_.num_polygons() > 0,
                "{}: no polygon is left (found {} with fewer than three distinct corners and {} with a corner that is "
                "not finite, expected a surface)",
                name, num_short_, num_not_finite_);
  std::vector<std::string> flaws;
  const auto add = [&](auto count, std::string_view what) {
    if (count > 0) flaws.push_back(fmt::format("{} {}", count, what));
  };
  add(num_repeating_, "polygons repeat a vertex, which is kept once");
  add(num_short_, "polygons with fewer than three corners are skipped");
  add(num_not_finite, "vertices are not finite and are ignored; the others keep their numbers");
  add(num_not_finite_, "polygons use them and are skipped");
  add(num_others_, "points, lines or free-form elements are skipped");
  if (!flaws.empty()) log::Warn("{}: {}", name, fmt::join(flaws, "; "));
  KeepWholeUv(std::move(uv), name);
  return std::move(mesh_);
}

void PolygonCollector::DropNotFinite() {
  std::vector<int> offsets = {0}, corners, uv_corners;
  for (int p = 0; p < mesh_.num_polygons(); ++p) {
    const auto begin = mesh_.offsets[p], end = mesh_.offsets[p + 1];
    const bool is_finite = std::all_of(mesh_.corners.begin() + begin, mesh_.corners.begin() + end,
                                       [&](int v) { return mesh_.vertices.row(v).allFinite(); });
    if (!is_finite) {
      ++num_not_finite_;
      continue;
    }
    corners.insert(corners.end(), mesh_.corners.begin() + begin, mesh_.corners.begin() + end);
    uv_corners.insert(uv_corners.end(), mesh_.uv_corners.begin() + begin, mesh_.uv_corners.begin() + end);
    offsets.push_back(static_cast<int>(corners.size()));
  }
  mesh_.offsets = std::move(offsets);
  mesh_.corners = std::move(corners);
  mesh_.uv_corners = std::move(uv_corners);
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

void RefuseCloud(std::string_view name, int64_t num_vertices) {
  throw Error(
      fmt::format("{}: has points, but no faces: a cloud of points (found {} vertices and no faces, expected faces). "
                  "Mesh it first, "
                  "for example by MeshLab's screened Poisson reconstruction.",
                  name, num_vertices));
}

void CheckFinite(const Points& vertices, std::string_view name) {
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    DAUMIER_CHECK(vertices.row(v).allFinite(), "{}: the position of vertex {} (counted from 0) is not finite", name, v);
  }
}

}  // namespace daumier::geometry
