#include "datasets/build/landmark_fit.h"

#include "core/error.h"
#include "core/statistics.h"
#include "datasets/build/landmark_groups.h"
#include "datasets/build/landmark_pairs.h"
#include "datasets/build/landmark_translation.h"
#include "geometry/alignment.h"
#include "geometry/normals.h"
#include "geometry/triangle_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace daumier::datasets {
namespace {

using geometry::Vector3;

/// Another reading of the landmarks is the right one if its misfit falls below this share: right readings of other
/// heads reach 0.73 at most, wrong readings of good heads 1.18 at least.
constexpr double kFarBetter = 0.85;
/// A translation needs no rounder numbers than another unit: it has to bring the landmarks this much closer than that.
constexpr double kCloserThanUnit = 0.5;
/// An axis along which the landmarks are moved less, as a share of the whole move, is not moved.
constexpr double kNoMove = 1e-4;
/// The same of distances from the mesh, which good readings bring to nearly nothing; closer ones are not tried.
constexpr double kFarCloser = 0.25, kNearMesh = 0.02;
/// A landmark at 0 0 0 that is farther from the mesh, as a share of the landmarks' spread, is absent.
constexpr double kFarOffMesh = 0.2;
/// Three landmarks in one place are absent ones; two may be there, at closed lips.
constexpr size_t kFewestZeros = 3;
/// Fewer landmarks with shifted numbers say nothing.
constexpr int kFewestLandmarksOfFit = 6;
/// Fewer landmarks may fit in another order, too.
constexpr size_t kFewestShifted = 20;

/// Whether three or more landmarks are there with their partners on the other side: a part of one side fits the other
/// side, too, turned over.
bool HasBothSides(const MeshLandmarks& landmarks) {
  int num_sided = 0;
  for (int l = 0; l < faces::kNumLandmarks; ++l) {
    const int other = faces::MirroredLandmark(l);
    num_sided += l < other && landmarks[size_t(l)] && landmarks[size_t(other)];
  }
  return num_sided >= 3;
}

/// The mean cosine between the normals of mesh and template at the landmarks.
double NormalAgreement(const FitInput& input, const geometry::TriangleTree& tree, const geometry::Points& mesh_normals,
                       const LandmarkPairs& pairs) {
  const geometry::Points rest_normals = geometry::VertexNormals({input.face.neutral, input.face.triangles});
  const geometry::Similarity similarity = geometry::AlignRobustly(pairs.places, pairs.rest, pairs.weights);
  double sum = 0;
  for (size_t k = 0; k < pairs.landmarks.size(); ++k) {
    const geometry::SurfacePoint closest = tree.Closest(pairs.places.row(Eigen::Index(k)).transpose());
    Vector3 normal = Vector3::Zero();
    for (int corner = 0; corner < 3; ++corner)
      normal +=
          closest.barycentric[corner] * mesh_normals.row(input.mesh.triangles(closest.triangle, corner)).transpose();
    const int vertex = input.face.annotation.landmarks[size_t(pairs.landmarks[k])];
    sum += (similarity.rotation * normal.stableNormalized()).dot(rest_normals.row(vertex).transpose());
  }
  return sum / double(pairs.landmarks.size());
}

/// Median distance from the mesh over the spread of the places.
double OffMesh(const geometry::TriangleTree& tree, const geometry::Points& moved) {
  std::vector<double> distances;
  for (const auto place : moved.rowwise()) distances.push_back(tree.Closest(place.transpose()).distance);
  return Median(distances) / SpreadOf(moved, Eigen::VectorXd::Ones(moved.rows()));
}

/// Landmarks at 0 0 0, or at the vertex 0 where several are there.
std::vector<int> ZeroLandmarks(const FitInput& input) {
  std::vector<int> at_origin, at_first;
  for (int l = 0; l < faces::kNumLandmarks; ++l) {
    const auto& place = input.landmarks[size_t(l)];
    if (!place) continue;
    if (place->isZero(0)) at_origin.push_back(l);
    if (place->transpose() == input.mesh.vertices.row(0)) at_first.push_back(l);
  }
  return at_origin.size() >= at_first.size() ? at_origin : at_first;
}

/// Whether landmarks at zero are absent ones: three or more in one place, or fewer that lie far off the mesh or far off
/// where the others fit.
bool AreAbsent(const FitInput& input, const geometry::TriangleTree& tree, const LandmarkFit& fit,
               const std::vector<int>& zeros) {
  if (zeros.empty() || zeros.size() >= kFewestZeros) return !zeros.empty();
  const LandmarkPairs pairs = PairsOf(input, input.landmarks, SameLandmark);
  const double own_spread = SpreadOf(pairs.places, Eigen::VectorXd::Ones(pairs.places.rows()));
  const double off_mesh = tree.Closest(*input.landmarks[size_t(zeros[0])]).distance / own_spread;
  if (off_mesh > std::max(kFarOffMesh, 5 * fit.off_mesh)) return true;
  MeshLandmarks others = input.landmarks;
  for (const int l : zeros) others[size_t(l)].reset();
  const LandmarkPairs fitted = PairsOf(input, others, SameLandmark);
  const geometry::Similarity similarity = geometry::AlignRobustly(fitted.places, fitted.rest, fitted.weights);
  const Eigen::VectorXd usual = Residuals(fitted);
  const double spread = SpreadOf(fitted.rest, fitted.weights);
  return std::all_of(zeros.begin(), zeros.end(), [&](int l) {
    const auto k = std::find(pairs.landmarks.begin(), pairs.landmarks.end(), l) - pairs.landmarks.begin();
    const double residual = (similarity.Apply(pairs.places.row(k)) - pairs.rest.row(k)).norm() / spread;
    return residual > std::max(1.0, 1.5 * usual.maxCoeff());
  });
}

std::string ListOf(const std::vector<int>& landmarks) {
  std::string text;
  for (size_t k = 0; k < std::min(landmarks.size(), size_t(6)); ++k)
    text += fmt::format("{}{}", k ? ", " : "", landmarks[k]);
  return landmarks.size() > 6 ? text + ", ..." : text;
}

/// A linear map of the landmarks onto the mesh, by name.
struct FrameChange {
  std::string name;
  Eigen::Matrix3d matrix;
};

std::string NameOfAxes(const Eigen::Matrix3d& matrix) {
  std::string name;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      if (matrix(row, column) != 0)
        name += fmt::format("{}{}{}", row ? " " : "", matrix(row, column) < 0 ? "-" : "", "xyz"[column]);
    }
  }
  return name;
}

/// Permutations of the axes with signs, of this determinant, but for the identity.
std::vector<FrameChange> AxisChanges(double determinant) {
  std::vector<FrameChange> changes;
  std::array<int, 3> axes = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
      for (int row = 0; row < 3; ++row) matrix(row, axes[size_t(row)]) = signs >> row & 1 ? -1 : 1;
      const double sign = matrix.row(0).cross(matrix.row(1)).dot(matrix.row(2));
      if (sign == determinant && !matrix.isIdentity(0)) changes.push_back({NameOfAxes(matrix), matrix});
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return changes;
}

std::vector<FrameChange> UnitChanges() {
  std::vector<FrameChange> changes;
  for (const double factor : {10.0, 100.0, 1000.0, 2.54, 25.4, 30.48, 304.8}) {
    changes.push_back({fmt::format("multiply them by {}", factor), factor * Eigen::Matrix3d::Identity()});
    changes.push_back({fmt::format("divide them by {}", factor), Eigen::Matrix3d::Identity() / factor});
  }
  return changes;
}

/// The change that brings the landmarks onto the mesh; nothing where none brings them far closer.
std::optional<FrameChange> BestChange(const geometry::TriangleTree& tree, const geometry::Points& places,
                                      double off_mesh, const std::vector<FrameChange>& changes) {
  std::optional<FrameChange> best;
  double least = kFarCloser * off_mesh;
  for (const FrameChange& change : changes) {
    const double off = OffMesh(tree, places * change.matrix.transpose());
    if (off >= least) continue;
    least = off;
    best = change;
  }
  return best;
}

/// Whether the landmarks fit far better with these numbers, most of which are vertices.
bool FitsBetter(const FitInput& input, const std::optional<MeshLandmarks>& shifted, const LandmarkFit& fit) {
  if (!shifted) return false;
  const auto num_present = [](const MeshLandmarks& landmarks) {
    return std::count_if(landmarks.begin(), landmarks.end(), [](const auto& place) { return place.has_value(); });
  };
  if (2 * num_present(*shifted) < num_present(input.landmarks) || num_present(*shifted) < kFewestLandmarksOfFit)
    return false;
  return MisfitOf(PairsOf(input, *shifted, SameLandmark)) < kFarBetter * fit.misfit;
}

/// A unit, axes or an origin that brings the landmarks far closer to the mesh.
std::optional<std::string> FaultOfFrame(const geometry::TriangleMesh& mesh, const geometry::TriangleTree& tree,
                                        const geometry::Points& places, double off_mesh) {
  const auto unit = BestChange(tree, places, off_mesh, UnitChanges());
  const auto axes = unit ? std::nullopt : BestChange(tree, places, off_mesh, AxisChanges(1));
  double least = std::min(kFarCloser * off_mesh, kNearMesh);
  for (const auto& change : {unit, axes}) {
    if (change) least = std::min(least, kCloserThanUnit * OffMesh(tree, places * change->matrix.transpose()));
  }
  Vector3 move = TranslationOnto(mesh, tree, places);
  for (double& axis : move) axis = std::abs(axis) < kNoMove * move.norm() ? 0 : axis;
  if (OffMesh(tree, places.rowwise() + move.transpose()) < least)
    return fmt::format(
        "the landmarks are moved by ({:.4g}, {:.4g}, {:.4g}) against the mesh. Subtract that, or move the mesh by it",
        0 - move.x(), 0 - move.y(), 0 - move.z());
  if (unit) return fmt::format("the landmarks are in another unit than the mesh: {}", unit->name);
  if (axes)
    return fmt::format("the landmarks are in another frame than the mesh: they lie on it as {}. Write them in that way",
                       axes->name);
  return std::nullopt;
}

std::string MirrorFault(const LandmarkFit& fit, const geometry::TriangleTree& tree, const geometry::Points& places) {
  if (fit.off_mesh > kNearMesh) {
    if (const auto change = BestChange(tree, places, fit.off_mesh, AxisChanges(-1))) {
      const bool is_down = change->name == "x -y z";
      return fmt::format("the landmarks are mirrored{}: they lie on the mesh as {}. Write them in that way",
                         is_down ? ", y points down" : "", change->name);
    }
  }
  if (fit.mirrored->normals < 0)
    return "the mesh is mirrored and inside out, as if a coordinate had been negated: the landmarks fit its mirror "
           "image. "
           "Negate x of the mesh (and of the landmarks, where they are places)";
  return fmt::format(
      "left and right of the landmarks are exchanged, or the mesh is a mirror image: with 0 and 16, 36 and 45, "
      "48 and 54 and so on exchanged, the misfit falls from {:.2f} to {:.2f}. iBUG order begins at the "
      "person's right ear. Exchange them, or mirror the mesh",
      fit.misfit, fit.mirrored->misfit);
}

}  // namespace

std::optional<std::string> FaultOfOnePlace(const MeshLandmarks& landmarks) {
  std::optional<Vector3> first;
  for (const auto& place : landmarks) {
    if (!place) continue;
    if (!first) first = place;
    if (*place != *first) return std::nullopt;
  }
  if (!first) return std::nullopt;
  return fmt::format(
      "all landmarks are in one place ({:.4g}, {:.4g}, {:.4g}), or one vertex. Some programs write zeros for absent "
      "ones: --zero-is-absent leaves these out, but six others have to be there",
      first->x(), first->y(), first->z());
}

std::optional<std::string> FaultOfPlane(const geometry::TriangleMesh& mesh, const MeshLandmarks& landmarks) {
  constexpr double kFlat = 1e-6;  // As a share of the largest extent.
  Eigen::AlignedBox3d box, of_mesh;
  for (const auto& place : landmarks)
    if (place) box.extend(*place);
  if (box.isEmpty()) return std::nullopt;
  for (const auto vertex : mesh.vertices.rowwise()) of_mesh.extend(Vector3(vertex.transpose()));
  for (int axis = 0; axis < 3; ++axis) {
    if (box.sizes()[axis] > kFlat * box.sizes().maxCoeff()) continue;
    const char name = "xyz"[axis];
    const double value = box.min()[axis] + 0.0;  // Without the sign of -0.
    if (of_mesh.sizes()[axis] <= kFlat * of_mesh.sizes().maxCoeff())
      return fmt::format(
          "the mesh is flat: {} of all its points is {:.4g}. Export it with its depth, or use another mesh", name,
          value);
    return fmt::format(
        "{} of all landmarks is {:.4g}, but that of the mesh goes from {:.4g} to {:.4g}: the landmarks are those of a "
        "picture, or {} was lost. Mark x y z on the mesh, or give the numbers of its vertices",
        name, value, of_mesh.min()[axis], of_mesh.max()[axis], name);
  }
  return std::nullopt;
}

LandmarkFit MeasureLandmarkFit(const FitInput& input) {
  const LandmarkPairs pairs = PairsOf(input, input.landmarks, SameLandmark);
  const geometry::TriangleTree tree(input.mesh);
  const geometry::Points normals = geometry::VertexNormals(input.mesh);
  LandmarkFit fit{MisfitOf(pairs), OffMesh(tree, pairs.places), NormalAgreement(input, tree, normals, pairs)};
  if (HasBothSides(input.landmarks)) {
    const LandmarkPairs mirrored = PairsOf(input, input.landmarks, faces::MirroredLandmark);
    fit.mirrored = {MisfitOf(mirrored), NormalAgreement(input, tree, normals, mirrored)};
  }
  return fit;
}

std::optional<std::string> FaultOfLandmarks(const FitInput& input, const LandmarkFit& fit,
                                            const RegistrationLimits& limits) {
  const geometry::TriangleTree tree(input.mesh);
  if (const std::vector<int> zeros = ZeroLandmarks(input); AreAbsent(input, tree, fit, zeros)) {
    return fmt::format(
        "landmarks {} are 0, which some programs write for absent ones. Use --zero-is-absent, or write -1 "
        "for absent vertices and nan nan nan for absent places",
        ListOf(zeros));
  }
  const LandmarkPairs pairs = PairsOf(input, input.landmarks, SameLandmark);
  if (fit.mirrored && fit.mirrored->misfit < kFarBetter * fit.misfit) return MirrorFault(fit, tree, pairs.places);
  if (FitsBetter(input, input.shifted.one_less, fit))
    return "the numbers of the vertices are 1-based: one less each fits a face far better. Subtract 1 from each";
  if (FitsBetter(input, input.shifted.one_more, fit))
    return "the numbers of the vertices are one too low, as if 1 had been subtracted twice: one more each fits a face "
           "far better. Add 1 to each";
  for (const int shift : {1, faces::kNumLandmarks - 1}) {
    const auto shifted = [&](int l) { return (l + shift) % faces::kNumLandmarks; };
    const LandmarkPairs others = PairsOf(input, input.landmarks, shifted);
    if (others.landmarks.size() >= kFewestShifted && MisfitOf(others) < kFarBetter * fit.misfit)
      return fmt::format(
          "the landmarks are shifted by one: the {} fits a face far better. Expected 68 in iBUG order, the "
          "first at the person's right ear",
          shift == 1 ? "next one for each" : "one before for each");
  }
  if (const auto fault = FaultOfGroups(input, limits.max_landmark_misfit)) return fault;
  if (const std::vector<int> outliers = Outliers(input); !outliers.empty())
    return fmt::format(
        "landmark{} {} {} far off: the others fit the template far better. Mark {} elsewhere, or as absent (-1 or nan "
        "nan nan); the first has the number 0",
        outliers.size() > 1 ? "s" : "", ListOf(outliers), outliers.size() > 1 ? "are" : "is",
        outliers.size() > 1 ? "them" : "it");
  if (fit.misfit > limits.max_landmark_misfit)
    return fmt::format(
        "the landmarks are not those of a face in iBUG order: after the best similarity their mean distance from the "
        "template's is {:.2f} of the landmarks' spread (expected {} or less). Order them as iBUG, from the "
        "person's right ear",
        fit.misfit, limits.max_landmark_misfit);
  if (fit.off_mesh > kNearMesh) {
    if (const auto fault = FaultOfFrame(input.mesh, tree, pairs.places, fit.off_mesh)) return fault;
  }
  if (fit.off_mesh > limits.max_landmarks_off_mesh)
    return fmt::format(
        "the landmarks do not lie on the mesh: their median distance from it is {:.2f} of their spread "
        "(expected {} or less). Mark them in the unit and the frame of this mesh",
        fit.off_mesh, limits.max_landmarks_off_mesh);
  if (std::abs(fit.normals) < limits.min_normal_agreement)
    return fmt::format(
        "the mesh does not face as a head does at its landmarks: mean cosine of the normals {:.2f}, expected {} "
        "or more. Its triangles are wound in both ways, or the landmarks are elsewhere",
        fit.normals, limits.min_normal_agreement);
  return std::nullopt;
}

}  // namespace daumier::datasets
