#include "systems/portrait/train/portrait_baselines.h"

#include "core/error.h"
#include "core/stopwatch.h"

namespace daumier::portrait {

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
