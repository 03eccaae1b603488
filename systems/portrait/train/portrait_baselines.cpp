#include "systems/portrait/train/portrait_baselines.h"

#include "core/error.h"
#include "core/stopwatch.h"
#include "faces/landmark_order.h"

namespace daumier::portrait {

std::optional<std::vector<float>> LandmarksInFolder(const std::filesystem::path& folder, const std::string& name) {
  for (const char* extension : {".txt", ".pts", ".json"}) {
    const std::filesystem::path file = folder / (name + extension);
    if (!std::filesystem::exists(file)) continue;
    const faces::OrderedLandmarks ordered = faces::OrderLandmarks(faces::ReadMarkedPoints(file));
    DAUMIER_CHECK(ordered.dimension == 2, "{}: landmarks have {} numbers each, expected 2: pixels", file.string(),
                  ordered.dimension);
    std::vector<float> landmarks;
    for (size_t n = 0; n < ordered.points.size(); ++n) {
      DAUMIER_CHECK(ordered.points[n].has_value(), "{}: landmark {} is absent", file.string(), n);
      landmarks.push_back(float(ordered.points[n]->x()));
      landmarks.push_back(float(ordered.points[n]->y()));
    }
    return landmarks;
  }
  return std::nullopt;
}

std::vector<float> FitCoefficients(const fitting::LandmarkModel& model, std::span<const float> landmarks,
                                   fitting::PortraitFreedom freedom) {
  DAUMIER_CHECK(landmarks.size() == 136, "{} numbers of landmarks, expected 136", landmarks.size());
  const fitting::PicturePoints points =
      Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>>(landmarks.data(), 68, 2)
          .cast<double>();
  const fitting::PortraitFit fit = fitting::FitPortrait(model, points, Eigen::VectorXd::Ones(68), {.freedom = freedom});
  return {fit.coefficients.begin(), fit.coefficients.end()};
}

PortraitGuesses FitAll(const faces::MorphableModel& model, const std::vector<std::vector<float>>& landmarks,
                       fitting::PortraitFreedom freedom) {
  const fitting::LandmarkModel landmark_model(model);
  PortraitGuesses guesses;
  const Stopwatch stopwatch;
  for (const std::vector<float>& of_portrait : landmarks)
    guesses.coefficients.push_back(FitCoefficients(landmark_model, of_portrait, freedom));
  guesses.ms = 1000 * stopwatch.seconds() / double(landmarks.size());
  return guesses;
}

}  // namespace daumier::portrait
