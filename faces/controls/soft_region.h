#pragma once
#include "faces/face_model.h"

#include <string>
#include <vector>

namespace daumier::faces {

/// A point on or near a face: the mean of some of its 68 landmarks, moved by an offset in eye spans.
struct Anchor {
  std::vector<int> landmarks;  ///< kHairlineAnchor is the hairline vertex.
  geometry::Vector3 offset = geometry::Vector3::Zero();
};
inline constexpr int kHairlineAnchor = 68;

/// The landmarks on the other side, and the offset's x negated.
Anchor Mirrored(const Anchor& anchor);

/// Distance of the outer corners of the eyes (landmarks 36 and 45), cm: the unit of length of all controls.
double EyeSpan(const FaceTemplate& face_template);

/// Where an anchor lies on a face of the template (V x 3, cm); the offset in eye spans of the template.
geometry::Vector3 PositionOf(const Anchor& anchor, const FaceTemplate& face_template, const geometry::Points& face);

/// A factor that rises from 0 to 1 along a direction: s(((X - P) . direction) / width), s(t) = 10 t^3 -
/// 15 t^4 + 6 t^5, P the point at the x
/// of X on the polygonal line through `from` (constant beyond its ends; one anchor: its place).
struct Ramp {
  std::vector<Anchor> from;
  geometry::Vector3 direction;  ///< Of length 1.
  double width;                 ///< Eye spans.
};

/// A soft region of a face, as a weight in [0, 1] of each vertex X of the neutral template:
///   w = (1 - prod_i (1 - exp(-ln 2 |(X - P_i) / radii|^2))) prod_ramps,
/// P_i points at most half a radius apart along the line through the anchors of `path`, so that w is a half at one
/// radius from a single point. Radii may be infinite. Without path the first factor is 1, or, where a region of the
/// annotation is named, its indicator averaged over `rings` rings.
struct SoftRegion {
  std::vector<Anchor> path;
  geometry::Vector3 radii = geometry::Vector3::Ones();  ///< Eye spans, along x, y, z.
  std::vector<Ramp> ramps = {};
  std::string annotated = {};
};

SoftRegion Mirrored(const SoftRegion& region);

/// V: the weights. @throws Error naming the annotated region if the annotation lacks it.
Eigen::VectorXd WeightsOf(const SoftRegion& region, const FaceTemplate& face_template);

}  // namespace daumier::faces
