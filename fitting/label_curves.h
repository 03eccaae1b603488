#pragma once
#include "faces/drawing_terms.h"
#include "faces/face_model.h"
#include "faces/face_points.h"

#include <vector>

namespace daumier::fitting {

/// A line of a template that lines of a drawing with some label show.
struct LabelCurve {
  faces::LineLabel label = faces::LineLabel::kOther;
  std::vector<int> vertices;  ///< A closed one repeats its first vertex at its end.
  bool closed = false;
  int side = 0;      ///< Of the pairs among them: 0 the face's right, 1 its left.
  double trust = 1;  ///< Weight of its matches: lines of features that people draw freely count less.
};

/// Silhouette: the contours of FacePointVertices and the curve `cranium` (without both, `silhouette`); ears; brows as
/// outlines; lids; nose: wings and base, since its bridge is drawn where its shadow is; lips: the outline's upper and
/// lower half, from corner to corner; inner mouth: upper_mouth and lower_mouth. Curves that the template lacks are left
/// out. Hair, neck, wrinkles, irises and others have none: they say nothing of the shape.
std::vector<LabelCurve> FindLabelCurves(const faces::FaceTemplate& face_template,
                                        const faces::FacePointVertices& points);

/// The two lines of an opening, paired point by point from the face's right to its left: vertices of the one and places
/// of the other. `upper` and `lower` meet at the corners.
struct GapPair {
  int upper = 0;
  faces::PolylinePlace lower;
  double share = 0;  ///< 0 and 1 at the corners.
};

enum class Opening { kMouth, kRightEye, kLeftEye };
inline constexpr int kNumOpenings = 3;

struct OpeningPairs {
  Opening opening = Opening::kMouth;
  std::vector<int> upper, lower;  ///< The lines from the face's right to its left.
  std::vector<GapPair> pairs;     ///< One of each vertex of `upper`.
};

/// Places are paired by shares of lengths on the neutral face between corners and landmarks (61 with 67, 62 with 66, 63
/// with 65; 37 with 41, 38 with 40, 43 with 47, 44 with 46) that lie on the lines. Openings without curves are left out.
std::vector<OpeningPairs> FindOpeningPairs(const faces::FaceTemplate& face_template);

}  // namespace daumier::fitting
