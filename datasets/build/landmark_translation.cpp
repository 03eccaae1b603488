#include "datasets/build/landmark_translation.h"

#include "core/statistics.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace daumier::datasets {
namespace {

using geometry::Vector3;

/// Starts along an axis; steps of all of them and then of the best ones, by some of the places; steps of the best one by
/// all places.
constexpr int kStartsOfAxis = 5, kFirstSteps = 3, kNumBest = 8, kMoreSteps = 8, kLastSteps = 30;
/// Places that starts are compared by.
constexpr Eigen::Index kFewPlaces = 20;
/// A shorter step is the last one, as a share of the mesh's diagonal.
constexpr double kShortestStep = 1e-7;

Vector3 TriangleNormal(const geometry::TriangleMesh& mesh, int triangle) {
  const auto corner = [&](int c) -> Vector3 { return mesh.vertices.row(mesh.triangles(triangle, c)).transpose(); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

/// One step; the median distance before it.
double Step(const geometry::TriangleMesh& mesh, const geometry::TriangleTree& tree, const geometry::Points& places,
            Vector3& translation) {
  constexpr double kDamping = 1e-3;  // Of directions in which all normals agree.
  Eigen::Matrix3d matrix = kDamping * double(places.rows()) * Eigen::Matrix3d::Identity();
  Vector3 right = Vector3::Zero();
  std::vector<double> distances;
  for (const auto row : places.rowwise()) {
    const Vector3 place = row.transpose() + translation;
    const geometry::SurfacePoint closest = tree.Closest(place);
    distances.push_back(closest.distance);
    const Vector3 normal = TriangleNormal(mesh, closest.triangle);
    matrix += normal * normal.transpose();
    right += normal * normal.dot(closest.position - place);
  }
  translation += matrix.ldlt().solve(right);
  return Median(distances);
}

struct TranslationTrial {
  Vector3 translation;
  double distance;  ///< Median, of the places to the mesh.
};

/// The best of the translations that steps from `start` lead to.
TranslationTrial Descend(const geometry::TriangleMesh& mesh, const geometry::TriangleTree& tree,
                         const geometry::Points& places, const Vector3& start, int num_steps, double shortest) {
  TranslationTrial best{start, std::numeric_limits<double>::infinity()};
  Vector3 translation = start;
  for (int step = 0; step < num_steps; ++step) {
    const Vector3 before = translation;
    const double distance = Step(mesh, tree, places, translation);
    if (distance < best.distance) best = {before, distance};
    if ((translation - before).norm() < shortest) break;
  }
  return best;
}

/// Evenly spaced places, kFewPlaces at most.
geometry::Points FewOf(const geometry::Points& places) {
  const Eigen::Index stride = (places.rows() + kFewPlaces - 1) / kFewPlaces;
  return places(Eigen::seq(0, Eigen::last, stride), Eigen::all);
}

}  // namespace

Vector3 TranslationOnto(const geometry::TriangleMesh& mesh, const geometry::TriangleTree& tree,
                        const geometry::Points& places) {
  const Vector3 low = mesh.vertices.colwise().minCoeff().transpose(),
                high = mesh.vertices.colwise().maxCoeff().transpose();
  const Vector3 centre = places.colwise().mean().transpose();
  const double shortest = kShortestStep * (high - low).norm();
  const geometry::Points few = FewOf(places);
  std::vector<TranslationTrial> trials;
  for (int start = 0; start < kStartsOfAxis * kStartsOfAxis * kStartsOfAxis; ++start) {
    const Vector3 share =
        (Vector3(start % kStartsOfAxis, start / kStartsOfAxis % kStartsOfAxis, start / (kStartsOfAxis * kStartsOfAxis))
             .array() +
         0.5) /
        kStartsOfAxis;
    trials.push_back(Descend(mesh, tree, few, low + share.cwiseProduct(high - low) - centre, kFirstSteps, shortest));
  }
  const auto is_nearer = [](const TranslationTrial& a, const TranslationTrial& b) { return a.distance < b.distance; };
  std::stable_sort(trials.begin(), trials.end(), is_nearer);
  trials.resize(kNumBest);
  for (TranslationTrial& trial : trials) trial = Descend(mesh, tree, few, trial.translation, kMoreSteps, shortest);
  const TranslationTrial best = *std::min_element(trials.begin(), trials.end(), is_nearer);
  return Descend(mesh, tree, places, best.translation, kLastSteps, shortest).translation;
}

}  // namespace daumier::datasets
