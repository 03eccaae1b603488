#include "eval/landmark_score.h"

#include "core/error.h"
#include "core/statistics.h"

#include <cmath>
#include <functional>

namespace daumier::eval {
namespace {

constexpr size_t kLandmarksOfRow = 68, kRightEyeCorner = 36, kLeftEyeCorner = 45;
constexpr double kLeastMistake = 0.2, kShareOfRepaired = 1.0 / 3;
/// Pictures of another size are off by more than this factor.
constexpr double kLeastScale = 1.15;

double DistanceIn(const LandmarkRow& a, size_t i, const LandmarkRow& b, size_t j) {
  return std::hypot(a[2 * i] - b[2 * j], a[2 * i + 1] - b[2 * j + 1]);
}

using Repair = std::function<void(double& x, double& y, double size)>;

double MedianAfter(std::span<const LandmarkPair> pairs, const Repair& repair) {
  std::vector<double> errors;
  for (const LandmarkPair& pair : pairs) {
    LandmarkRow moved = pair.predicted;
    for (size_t i = 0; i < kLandmarksOfRow; ++i) repair(moved[2 * i], moved[2 * i + 1], pair.size);
    errors.push_back(NormalisedMeanError(moved, pair.truth));
  }
  return Median(errors);
}

/// The factor about the corner of the picture that brings all predictions nearest to the truth.
double BestFactor(std::span<const LandmarkPair> pairs) {
  double products = 0, squares = 0;
  for (const LandmarkPair& pair : pairs) {
    for (size_t k = 0; k < pair.predicted.size(); ++k) {
      products += pair.predicted[k] * pair.truth[k] / (pair.size * pair.size);
      squares += pair.predicted[k] * pair.predicted[k] / (pair.size * pair.size);
    }
  }
  return squares > 0 ? products / squares : 1;
}

}  // namespace

double NormalisedMeanError(const LandmarkRow& predicted, const LandmarkRow& truth, std::span<const uint8_t> counts) {
  const double unit = DistanceIn(truth, kRightEyeCorner, truth, kLeftEyeCorner);
  DAUMIER_CHECK(unit > 0, "the true outer corners of the eyes (landmarks 36 and 45) coincide");
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < kLandmarksOfRow; ++i) {
    if (!counts.empty() && counts[i] == 0) continue;
    sum += DistanceIn(predicted, i, truth, i) / unit;
    ++count;
  }
  DAUMIER_CHECK(count > 0, "no landmark counts");
  return sum / count;
}

std::optional<std::string> UnitMistake(std::span<const LandmarkPair> pairs) {
  if (pairs.empty()) return std::nullopt;
  const double error = MedianAfter(pairs, [](double&, double&, double) {});
  if (error < kLeastMistake) return std::nullopt;
  const double factor = BestFactor(pairs);
  struct Mistake {
    std::string text;
    Repair repair;
  };
  std::vector<Mistake> mistakes = {
      {"they seem to be shares of the picture, 0 .. 1. Multiply them by the picture's size",
       [](double& x, double& y, double size) { x *= size, y *= size; }},
      {"y seems to point upwards. Write the height of the picture less y",
       [](double&, double& y, double size) { y = size - y; }},
      {"x and y seem to be exchanged. Write x, then y", [](double& x, double& y, double) { std::swap(x, y); }}};
  if (factor > kLeastScale || factor < 1 / kLeastScale)
    mistakes.push_back(
        {fmt::format("they seem to be pixels of a picture of another size. Multiply them by about {:.3g}", factor),
         [=](double& x, double& y, double) { x *= factor, y *= factor; }});
  for (const Mistake& mistake : mistakes)
    if (MedianAfter(pairs, mistake.repair) < kShareOfRepaired * error) return mistake.text;
  return std::nullopt;
}

}  // namespace daumier::eval
