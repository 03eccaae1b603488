#pragma once
#include "faces/landmark_parts.h"
#include "systems/portrait/landmark_sample.h"

#include <array>
#include <span>
#include <vector>

namespace daumier::portrait {

using faces::kLandmarkParts;
using faces::LandmarkPart;

/// Distance of the outer eye corners, 36 and 45, pixels. points: 68 x 2.
double InterocularDistance(std::span<const float> points);

/// Normalised errors: distance of each landmark / interocular distance of `truth`; NaN where the truth is. points, truth:
/// 68 x 2. @throws Error if sizes disagree, or if the eye corners of the truth coincide or are not known.
std::array<double, kNumLandmarks> ErrorsOfLandmarks(std::span<const float> points, std::span<const float> truth);

/// The mean of the errors of landmarks begin .. end - 1 that are known; NaN if none is.
double MeanError(const std::array<double, kNumLandmarks>& errors, int begin = 0, int end = kNumLandmarks);

/// Normalised mean error: MeanError of ErrorsOfLandmarks.
double NormalisedError(std::span<const float> points, std::span<const float> truth, int begin = 0,
                       int end = kNumLandmarks);

/// Counts of pixels for the intersection over union of each class.
struct LabelCounts {
  std::array<int64_t, kNumPictureClasses> both = {}, either = {};

  /// Adds pixels; those whose truth is negative do not count. @throws Error if sizes disagree.
  void Add(std::span<const int64_t> predicted, std::span<const int64_t> truth);
  /// Of a class; 1 where neither has a pixel.
  double iou(PictureClass of_class) const;
  /// The mean over all classes.
  double mean_iou() const;
};

}  // namespace daumier::portrait
