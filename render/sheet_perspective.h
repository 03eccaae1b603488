#pragma once
#include "render/photo_sheet.h"

namespace daumier::render {

/// Width over height of the sheet. It is that of a rectangle in perspective whose camera looks at the middle of a
/// picture of `height` x `width` [Zhang and He 2007], and that of the nearest usual format (square, A4, letter, 4:3,
/// 3:2) where it is within some percent.
double SheetAspect(const PhotoSheet& sheet, int height, int width);

/// The homography from the pixels of RectifySheet to those of a picture of `height` x `width`.
Eigen::Matrix3d PictureFromRectified(const PhotoSheet& sheet, int height, int width);

/// The sheet seen from above, as many pixels as the picture has of it, without a narrow strip along its sides.
/// @throws Error if the picture is empty.
Image RectifySheet(const Image& picture, const PhotoSheet& sheet);

}  // namespace daumier::render
