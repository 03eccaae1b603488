#include "eval/surface_score.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/statistics.h"
#include "geometry/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace daumier::eval {
namespace {

constexpr int kFewestLandmarks = 6, kNumJawLandmarks = 17, kClosestRounds = 20, kPointsOfRounds = 1000;
constexpr double kJawWeight = 0.1;
/// A mirror image fits this many times better than what is predicted.
constexpr double kMirrorShare = 0.5;
constexpr double kMostScale = 2, kMostTurnDegrees = 45;

struct LandmarkPlaces {
  geometry::Points predicted, truth;
  Eigen::VectorXd weights;
};

LandmarkPlaces PlacesOf(const geometry::TriangleMesh& predicted, const LandmarkVertices& landmarks,
                        const geometry::Points& truth, const faces::FaceTemplate& face_template) {
  std::vector<int> known;
  for (int i = 0; i < int(landmarks.size()); ++i)
    if (landmarks[size_t(i)] >= 0) known.push_back(i);
  DAUMIER_CHECK(std::ssize(known) >= kFewestLandmarks, "{} landmarks, expected {} or more", known.size(),
                kFewestLandmarks);
  LandmarkPlaces places{geometry::Points(std::ssize(known), 3), geometry::Points(std::ssize(known), 3),
                        Eigen::VectorXd(std::ssize(known))};
  for (Eigen::Index row = 0; row < std::ssize(known); ++row) {
    const auto i = size_t(known[size_t(row)]);
    DAUMIER_CHECK(landmarks[i] < predicted.vertices.rows(), "landmark {} is vertex {} of {}", i, landmarks[i],
                  predicted.vertices.rows());
    places.predicted.row(row) = predicted.vertices.row(landmarks[i]);
    places.truth.row(row) = truth.row(face_template.annotation.landmarks[i]);
    places.weights[row] = int(i) < kNumJawLandmarks ? kJawWeight : 1;
  }
  return places;
}

double Misfit(const geometry::Points& predicted, const LandmarkPlaces& places) {
  const geometry::Similarity similarity = geometry::AlignSimilarity(predicted, places.truth, places.weights);
  return std::sqrt((similarity.Apply(predicted) - places.truth).rowwise().squaredNorm().dot(places.weights));
}

/// The points of the surface, in its own frame, that are nearest to points of the truth.
geometry::Points ClosestTo(const geometry::Points& truth, const geometry::Similarity& alignment,
                           const geometry::TriangleTree& surface) {
  geometry::Points closest = geometry::Inverse(alignment).Apply(truth);
  for (Eigen::Index i = 0; i < closest.rows(); ++i)
    closest.row(i) = surface.Closest(closest.row(i).transpose()).position.transpose();
  return closest;
}

}  // namespace

SurfaceScore ScoreSurface(const geometry::TriangleMesh& predicted, const LandmarkVertices& landmarks,
                          const geometry::Points& truth, const faces::FaceTemplate& face_template) {
  DAUMIER_CHECK(predicted.vertices.allFinite(), "a predicted vertex is no finite number");
  const LandmarkPlaces places = PlacesOf(predicted, landmarks, truth, face_template);
  SurfaceScore score;
  score.alignment = geometry::AlignSimilarity(places.predicted, places.truth, places.weights);
  geometry::Points mirrored = places.predicted;
  mirrored.col(0) *= -1;
  DAUMIER_CHECK(Misfit(mirrored, places) >= kMirrorShare * Misfit(places.predicted, places) ||
                    Misfit(places.predicted, places) < 1e-9,
                "it is a mirror image of a face: its right is on its left. Negate one axis (or check the order of its "
                "landmarks)");
  const std::vector<int>& region = faces::RegionFor(face_template.annotation, "face", "the error of a surface");
  const geometry::TriangleTree surface(predicted);
  const geometry::Points some = truth(EvenlySpaced(region, kPointsOfRounds), Eigen::all);
  for (int round = 0; round < kClosestRounds; ++round)
    score.alignment = geometry::AlignSimilarity(ClosestTo(some, score.alignment, surface), some);
  const geometry::Points all = truth(region, Eigen::all);
  const Eigen::VectorXd distances =
      faces::MillimetresPerCm(face_template) *
      (score.alignment.Apply(ClosestTo(all, score.alignment, surface)) - all).rowwise().norm();
  const std::vector<double> numbers(distances.begin(), distances.end());
  score.mean_mm = Mean(numbers);
  score.p90_mm = Percentile(numbers, 90);
  return score;
}

std::optional<std::string> FrameMistake(const geometry::Similarity& alignment) {
  std::string unit, axes;
  if (alignment.scale > kMostScale || alignment.scale < 1 / kMostScale) {
    const double times = 1 / alignment.scale;
    const char* name = times > 5 && times < 20         ? "millimetres"
                       : times > 0.005 && times < 0.02 ? "metres"
                                                       : "of another unit";
    unit =
        fmt::format("they seem to be {}, expected centimetres: multiply them by about {:.3g}", name, alignment.scale);
  }
  const double cosine = (alignment.rotation.trace() - 1) / 2;
  const double degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  if (degrees > kMostTurnDegrees) {
    const Eigen::Vector3d up = alignment.rotation.transpose() * Eigen::Vector3d::UnitY();
    Eigen::Index axis = 0;
    up.cwiseAbs().maxCoeff(&axis);
    axes = fmt::format(
        "they are turned by {:.0f} degrees: their {}{} seems to point upwards, expected y up and the face to +z",
        degrees, up[axis] < 0 ? "-" : "+", "xyz"[axis]);
  }
  if (unit.empty() && axes.empty()) return std::nullopt;
  return unit.empty() ? axes : axes.empty() ? unit : unit + "; " + axes;
}

}  // namespace daumier::eval
