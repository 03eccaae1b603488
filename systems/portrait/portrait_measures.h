#pragma once
#include "faces/face_model.h"
#include "faces/openings.h"
#include "fitting/portrait_view.h"
#include "geometry/mesh.h"

#include <array>
#include <optional>

namespace daumier::portrait {

/// What is counted of a predicted shape.
class ShapeMeasure {
 public:
  explicit ShapeMeasure(const faces::FaceTemplate& face_template);

  /// Mean distance of the vertices of the region "face" after the similarity that aligns them best in the least-squares
  /// sense, mm (faces::MillimetresPerCm). Zero iff the shapes are similar. predicted, truth: V x 3, cm.
  double SimilarityErrorMm(const geometry::Points& predicted, const geometry::Points& truth) const;
  /// Gaps between the lids of the right and the left eye and between the lips, mm, as PortraitDatabase::states.
  std::array<double, 3> GapsMm(const geometry::Points& vertices) const;

 private:
  const double mm_per_cm_;
  Eigen::VectorXd weights_;  ///< V: 1 in the region, else 0.
  const faces::FaceOpenings openings_;
};

/// From which gap on an eye or a mouth counts as open, mm.
inline constexpr double kClosedMm = 1.5;

/// Errors of openings of one face: absent where the face does not show it.
struct OpeningErrors {
  std::optional<double> closed_eyes;  ///< mm, mean over the eyes that are closed in truth.
  std::optional<double> wink;         ///< mm, of the difference of the gaps where one eye alone is closed.
  double mouth = 0;                   ///< mm
};
OpeningErrors CompareGaps(const std::array<double, 3>& predicted, const std::array<float, 3>& truth);

}  // namespace daumier::portrait
