#include "systems/portrait/train/picture_evaluation.h"

#include "core/error.h"
#include "core/statistics.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "systems/portrait/portrait_measures.h"
#include "systems/portrait/portrait_metrics.h"
#include "systems/portrait/portrait_picture.h"
#include "systems/portrait/train/portrait_baselines.h"
#include "systems/portrait/train/portrait_prediction.h"

#include <algorithm>
#include <map>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

struct LandmarkedPicture {
  std::string name;
  render::Image picture;
  std::vector<float> landmarks;
};

std::vector<LandmarkedPicture> ReadPictures(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".jpg" || extension == ".jpeg" || extension == ".png") {
      // Numbers in their order: 2 before 10.
      const std::string stem = entry.path().stem().string();
      files[std::string(stem.size() < 8 ? 8 - stem.size() : 0, ' ') + stem] = entry.path();
    }
  }
  std::vector<LandmarkedPicture> pictures;
  for (const auto& [key, file] : files) {
    const std::string name = file.stem().string();
    if (auto landmarks = LandmarksInFolder(folder, name))
      pictures.push_back({name, render::ReadImage(file), std::move(*landmarks)});
  }
  DAUMIER_CHECK(!pictures.empty(), "{} holds no picture with a landmark file of its name", folder.string());
  return pictures;
}

struct PictureRow {
  std::string name;
  std::vector<std::pair<std::string, std::array<double, 68>>> errors;  ///< Of each picture.
};

double MeanOf(const std::array<double, 68>& errors, size_t first, size_t last) {
  double sum = 0;
  for (size_t n = first; n < last; ++n) sum += errors[n];
  return sum / double(last - first);
}

}  // namespace

PictureEvaluation EvaluatePictures(const fs::path& folder, const fs::path& detected, PortraitRun& run) {
  const std::vector<LandmarkedPicture> pictures = ReadPictures(folder);
  const PortraitRenderer renderer(run.model);
  const fitting::LandmarkModel landmark_model(run.model);
  const FacePainter painter(run.model);
  const int resolution = run.options.network.resolution;
  PictureRow by_given{kPortraitNetworkRow, {}}, by_detected{"network, detected landmarks", {}},
      fit{std::string(kLandmarkFitRow) + " to the given landmarks", {}},
      mean{std::string(kMeanFaceRow) + " to the given landmarks", {}};
  std::vector<render::SheetCell> cells;
  const auto predict = [&](const render::Image& crop) {
    const std::vector<float> planes = NetworkPicture(crop, resolution);
    const torch::Tensor input = torch::tensor(planes).view({1, 3, resolution, resolution});
    const torch::Tensor x = PredictPortraits(run.network, renderer, input).coefficients.contiguous();
    return std::vector<float>(x.data_ptr<float>(), x.data_ptr<float>() + faces::kNumCoefficients);
  };
  for (const LandmarkedPicture& picture : pictures) {
    const auto measure = [&](PictureRow& row, const PictureMap& map, const std::vector<float>& x) {
      const FacePicture face = painter.Paint(x);
      row.errors.push_back(
          {picture.name, ErrorsOfLandmarks(MapLandmarks(face.landmarks, map.Inverse()), picture.landmarks)});
      return face;
    };
    const PictureMap map = CropOfLandmarks(picture.landmarks, run.options.pictures.size);
    const render::Image warped = WarpPicture(picture.picture, map),
                        crop = warped.channels == 3 ? warped : render::ToRgb(warped);
    const std::vector<float> given = MapLandmarks(picture.landmarks, map);
    const FacePicture face = measure(by_given, map, predict(crop));
    measure(fit, map, FitCoefficients(landmark_model, given, fitting::PortraitFreedom::kPoseAndFace));
    measure(mean, map, FitCoefficients(landmark_model, given, fitting::PortraitFreedom::kPose));
    cells.push_back({crop, picture.name});
    cells.push_back({DotsOver(DotsOver(crop, given, {40, 220, 80}), face.landmarks, {255, 60, 60}),
                     fmt::format("{:.1f} %", 100 * LandmarkError(face.landmarks, given))});
    cells.push_back({OverlayFace(crop, face)});
    if (detected.empty()) continue;
    const auto found = LandmarksInFolder(detected, picture.name);
    const PictureMap found_map = found ? CropOfLandmarks(*found, run.options.pictures.size)
                                       : CropOfWhole(picture.picture.height, picture.picture.width);
    measure(by_detected, found_map, predict(render::ToRgb(WarpPicture(picture.picture, found_map))));
  }
  PictureEvaluation evaluation;
  evaluation.sheet = render::MakeSheet(cells, 6);
  evaluation.table = {"Pictures without known faces",
                      {"predictor", "landmarks, mean %", "median %", "eyes, median %", "jaw, median %", "pictures"},
                      {}};
  evaluation.metrics = {{"rows", Json::array()}, {"pictures", Json::object()}};
  for (const PictureRow* row : {&by_given, &by_detected, &fit, &mean}) {
    if (row->errors.empty()) continue;
    std::vector<double> all, eyes, jaw;
    double sum = 0;
    for (const auto& [name, errors] : row->errors) {
      all.push_back(MeanOf(errors, 0, 68));
      eyes.push_back(MeanOf(errors, 36, 48));
      jaw.push_back(MeanOf(errors, 0, 17));
      sum += all.back();
      evaluation.metrics["pictures"][name][row->name] = all.back();
    }
    const double count = double(all.size());
    evaluation.table.rows.push_back({row->name, fmt::format("{:.2f}", 100 * sum / count),
                                     fmt::format("{:.2f}", 100 * Median(all)),
                                     fmt::format("{:.2f}", 100 * Median(eyes)),
                                     fmt::format("{:.2f}", 100 * Median(jaw)), fmt::format("{}", all.size())});
    evaluation.metrics["rows"].push_back({{"name", row->name},
                                          {"mean", sum / count},
                                          {"median", Median(all)},
                                          {"eyes_median", Median(eyes)},
                                          {"jaw_median", Median(jaw)},
                                          {"num_pictures", all.size()}});
  }
  return evaluation;
}

}  // namespace daumier::portrait
