#pragma once
#include "faces/face_database.h"

#include <vector>

namespace daumier::datasets {

/// What an exaggeration level does to the faces of level 1, the regular ones.
struct LevelMeasures {
  int level = 0;  ///< 0-based.
  double gamma = 0;

  // Of neutral faces.
  int num_persons = 0;         ///< Candidates of the recognition: the first persons, at most 150.
  double displacement_mm = 0;  ///< Mean distance from the person's regular face.
  double own_by_angle = 0;     ///< Share of the persons whose regular face has the least angle to theirs.
  double own_by_distance = 0;  ///< The same by the least mean distance of vertices.

  // Of all expressions: SampleFaces, at most 1,500 of the database.
  int num_faces = 0;
  int num_faces_flipped = 0;   ///< Faces with a new flipped triangle.
  int most_flipped = 0;        ///< Of one face.
  int num_lips_crossed = 0;    ///< Faces whose lips cross by kCrossingMm more than at rest.
  double lips_crossed_mm = 0;  ///< The most, beyond rest.
  int num_lids_crossed = 0;
  double lids_crossed_mm = 0;
};

/// Depths up to this one, in mm, do not count as crossed.
inline constexpr double kCrossingMm = 0.1;

/// A row for every level but the first. All is measured over the region `face`.
/// - Displacement: after AlignSimilarity onto the person's regular face; mean over the persons of the mean distance.
/// - Recognition: faces are aligned by AlignSimilarity onto the mean m of the candidates, which are the regular neutral
///   faces. A face x is recognised by the candidate c of greatest cosine <x - m', c - m'>, m' the mean of the aligned
///   candidates, or of least mean distance of the vertices of x and c.
/// - Flips: triangles that geometry::FlippedTriangles finds against the regular face of the same person and expression.
/// - Crossings: faces::CrossingDepth less that of the same regular face, at least 0.
/// Promises: a level that is the regular face has displacement 0 and is always recognised; a level that multiplies the
/// deviations from the mean is recognised by the angle; both but for alignment.
/// @throws Error if the database has one level, fewer than two persons, or as faces::FindOpenings.
std::vector<LevelMeasures> MeasureLevels(const faces::FaceDatabase& database);

}  // namespace daumier::datasets
