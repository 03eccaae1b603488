#pragma once
#include "faces/controls/soft_region.h"

#include <string>
#include <vector>

namespace daumier::faces {

/// How a control moves the points of its region: by value times the vector of its kind.
struct Motion {
  enum class Kind {
    kMove,   ///< x + value vector; the vector in eye spans.
    kScale,  ///< c + diag(exp(value vector)) (x - c), c the pivot: logarithms of the scale along x, y, z.
    kTurn,   ///< c + R(value vector) (x - c): a rotation vector in radians, |vector| <= 0.3.
  };
  Kind kind;
  geometry::Vector3 vector;
};

/// An anatomical control of a face [Brennan 1985 exaggerates such measures of a face]: its name, the group of controls
/// that artists exaggerate together, where it acts and how. It moves a point x of the face as it is, weight w in its
/// region, to x + w (motion(x) - x), the pivot being the current place of its anchor. Values are dimensionless, of
/// [-3, 3]: 1 is about two standard deviations between persons, 3 an extreme caricature.
struct FaceControl {
  enum class Sides {
    kMiddle,   ///< One value; the region is the mean of the one given and its mirror image, as that of kSideways.
    kPaired,   ///< A value on each side; the region and motion are those of the left side (+x).
    kSideways  ///< One value; a symmetric face stays symmetric at 0 alone.
  };
  std::string name;
  std::string group;
  Sides sides;
  SoftRegion region;
  Motion motion;
  Anchor pivot = {{27}};
};

inline constexpr double kGreatestControlValue = 3.0;

/// The controls of all annotated topologies, 60 of them, fine ones before those that carry them: a tip of the nose is
/// shaped, then turns with the nose, then is scaled with the face.
const std::vector<FaceControl>& AnatomicalControls();

}  // namespace daumier::faces
