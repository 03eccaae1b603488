#pragma once
#include "core/options.h"
#include "render/contour_chains.h"
#include "render/strokes.h"
#include "render/visibility.h"

#include <string>
#include <vector>

namespace daumier::render {

/// Which suggestive contours are worth a stroke. Thresholds are in units of 1 / feature size^2 and compared with
/// D_w kappa_r sin(theta) / cos(theta), as in the authors' program [DeCarlo et al. 2003].
struct ContourOptions {
  double low = 0.01;
  double high = 0.04;
  double min_angle = 20;
  double min_length = 8;

  template <class V>
  void Visit(V&& visit) {
    visit("low", low, Range{0, 10},
          "A contour continues as long as the radial curvature rises at least this fast (lower threshold of "
          "hysteresis).");
    visit("high", high, Range{0, 10},
          "A contour is kept if the radial curvature rises at least this fast somewhere along it (upper threshold of "
          "hysteresis).");
    visit("min_angle", min_angle, Range{0, 90},
          "Smallest angle between surface normal and view direction at which a contour is drawn, degrees.");
    visit("min_length", min_length, Range{0, 256}, "Length of the shortest stroke, pixels of the canvas.");
  }
};

/// All of a surface that its lines from any side are made of. Curvature and its derivative at a vertex depend on what
/// lies within kContourRings edges of it, and on nothing else.
struct ContourSurface {
  geometry::TriangleMesh mesh;
  geometry::PrincipalCurvatures curvatures;
  geometry::CurvatureDerivatives derivatives;
};
ContourSurface MakeContourSurface(geometry::TriangleMesh mesh);
inline constexpr int kContourRings = 3;

/// Visible suggestive contours as strokes of a kind, in pixels of the visibility's camera: chained, cut where they are
/// hidden, kept if they reach `high` and are long enough, and smoothed a little along their way. `feature_size` in cm.
/// `is_drawn` (F): lines are sought in triangles where it is true; empty: in all.
/// @throws Error if high is below low, or is_drawn has another size.
std::vector<Stroke> SuggestiveStrokes(const ContourSurface& surface, const Visibility& visibility, double feature_size,
                                      const ContourOptions& options, int kind, const std::vector<bool>& is_drawn = {});

/// Visible occluding contours, the same way; `options.min_length` alone counts.
std::vector<Stroke> OccludingStrokes(const ContourSurface& surface, const Visibility& visibility,
                                     const ContourOptions& options, int kind);

/// "occluding", "suggestive", "border": kinds of the strokes of DrawContours.
const std::vector<std::string>& ContourKinds();

/// A line drawing of a mesh: its visible occluding and suggestive contours and borders, thresholds by its own
/// FeatureSize.
/// @throws Error as FeatureSize, Rasterise and SuggestiveStrokes.
std::vector<Stroke> DrawContours(const geometry::TriangleMesh& mesh, const Camera& camera,
                                 const ContourOptions& options = {});

}  // namespace daumier::render
