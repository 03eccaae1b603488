#include "systems/portrait/train/picture_evaluation.h"

#include "core/error.h"
#include "core/statistics.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "reports/chosen_faces.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/landmark_files.h"
#include "systems/portrait/picture_files.h"
#include "systems/portrait/portrait_metrics.h"
#include "systems/portrait/portrait_picture.h"
#include "systems/portrait/train/portrait_baselines.h"
#include "systems/portrait/train/portrait_prediction.h"

#include <array>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

struct LandmarkedPicture {
  std::string name;
  render::Image picture;
  std::vector<float> landmarks;
};

std::vector<LandmarkedPicture> ReadPictures(const fs::path& folder) {
  std::vector<LandmarkedPicture> pictures;
  for (const fs::path& file : PicturesIn(folder)) {
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

/// What a sheet shows of a picture: the crop, landmarks (given and predicted), the face over it.
using CellsOfPicture = std::array<render::SheetCell, 3>;

/// The pictures of ChooseFaces by their errors, one a row.
render::Image SheetOfChosen(const std::vector<CellsOfPicture>& cells, const PictureRow& row) {
  std::vector<int> numbers;
  std::vector<double> means;
  for (size_t i = 0; i < row.errors.size(); ++i) {
    numbers.push_back(int(i));
    means.push_back(MeanError(row.errors[i].second));
  }
  std::vector<render::SheetCell> chosen;
  for (const reports::ChosenFace& face : reports::ChooseFaces(numbers, means)) {
    CellsOfPicture of_picture = cells[size_t(face.face)];
    of_picture[0].caption = fmt::format("{}: {}", face.title, of_picture[0].caption);
    chosen.insert(chosen.end(), of_picture.begin(), of_picture.end());
  }
  return render::MakeSheet(chosen, 3);
}

render::Image SheetOfAll(const std::vector<CellsOfPicture>& cells) {
  std::vector<render::SheetCell> all;
  for (const CellsOfPicture& of_picture : cells) all.insert(all.end(), of_picture.begin(), of_picture.end());
  return render::MakeSheet(all, 6);
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
  std::vector<CellsOfPicture> cells;
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
    cells.push_back({{{crop, picture.name},
                      {DotsOver(DotsOver(crop, given, {40, 220, 80}), face.landmarks, {255, 60, 60}),
                       fmt::format("{:.1f} %", 100 * NormalisedError(face.landmarks, given))},
                      {OverlayFace(crop, face)}}});
    if (detected.empty()) continue;
    const auto found = LandmarksInFolder(detected, picture.name);
    const PictureMap found_map = found ? CropOfLandmarks(*found, run.options.pictures.size)
                                       : CropOfWhole(picture.picture.height, picture.picture.width);
    measure(by_detected, found_map, predict(render::ToRgb(WarpPicture(picture.picture, found_map))));
  }
  PictureEvaluation evaluation;
  evaluation.chosen = SheetOfChosen(cells, by_given);
  evaluation.all = SheetOfAll(cells);
  evaluation.table = {"Pictures without known faces",
                      {"predictor", "landmarks, mean %", "median %", "eyes, median %", "jaw, median %", "pictures"},
                      {}};
  evaluation.metrics = {{"rows", Json::array()}, {"pictures", Json::object()}};
  for (const PictureRow* row : {&by_given, &by_detected, &fit, &mean}) {
    if (row->errors.empty()) continue;
    std::vector<double> all, eyes, jaw;
    double sum = 0;
    for (const auto& [name, errors] : row->errors) {
      all.push_back(MeanError(errors));
      eyes.push_back(MeanError(errors, 36, 48));
      jaw.push_back(MeanError(errors, 0, 17));
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
