#include "systems/sketch/parser_errors.h"

#include <cmath>
#include <numeric>

namespace daumier::sketch {
namespace {

using enum faces::FacePoint;

constexpr double kOuterOverCentres = 1.369;

std::optional<double> Distance(const std::optional<std::array<double, 2>>& a,
                               const std::optional<std::array<double, 2>>& b) {
  if (!a || !b) return std::nullopt;
  return std::hypot((*a)[0] - (*b)[0], (*a)[1] - (*b)[1]);
}

/// Whether the centre of that eye counts: its corners are not shown.
bool Counts(const DrawnPoints& truth, faces::FacePoint point) {
  if (point == kEyeRightCentre) return !truth[size_t(kEyeRightOuter)] && !truth[size_t(kEyeRightInner)];
  if (point == kEyeLeftCentre) return !truth[size_t(kEyeLeftOuter)] && !truth[size_t(kEyeLeftInner)];
  return true;
}

}  // namespace

const std::vector<PointPart>& PointParts() {
  static const std::vector<PointPart> parts = {
      {"eyes",
       {kEyeRightOuter, kEyeRightInner, kEyeRightTop, kEyeRightBottom, kEyeLeftInner, kEyeLeftOuter, kEyeLeftTop,
        kEyeLeftBottom, kEyeRightCentre, kEyeLeftCentre}},
      {"brows", {kBrowRightOuter, kBrowRightInner, kBrowLeftInner, kBrowLeftOuter}},
      {"nose", {kNoseBottom, kNoseWingRight, kNoseWingLeft}},
      {"mouth", {kMouthRight, kMouthLeft, kLipTop, kLipBottom, kInnerTop, kInnerBottom}},
      {"contour", {kChin, kContourRight, kContourLeft}}};
  return parts;
}

std::optional<double> EyeDistance(const DrawnPoints& points) {
  if (const auto corners = Distance(points[size_t(kEyeRightOuter)], points[size_t(kEyeLeftOuter)])) return corners;
  const auto centres = Distance(points[size_t(kEyeRightCentre)], points[size_t(kEyeLeftCentre)]);
  return centres ? std::optional(kOuterOverCentres * *centres) : std::nullopt;
}

std::optional<PointErrors> ErrorsOfPoints(const DrawnPoints& found, const DrawnPoints& truth) {
  const std::optional<double> unit = EyeDistance(truth);
  if (!unit || *unit <= 0) return std::nullopt;
  PointErrors errors;
  double sum = 0;
  int count = 0;
  for (size_t part = 0; part < PointParts().size(); ++part) {
    double sum_of_part = 0;
    int count_of_part = 0;
    for (const faces::FacePoint point : PointParts()[part].points) {
      if (!Counts(truth, point)) continue;
      const auto distance = Distance(found[size_t(point)], truth[size_t(point)]);
      if (!distance) continue;
      sum_of_part += *distance / *unit;
      ++count_of_part;
    }
    if (count_of_part > 0) errors.parts[part] = sum_of_part / count_of_part;
    sum += sum_of_part;
    count += count_of_part;
  }
  if (count == 0) return std::nullopt;
  errors.all = sum / count;
  return errors;
}

int64_t ClassCounts::NumOf(int truth) const {
  const auto begin = counts_.begin() + truth * num_classes_;
  return std::accumulate(begin, begin + num_classes_, int64_t{0});
}

int64_t ClassCounts::num() const {
  return std::accumulate(counts_.begin(), counts_.end(), int64_t{0});
}

std::optional<double> ClassCounts::Recall(int truth) const {
  const int64_t num = NumOf(truth);
  if (num == 0) return std::nullopt;
  return double(counts_[size_t(truth * num_classes_ + truth)]) / double(num);
}

double ClassCounts::balanced_accuracy() const {
  double sum = 0;
  int count = 0;
  for (int truth = 0; truth < num_classes_; ++truth) {
    if (const auto recall = Recall(truth)) {
      sum += *recall;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

Json ClassCounts::ToJson(std::span<const std::string_view> names) const {
  Json of_classes = Json::object();
  for (int truth = 0; truth < num_classes_; ++truth) {
    const auto recall = Recall(truth);
    of_classes[std::string(names[size_t(truth)])] = {{"recall", recall ? Json(*recall) : Json()},
                                                     {"num", NumOf(truth)}};
  }
  return {{"balanced_accuracy", balanced_accuracy()}, {"of_classes", of_classes}};
}

}  // namespace daumier::sketch
