#pragma once
#include "core/options.h"
#include "datasets/build/landmark_file.h"
#include "faces/face_model.h"
#include "geometry/mesh.h"

#include <optional>
#include <string>

namespace daumier::datasets {

/// When a registration has failed. docs/registration.md has the measurements that the numbers come from.
struct RegistrationLimits {
  double max_landmark_misfit = 0.7;
  double max_landmarks_off_mesh = 0.15;
  double min_normal_agreement = 0.3;
  double min_coverage = 0.1;
  double max_flipped = 0.04;
  double max_landmarks_mm = 8;

  template <class V>
  void Visit(V&& visit) {
    visit("max_landmark_misfit", max_landmark_misfit, Range{0.0, 10.0},
          "Largest mean distance between the landmarks of mesh and template after a robust similarity, as a share of "
          "their spread.");
    visit("max_landmarks_off_mesh", max_landmarks_off_mesh, Range{0.0, 1e3},
          "Largest median distance of the landmarks from the mesh, as a share of their spread.");
    visit("min_normal_agreement", min_normal_agreement, Range{-1.0, 1.0},
          "Smallest mean cosine between the normals of mesh and template at the landmarks.");
    visit("min_coverage", min_coverage, Range{0.0, 1.0},
          "Smallest share of the face's area that has a match on the mesh.");
    visit("max_flipped", max_flipped, Range{0.0, 1.0}, "Largest share of the face's triangles that may be flipped.");
    visit("max_landmarks_mm", max_landmarks_mm, Range{0.0, 1e3},
          "Largest mean distance between the landmarks of the mesh and of the registered template, mm.");
  }
};

/// How the landmarks of a mesh fit those of a template, before any registration. The spread of points is the root of
/// their mean squared distance from their mean; the contour weighs `contour_weight`.
struct LandmarkFit {
  double misfit = 0;    ///< Mean distance after geometry::AlignRobustly, over the spread of the template's landmarks.
  double off_mesh = 0;  ///< Median distance to the mesh, over the spread of the landmarks themselves.
  double normals = 0;   ///< Mean cosine between the normals of mesh and template at the landmarks.
  /// With left and right of the landmarks exchanged; nothing with fewer than three on either side.
  struct Mirrored {
    double misfit, normals;
  };
  std::optional<Mirrored> mirrored = {};
};

/// A mesh with its landmarks, for MeasureLandmarkFit.
struct FitInput {
  const faces::FaceTemplate& face;
  const geometry::TriangleMesh& mesh;
  const MeshLandmarks& landmarks;
  const ShiftedNumbers& shifted;  ///< LandmarkFile::ShiftedOn.
  double contour_weight;
};

/// Why landmarks that all have the same x, y or z do so, of which no face has any; nothing where they do not.
std::optional<std::string> FaultOfPlane(const geometry::TriangleMesh& mesh, const MeshLandmarks& landmarks);

/// Why landmarks that all lie in one place, which no similarity fits, do so; nothing where they do not.
std::optional<std::string> FaultOfOnePlace(const MeshLandmarks& landmarks);

/// @throws Error as geometry::AlignSimilarity and TriangleTree.
LandmarkFit MeasureLandmarkFit(const FitInput& input);

/// Why these landmarks do not fit this mesh or no face at all, with the repair; nothing where they do. Recognises by
/// trial what would fit far better: zeros for absent landmarks, left and right exchanged or a mirrored mesh, an axis of
/// the wrong sign, another frame, another unit, another origin, numbers of vertices that are one too high or too low, an
/// order shifted by one, another order within a part (FaultOfGroups), and single wrong landmarks (Outliers). A mesh that
/// is inside out but fits otherwise has no fault here: its `normals` are below 0.
std::optional<std::string> FaultOfLandmarks(const FitInput& input, const LandmarkFit& fit,
                                            const RegistrationLimits& limits);

}  // namespace daumier::datasets
