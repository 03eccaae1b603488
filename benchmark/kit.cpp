#include "benchmark/kit.h"

#include "core/error.h"
#include "core/npy.h"
#include "core/options.h"
#include "faces/face_database.h"
#include "faces/landmark_order.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace daumier::benchmark {
namespace {

namespace fs = std::filesystem;

template <size_t N>
size_t IndexOfName(const std::array<std::string_view, N>& names, const std::string& name, const char* what) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return size_t(found - names.begin());
  throw UsageError(fmt::format("there is no {} '{}' (expected {})", what, name, fmt::join(names, ", ")));
}

std::string_view FolderOf(KitTask task) {
  return kKitTaskNames[size_t(task == KitTask::kLandmarks ? KitTask::kPortraits : task)];
}

std::vector<KitItem> ItemsFromJson(const Json& json) {
  std::vector<KitItem> items;
  for (const Json& item : json)
    items.push_back({item.at("name").get<std::string>(), item.at("person").get<int>(),
                     item.at("truth").get<std::string>(), item.at("group").get<std::string>()});
  return items;
}

}  // namespace

KitTask KitTaskNamed(const std::string& name) {
  return static_cast<KitTask>(IndexOfName(kKitTaskNames, name, "task"));
}

KitSplit KitSplitNamed(const std::string& name) {
  return static_cast<KitSplit>(IndexOfName(kKitSplitNames, name, "split"));
}

std::string InputFolder(KitTask task, KitSplit split) {
  return fmt::format("inputs/{}/{}", kKitSplitNames[size_t(split)], FolderOf(task));
}

std::string TruthFolder(KitTask task, KitSplit split) {
  return fmt::format("truth/{}/{}", kKitSplitNames[size_t(split)], FolderOf(task));
}

Kit::Kit(fs::path directory) : directory_(std::move(directory)) {
  manifest_ = ReadManifest(directory_, kBenchmarkKind);
  const std::string file = (directory_ / "manifest.json").string();
  try {
    const int version = manifest_.details.at("version").get<int>();
    DAUMIER_CHECK(version == kBenchmarkVersion,
                  "{}: version {} of the kit's files (expected {}). Use the program that made it", file, version,
                  kBenchmarkVersion);
    portrait_size_ = manifest_.details.at("portrait_size").get<double>();
    for (size_t task = 0; task < items_.size(); ++task)
      for (size_t split = 0; split < items_[task].size(); ++split)
        items_[task][split] = ItemsFromJson(
            manifest_.details.at("items").at(std::string(kKitTaskNames[task])).at(std::string(kKitSplitNames[split])));
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} is malformed: {}", file, TextOf(error)));
  }
  face_template_ = faces::ReadFaceTemplate(directory_);
}

fs::path Kit::InputFile(KitTask task, KitSplit split, const KitItem& item) const {
  return directory_ / InputFolder(task, split) / (item.name + (task == KitTask::kCaricatures ? ".pts" : ".png"));
}

geometry::Points Kit::TrueFace(KitTask task, KitSplit split, const KitItem& item) const {
  const fs::path file = directory_ / TruthFolder(task, split) / (item.truth + ".npy");
  const NpyTable table = ReadNpy(file);
  DAUMIER_CHECK(table.rows == face_template_.num_vertices() && table.columns == 3,
                "{}: {} x {} numbers (expected {} x 3). Make the kit again", file.string(), table.rows, table.columns,
                face_template_.num_vertices());
  return Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(table.numbers.data(), table.rows, 3)
      .cast<double>();
}

eval::LandmarkRow Kit::TrueLandmarks(KitSplit split, const KitItem& item) const {
  return ReadLandmarkRow(directory_ / TruthFolder(KitTask::kLandmarks, split) / (item.truth + ".pts"));
}

eval::LandmarkRow ReadLandmarkRow(const fs::path& file) {
  const faces::OrderedLandmarks landmarks = faces::OrderLandmarks(faces::ReadMarkedPoints(file));
  DAUMIER_CHECK(landmarks.dimension == 2, "{}: its points have {} numbers (expected x and y, pixels of the picture)",
                file.string(), landmarks.dimension);
  eval::LandmarkRow row;
  for (size_t i = 0; i < landmarks.points.size(); ++i) {
    DAUMIER_CHECK(landmarks.points[i].has_value() && landmarks.points[i]->allFinite(),
                  "{}: landmark {} is absent or no finite number (expected all 68)", file.string(), i);
    row[2 * i] = landmarks.points[i]->x();
    row[2 * i + 1] = landmarks.points[i]->y();
  }
  return row;
}

std::string PtsText(const eval::LandmarkRow& row) {
  std::string text = "version: 1\nn_points: 68\n{\n";
  for (size_t i = 0; i < row.size(); i += 2) text += fmt::format("{:.3f} {:.3f}\n", row[i], row[i + 1]);
  return text + "}\n";
}

Json ItemsToJson(const std::vector<KitItem>& items) {
  Json json = Json::array();
  for (const KitItem& item : items)
    json.push_back({{"name", item.name}, {"person", item.person}, {"truth", item.truth}, {"group", item.group}});
  return json;
}

}  // namespace daumier::benchmark
