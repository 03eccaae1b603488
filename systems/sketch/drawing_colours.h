#pragma once
#include "render/image.h"
#include "render/strokes.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace daumier::sketch {

/// What a coloured drawing shows of a face's colours, RGB in 0 .. 1; absent where it leaves paper.
struct DrawnColours {
  std::optional<Eigen::Vector3f> skin, lips, brows, iris;
};

/// The colours of a drawing by regions of the face: the median of the coloured pixels (those whose largest channel is
/// at least 0.1 above the smallest) of a region, if they are at least a fifth of it, of thin parts a tenth.
/// A part whose colour is the skin's (no channel farther than 0.08) is absent: it is not coloured.
///   skin  within the silhouette and below the brows, without eyes, brows, lips and mouth
///   lips  within the lips' border, without the mouth between them
///   brows within each brow's border
///   iris  within each eye's lids
/// picture: RGB or grey, of which nothing is coloured. curves: the face's feature curves (kinds as faces::CurveKinds()) in
/// pixels of the picture. Regions without their curves are absent.
DrawnColours FindDrawnColours(const render::Image& picture, const std::vector<render::Stroke>& curves);

}  // namespace daumier::sketch
