#include "systems/portrait/landmark_errors.h"

#include "core/error.h"

#include <cmath>

namespace daumier::portrait {
namespace {

double Distance(std::span<const float> a, std::span<const float> b, size_t i) {
  return std::hypot(double(a[2 * i]) - double(b[2 * i]), double(a[2 * i + 1]) - double(b[2 * i + 1]));
}

}  // namespace

double InterocularDistance(std::span<const float> points) {
  DAUMIER_CHECK(points.size() == 2 * size_t(kNumLandmarks), "there are {} numbers, expected {}", points.size(),
                2 * kNumLandmarks);
  return std::hypot(double(points[72]) - double(points[90]), double(points[73]) - double(points[91]));
}

double NormalisedError(std::span<const float> points, std::span<const float> truth, int begin, int end) {
  DAUMIER_CHECK(points.size() == truth.size() && begin >= 0 && begin < end && end <= kNumLandmarks,
                "landmarks {} to {} of {} and {} numbers", begin, end, points.size(), truth.size());
  const double unit = InterocularDistance(truth);
  DAUMIER_CHECK(unit > 0, "the outer eye corners are one point");
  double sum = 0;
  for (int i = begin; i < end; ++i) sum += Distance(points, truth, size_t(i));
  return sum / (end - begin) / unit;
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

double LabelCounts::iou(FaceClass of_class) const {
  const auto k = size_t(of_class);
  return either[k] == 0 ? 1 : double(both[k]) / double(either[k]);
}

double LabelCounts::mean_iou() const {
  double sum = 0;
  for (int k = 0; k < kNumFaceClasses; ++k) sum += iou(FaceClass(k));
  return sum / kNumFaceClasses;
}

}  // namespace daumier::portrait
