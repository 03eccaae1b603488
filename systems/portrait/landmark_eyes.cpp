#include "systems/portrait/landmark_eyes.h"

#include "core/error.h"
#include "render/heat_map_decoding.h"
#include "render/region_boundary.h"
#include "systems/portrait/landmark_sample.h"
#include "systems/portrait/landmark_views.h"

#include <optional>

namespace daumier::portrait {

std::vector<float> SnapEyes(std::span<const float> landmarks, std::span<const float> labels, const CropFrame& frame,
                            double reach) {
  DAUMIER_CHECK(landmarks.size() == 2 * size_t(kNumLandmarks), "there are {} numbers of landmarks, expected {}",
                landmarks.size(), 2 * kNumLandmarks);
  const int side = LabelSide(frame.size);
  const double cell = double(frame.size) / side;
  const render::ScoreGrid grid(labels, kNumPictureClasses, side, side);
  const std::vector<render::BoundaryPiece> boundary =
      render::ZeroBoundary(grid.Margin(int(PictureClass::kEyes)), side, side);
  std::vector<float> snapped(landmarks.begin(), landmarks.end());
  const auto in_cells = [&](int i) -> Eigen::Vector2d {
    return frame.ToCrop({landmarks[2 * size_t(i)], landmarks[2 * size_t(i) + 1]}) / cell;
  };
  for (const int first : {36, 42}) {
    const double width = (in_cells(first) - in_cells(first + 3)).norm();
    for (int i = first; i < first + 6; ++i) {
      const std::optional<Eigen::Vector2d> nearest = render::NearestOnBoundary(boundary, in_cells(i), reach * width);
      if (!nearest) continue;
      const Eigen::Vector2d at = frame.ToPicture(*nearest * cell);
      snapped[2 * size_t(i)] = float(at.x());
      snapped[2 * size_t(i) + 1] = float(at.y());
    }
  }
  return snapped;
}

}  // namespace daumier::portrait
