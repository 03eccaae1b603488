#pragma once
#include "datasets/build/landmark_fit.h"
#include "geometry/alignment.h"

#include <functional>
#include <vector>

namespace daumier::datasets {

/// Which of the given places is taken for a landmark.
using SourceLandmark = std::function<int(int)>;

int SameLandmark(int landmark);

/// Pairs of a landmark of the template and the place on the mesh that is taken for it.
struct LandmarkPairs {
  std::vector<int> landmarks;
  geometry::Points places, rest;
  Eigen::VectorXd weights;
};

/// The landmarks whose place is there. Those of the contour weigh `input.contour_weight`.
LandmarkPairs PairsOf(const FitInput& input, const MeshLandmarks& places, const SourceLandmark& source);

/// The root of the weighted mean squared distance from the weighted mean.
double SpreadOf(const geometry::Points& points, const Eigen::VectorXd& weights);

/// Distances after geometry::AlignRobustly, as shares of the template's spread.
Eigen::VectorXd Residuals(const LandmarkPairs& pairs);
/// Their weighted mean.
double MisfitOf(const LandmarkPairs& pairs);

}  // namespace daumier::datasets
