#pragma once
#include "faces/face_model.h"
#include "geometry/alignment.h"
#include "geometry/mesh.h"

#include <array>
#include <optional>
#include <string>

/// Errors of a predicted surface of any topology against a true face, as shapes of faces from pictures are measured [Sanyal et al.
/// 2019, section 6].
namespace daumier::eval {

struct SurfaceScore {
  double mean_mm = 0;              ///< Mean distance of the true vertices of the region `face` to the aligned surface.
  double p90_mm = 0;               ///< 90th percentile of these distances.
  geometry::Similarity alignment;  ///< From the prediction to the truth: what the prediction's unit and axes are.
};

/// The 68 landmarks of a topology as vertices, iBUG order; -1: it has none there.
using LandmarkVertices = std::array<int, 68>;

/// The prediction is aligned by the similarity of its landmarks, those of the jaw with a tenth of the weight, and then by twenty
/// rounds of closest points of a thousand vertices of the region. Zero iff the true region lies on the surface after a
/// similarity; scaling, turning and moving the prediction changes less than 0.001 mm (closest points may change at borders).
/// @throws Error if fewer than six landmarks are there, one is no vertex, a vertex is not finite, the landmarks lie in one line,
/// or the prediction is nearer to the truth as a mirror image.
SurfaceScore ScoreSurface(const geometry::TriangleMesh& predicted, const LandmarkVertices& landmarks,
                          const geometry::Points& truth, const faces::FaceTemplate& face_template);

/// What the unit and the axes of predictions seem to be, with the repair, where their alignment scales by more than 2 or turns by
/// more than 45 degrees: "millimetres", "z upwards". Absent where they are those of the truth.
std::optional<std::string> FrameMistake(const geometry::Similarity& alignment);

}  // namespace daumier::eval
