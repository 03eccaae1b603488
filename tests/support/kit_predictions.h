#pragma once
#include "benchmark/kit.h"
#include "core/files.h"
#include "geometry/ply.h"
#include "tests/support/small_kit.h"

#include <fmt/format.h>

#include <functional>

/// Predictions of the small kit, for tests of what reads them.
namespace daumier::testing {

inline void WriteFace(const benchmark::Kit& kit, const std::filesystem::path& file, const geometry::Points& vertices) {
  geometry::WritePly(file, geometry::TriangleMesh{vertices, kit.face_template().triangles});
}

/// For each item of a task and a split the truth of item `which(i)`, changed.
inline void WriteTrueFaces(const benchmark::Kit& kit, benchmark::KitTask task, const std::filesystem::path& folder,
                           const std::function<size_t(size_t)>& which = {},
                           const std::function<geometry::Points(geometry::Points)>& change = {}) {
  MakeDirectory(folder);
  const auto& items = kit.items(task, benchmark::KitSplit::kTest);
  for (size_t i = 0; i < items.size(); ++i) {
    geometry::Points face = kit.TrueFace(task, benchmark::KitSplit::kTest, items[which ? which(i) : i]);
    WriteFace(kit, folder / (items[i].name + ".ply"), change ? change(face) : face);
  }
}

inline std::string LandmarkLines(const eval::LandmarkRow& row) {
  std::string text;
  for (size_t i = 0; i < row.size(); i += 2) text += fmt::format("{} {}\n", row[i], row[i + 1]);
  return text;
}

inline void WriteTrueLandmarks(const benchmark::Kit& kit, const std::filesystem::path& folder,
                               const std::function<void(double& x, double& y)>& change = {}) {
  MakeDirectory(folder);
  for (const benchmark::KitItem& item : kit.items(benchmark::KitTask::kLandmarks, benchmark::KitSplit::kTest)) {
    eval::LandmarkRow row = kit.TrueLandmarks(benchmark::KitSplit::kTest, item);
    for (size_t i = 0; change && i < row.size(); i += 2) change(row[i], row[i + 1]);
    WriteFileAtomically(folder / (item.name + ".pts"), LandmarkLines(row));
  }
}

}  // namespace daumier::testing
