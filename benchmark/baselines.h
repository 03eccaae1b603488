#pragma once
#include "benchmark/kit.h"
#include "core/task.h"
#include "eval/face_rows.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

/// What a method has to be better than. Each is fitted on the split train; options are chosen on validation.
namespace daumier::benchmark {

enum class Baseline {
  kMean,        ///< The mean true face, or the mean true landmarks.
  kNearest,     ///< The truth of the training item of the nearest features.
  kRegression,  ///< DualRegression on the features; lambda by the least validation error.
  kShapeModel,  ///< Of caricatures: ShapeModel fitted to the landmarks by fitting::FitCodeToLandmarks; the number of components and
                ///< the deviation of landmarks by the least validation error.
  kShapeModel3d,  ///< The same, FitShapeToPlaces of the landmarks in space (NAME.xyz).
  kMeanPlaced,  ///< Of landmarks: the mean, moved by the similarity that brings it nearest to the truth, which it reads: a bound.
};
inline constexpr std::array<std::string_view, 6> kBaselineNames = {"mean",        "nearest",        "regression",
                                                                   "shape_model", "shape_model_3d", "mean_placed"};
/// @throws UsageError naming all.
Baseline BaselineNamed(const std::string& name);

/// What baselines read of an input: of a drawing the ink of its bounding box in 40 x 40 cells, of a portrait the grey values of 40 x
/// 40 cells, of a caricature its landmarks after the similarity to those of the template seen from the front. Nothing of the truth.
eval::FaceRows FeaturesOf(const Kit& kit, KitTask task, KitSplit split);

/// Writes predictions of all items of a split: NAME.ply or NAME.pts, and method.json with what was chosen.
/// @throws UsageError if the folder has other files, or of a baseline that another task has.
void WriteBaseline(const Kit& kit, KitTask task, KitSplit split, Baseline baseline, const std::filesystem::path& out,
                   const Task& progress = {});

}  // namespace daumier::benchmark
