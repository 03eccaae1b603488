#include "benchmark/predictions.h"

#include "core/error.h"
#include "core/files.h"
#include "core/options.h"
#include "faces/import/mesh_folder.h"
#include "faces/landmark_order.h"
#include "geometry/triangulate.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace daumier::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOwnLandmarks = "landmarks.txt";
constexpr const char* kOfAnotherTopology =
    "For faces of another topology write landmarks.txt next to them: 68 lines, a vertex each, iBUG order";
/// A finished head lacks those beyond its neck.
constexpr double kLeastShareOfTriangles = 0.8;

std::array<int, 3> SortedCorners(const geometry::Triangles& triangles, Eigen::Index f) {
  std::array<int, 3> corners = {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
  std::ranges::sort(corners);
  return corners;
}

/// The share of `expected` that is among `found`, in any order of corners.
double ShareOfTriangles(const geometry::Triangles& expected, const geometry::Triangles& found) {
  std::vector<std::array<int, 3>> all;
  for (Eigen::Index f = 0; f < found.rows(); ++f) all.push_back(SortedCorners(found, f));
  std::ranges::sort(all);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < expected.rows(); ++f)
    count += std::ranges::binary_search(all, SortedCorners(expected, f)) ? 1 : 0;
  return double(count) / double(std::max<Eigen::Index>(expected.rows(), 1));
}

const std::vector<std::string>& ExtensionsOf(KitTask task) {
  static const std::vector<std::string> kMeshes = {".ply", ".obj"}, kPoints = {".pts", ".txt", ".csv", ".json"};
  return task == KitTask::kLandmarks ? kPoints : kMeshes;
}

std::string LowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// Where a name is expected that is none of the split's: the split that has it, or the nearest name.
std::string HintFor(const std::string& name, const Kit& kit, KitTask task, KitSplit split) {
  for (size_t other = 0; other < kKitSplitNames.size(); ++other)
    for (const KitItem& item : kit.items(task, KitSplit(other)))
      if (item.name == name)
        return fmt::format("It is of the split {}: --split {}", kKitSplitNames[other], kKitSplitNames[other]);
  std::set<std::string> names;
  for (const KitItem& item : kit.items(task, split)) names.insert(item.name);
  const std::string nearest = NearestWord(name, names);
  return fmt::format("Name it as its input{}",
                     nearest.empty() ? fmt::format(", for example {}", *names.begin()) : fmt::format(": {}?", nearest));
}

}  // namespace

std::map<std::string, fs::path> PredictionFiles(const fs::path& folder, const Kit& kit, KitTask task, KitSplit split) {
  DAUMIER_CHECK(fs::is_directory(folder), "{}: no such folder (expected one of predictions)", folder.string());
  const std::vector<std::string>& extensions = ExtensionsOf(task);
  std::set<std::string> known;
  for (const KitItem& item : kit.items(task, split)) known.insert(item.name);
  DAUMIER_CHECK(!known.empty(), "{} has no item of the task {} in the split {}", kit.directory().string(),
                kKitTaskNames[size_t(task)], kKitSplitNames[size_t(split)]);
  std::map<std::string, std::pair<size_t, fs::path>> best;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const auto found = std::ranges::find(extensions, LowerCase(file.extension().string()));
    if (entry.is_directory() || found == extensions.end() || IsSystemFile(file.filename())) continue;
    const std::string name = file.stem().string(), whole = file.filename().string();
    if (whole == kOwnLandmarks || whole == "manifest.json" || whole == "method.json") continue;
    const auto rank = size_t(found - extensions.begin());
    const auto [place, is_new] = best.emplace(name, std::pair(rank, file));
    if (!is_new && rank < place->second.first) place->second = {rank, file};
  }
  DAUMIER_CHECK(!best.empty(), "{} has no prediction (expected NAME{}, for example {}{})", folder.string(),
                fmt::join(extensions, ", NAME"), *known.begin(), extensions.front());
  std::map<std::string, fs::path> files;
  for (const auto& [name, place] : best) {
    DAUMIER_CHECK(known.contains(name), "{}: no item of the split {} has this name. {}", place.second.string(),
                  kKitSplitNames[size_t(split)], HintFor(name, kit, task, split));
    files[name] = place.second;
  }
  return files;
}

FaceReaderOfFolder::FaceReaderOfFolder(const fs::path& folder, const Kit& kit)
    : template_(kit.face_template()), landmarks_(kit.face_template().annotation.landmarks) {
  const fs::path own = folder / kOwnLandmarks;
  if (!fs::exists(own)) return;
  has_own_topology_ = true;
  const faces::OrderedLandmarks landmarks = faces::OrderLandmarks(faces::ReadMarkedPoints(own));
  DAUMIER_CHECK(landmarks.dimension == 1, "{}: expected 68 lines of a vertex each, from 0 (-1: there is none)",
                own.string());
  for (size_t i = 0; i < landmarks.points.size(); ++i)
    landmarks_[i] = landmarks.points[i] ? int(landmarks.points[i]->x()) : -1;
}

PredictedFace FaceReaderOfFolder::Read(const fs::path& file) const {
  const geometry::PolygonMesh polygons = faces::ReadMesh(file);
  for (Eigen::Index i = 0; i < polygons.vertices.rows(); ++i)
    DAUMIER_CHECK(polygons.vertices.row(i).allFinite(), "{}: vertex {} is no finite number", file.string(), i);
  PredictedFace face{geometry::TriangulateMesh(polygons), !has_own_topology_};
  if (has_own_topology_) {
    for (const int vertex : landmarks_)
      DAUMIER_CHECK(vertex < polygons.vertices.rows(), "{} has {} vertices, but {} names vertex {}", file.string(),
                    polygons.vertices.rows(), kOwnLandmarks, vertex);
    return face;
  }
  DAUMIER_CHECK(polygons.vertices.rows() >= template_.num_vertices(),
                "{} has {} vertices (expected the {} of the kit's template.obj, and perhaps more behind them). {}",
                file.string(), polygons.vertices.rows(), template_.num_vertices(), kOfAnotherTopology);
  const double share = ShareOfTriangles(template_.triangles, face.mesh.triangles);
  DAUMIER_CHECK(share >= kLeastShareOfTriangles,
                "{}: {:.0f} % of the triangles of the kit's template.obj are in it (expected {:.0f} % or more): its "
                "vertices are numbered otherwise. Keep the order of vertices where you write it. {}",
                file.string(), 100 * share, 100 * kLeastShareOfTriangles, kOfAnotherTopology);
  return face;
}

std::string PredictionsHash(const std::map<std::string, fs::path>& files) {
  std::string text;
  for (const auto& [name, file] : files) text += name + " " + Sha256OfFile(file) + "\n";
  return Sha256(text);
}

}  // namespace daumier::benchmark
