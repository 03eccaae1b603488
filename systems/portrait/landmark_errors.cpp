#include "systems/portrait/landmark_errors.h"

#include "core/error.h"

#include <cmath>

namespace daumier::portrait {

double InterocularDistance(std::span<const float> points) {
  DAUMIER_CHECK(points.size() == 2 * size_t(kNumLandmarks), "there are {} numbers, expected {}", points.size(),
                2 * kNumLandmarks);
  return std::hypot(double(points[72]) - double(points[90]), double(points[73]) - double(points[91]));
}

std::array<double, kNumLandmarks> ErrorsOfLandmarks(std::span<const float> points, std::span<const float> truth) {
  DAUMIER_CHECK(points.size() == truth.size(), "{} numbers of landmarks, and {} of their truth", points.size(),
                truth.size());
  const double unit = InterocularDistance(truth);
  DAUMIER_CHECK(unit > 0, "the outer eye corners are {}", unit == 0 ? "one point" : "not known");
  std::array<double, kNumLandmarks> errors{};
  for (size_t i = 0; i < errors.size(); ++i)
    errors[i] =
        std::hypot(double(points[2 * i]) - double(truth[2 * i]), double(points[2 * i + 1]) - double(truth[2 * i + 1])) /
        unit;
  return errors;
}

double MeanError(const std::array<double, kNumLandmarks>& errors, int begin, int end) {
  DAUMIER_CHECK(begin >= 0 && begin < end && end <= kNumLandmarks, "landmarks {} to {} of {}", begin, end,
                kNumLandmarks);
  double sum = 0;
  int num_known = 0;
  for (int i = begin; i < end; ++i) {
    if (!std::isfinite(errors[size_t(i)])) continue;
    sum += errors[size_t(i)];
    ++num_known;
  }
  return sum / num_known;
}

double NormalisedError(std::span<const float> points, std::span<const float> truth, int begin, int end) {
  return MeanError(ErrorsOfLandmarks(points, truth), begin, end);
}

void LabelCounts::Add(std::span<const int64_t> predicted, std::span<const int64_t> truth) {
  DAUMIER_CHECK(predicted.size() == truth.size(), "{} and {} labels", predicted.size(), truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] < 0) continue;
    const auto is = size_t(truth[i]), found = size_t(predicted[i]);
    if (is == found) {
      ++both[is];
      ++either[is];
    } else {
      ++either[is];
      ++either[found];
    }
  }
}

double LabelCounts::iou(PictureClass of_class) const {
  const auto k = size_t(of_class);
  return either[k] == 0 ? 1 : double(both[k]) / double(either[k]);
}

double LabelCounts::mean_iou() const {
  double sum = 0;
  for (int k = 0; k < kNumPictureClasses; ++k) sum += iou(PictureClass(k));
  return sum / kNumPictureClasses;
}

}  // namespace daumier::portrait
