#include "datasets/build/landmark_translation.h"

#include "core/statistics.h"

#include <limits>
#include <vector>

namespace daumier::datasets {
namespace {

using geometry::Vector3;

/// Starts along an axis, and steps from each; the best one takes the rest.
constexpr int kStartsOfAxis = 5, kFirstSteps = 8, kLastSteps = 30;

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

}  // namespace

Vector3 TranslationOnto(const geometry::TriangleMesh& mesh, const geometry::TriangleTree& tree,
                        const geometry::Points& places) {
  const Vector3 low = mesh.vertices.colwise().minCoeff().transpose(),
                high = mesh.vertices.colwise().maxCoeff().transpose();
  const Vector3 centre = places.colwise().mean().transpose();
  Vector3 best = Vector3::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto run = [&](Vector3 translation, int num_steps) {
    for (int step = 0; step < num_steps; ++step) {
      const Vector3 before = translation;
      const double distance = Step(mesh, tree, places, translation);
      if (distance >= least) continue;
      least = distance;
      best = before;
    }
  };
  for (int start = 0; start < kStartsOfAxis * kStartsOfAxis * kStartsOfAxis; ++start) {
    const Vector3 share =
        (Vector3(start % kStartsOfAxis, start / kStartsOfAxis % kStartsOfAxis, start / (kStartsOfAxis * kStartsOfAxis))
             .array() +
         0.5) /
        kStartsOfAxis;
    run(low + share.cwiseProduct(high - low) - centre, kFirstSteps);
  }
  run(best, kLastSteps);
  return best;
}

}  // namespace daumier::datasets
