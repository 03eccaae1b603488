#pragma once
#include "benchmark/kit.h"
#include "core/json.h"
#include "reports/report_table.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::benchmark {

/// Errors of one item.
struct ItemScore {
  KitItem item;
  bool is_predicted = true;          ///< Otherwise the mean of the training persons counts.
  std::optional<double> vertex_mm;   ///< Of faces of the kit's topology.
  std::optional<double> surface_mm;  ///< Of faces.
  std::optional<double> nme;         ///< Of landmarks.
};

struct KitScores {
  std::string kit, kit_hash, predictions_hash;
  KitTask task = KitTask::kDrawings;
  KitSplit split = KitSplit::kTest;
  bool has_kit_topology = true;
  std::vector<ItemScore> items;
  std::optional<std::string> frame_mistake;  ///< Of the faces; no error, since scores are free of unit and axes.
  Json method = Json::object();              ///< Of method.json next to the predictions, unchanged.

  int num_missing() const;
};

/// Scores of all items of a split, in the kit's order. Faces: after the similarity that brings a prediction nearest to the truth,
/// vertex_mm is the mean distance of the vertices of the region `face` (eval::ScoreMesh), surface_mm that of the true vertices to the
/// predicted surface (eval::ScoreSurface). 200 mm are the height of the mean face. Landmarks: eval::NormalisedMeanError.
/// An item without a prediction has the score of the mean true face, or of the mean true landmarks, of the split train.
/// @throws Error as PredictionFiles and FaceReaderOfFolder, naming the file of a mirror image; of landmarks with the text of
/// eval::UnitMistake.
KitScores ScorePredictions(const std::filesystem::path& predictions, const Kit& kit, KitTask task, KitSplit split);

/// Mean with the 95 % interval of a bootstrap over persons, median, 90th percentile, of all items and of each group.
reports::ReportTable KitScoreTable(const KitScores& scores);
/// A row to submit: benchmark, kit_hash, task, split, num_items, num_missing, missing, metric, vertex_error_mm,
/// surface_error_mm or nme {mean, low, high, median, p90}, groups, predictions_hash, method, items.
Json KitScoresToJson(const KitScores& scores);

/// The mean true face, or the mean true landmarks, of the split train.
geometry::Points MeanTrainingFace(const Kit& kit, KitTask task);
eval::LandmarkRow MeanTrainingLandmarks(const Kit& kit);

}  // namespace daumier::benchmark
