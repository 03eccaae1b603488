#pragma once
#include "render/image.h"

#include <Eigen/Geometry>

#include <array>
#include <span>
#include <vector>

namespace daumier::portrait {

/// An upright rectangle in a picture, pixels.
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
  double area() const { return width() * height(); }
  /// The longer side.
  double side() const { return width() > height() ? width() : height(); }
  Eigen::Vector2d centre() const { return {0.5 * (left + right), 0.5 * (top + bottom)}; }
};

/// The least box that holds all points, n x 2 (x0 y0 x1 y1 ...). @throws Error if there is no point.
Box BoxOf(std::span<const float> points);

/// Area of the intersection over area of the union; 0 for empty boxes.
double Overlap(const Box& a, const Box& b);

/// A square of a picture as a network reads it:
///   p_picture = centre + side / size * R(turn) S M (p_crop - size / 2),
/// M mirrors x if `mirrored`, S = diag(e^(stretch / 2), e^(-stretch / 2)), R turns x towards y (clockwise, as y points
/// down).
struct CropFrame {
  Eigen::Vector2d centre = {0, 0};  ///< Pixels of the picture.
  double side = 1;                  ///< Pixels of the picture.
  double turn = 0;                  ///< Radians.
  double stretch = 0;               ///< Of training alone: what is shown becomes narrower if positive.
  bool mirrored = false;
  int size = 128;  ///< Pixels of the crop.

  /// Pixels of the picture to one of the crop.
  double scale() const { return side / size; }
  Eigen::Matrix2d picture_from_crop() const;
  /// Of many points: takes those of the picture to the crop.
  Eigen::Affine2d crop_from_picture() const;
  Eigen::Vector2d ToPicture(const Eigen::Vector2d& p_crop) const;
  Eigen::Vector2d ToCrop(const Eigen::Vector2d& p_picture) const;
};

/// A picture and its halves, RGB: level k has 2^k x 2^k pixels of the picture to one of its own, an incomplete last row or
/// column left out.
class PicturePyramid {
 public:
  /// Grey pictures become RGB. @throws Error if the picture is empty.
  explicit PicturePyramid(const render::Image& picture);

  int height() const { return levels_.front().height; }
  int width() const { return levels_.front().width; }
  const render::Image& level(int k) const { return levels_[size_t(k)]; }
  int num_levels() const { return int(levels_.size()); }

 private:
  std::vector<render::Image> levels_;
};

/// What a crop shows outside of the picture.
struct Outside {
  bool continued = true;                             ///< The border's pixels; otherwise the colour.
  std::array<float, 3> colour = {0.5f, 0.5f, 0.5f};  ///< 0..1
};

/// The crop as numbers of 0..1, 3 x size x size, the colours one after the other. Each pixel is looked up bilinearly at
/// its centre, in the level of the pyramid whose pixels are at most 1.4 times as small. Written to `crop`.
/// moved: if not empty, Bulges::Field of all pixels: from where in the crop each comes, 2 x size x size.
/// @throws Error if it has another size.
void SampleCrop(const PicturePyramid& picture, const CropFrame& frame, const Outside& outside, std::span<float> crop,
                std::span<const float> moved = {});
std::vector<float> SampleCrop(const PicturePyramid& picture, const CropFrame& frame, const Outside& outside = {});

/// The value of a grey picture of classes at the centre of each of cells x cells squares of the crop; `none` outside of
/// the picture. moved: as of SampleCrop, 2 x cells x cells. @throws Error if the mask is not grey.
std::vector<int64_t> SampleLabels(const render::Image& mask, const CropFrame& frame, int cells, int64_t none,
                                  std::span<const float> moved = {});

/// The frame of a face with that box: upright, centred on it, kCropSide of its longer side.
inline constexpr double kCropSide = 1.5;
CropFrame FrameOfBox(const Box& box, int size);

/// The image of each of the 68 landmarks in a mirror: the landmark whose place it takes. An involution.
const std::array<int, 68>& MirroredLandmarks();

}  // namespace daumier::portrait
