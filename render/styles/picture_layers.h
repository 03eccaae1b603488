#pragma once
#include "render/styles/colour_planes.h"
#include "render/styles/picture_buffers.h"

namespace daumier::render {

/// The buffers at the size of the picture: means over the covered samples of each pixel.
struct PictureLayers {
  int height = 0, width = 0;
  float scale = 1;          ///< Height / 224: pixels a unit of lengths in StyleChoice.
  float pixels_per_cm = 1;  ///< Of the picture.
  ColourPlanes albedo;      ///< 0 where nothing is covered, as normal and shade.
  ColourPlanes normal;      ///< Not normalised again.
  Plane shade;
  Plane depth;                          ///< Of the nearest sample; kBackgroundDepth where there is none.
  Plane coverage;                       ///< Share of samples that are covered.
  std::vector<uint8_t> classes, parts;  ///< Of the nearest sample.

  size_t size() const { return size_t(height) * width; }
};

/// Without supersampling, a covered pixel at a border of class, part or coverage takes the weighted mean of the covered
/// ones of its 3 x 3 neighbourhood (weights 1 2 1 an axis), and the share of weight that is covered.
/// @throws Error as CheckPictureBuffers, or if a value of a covered pixel is not finite.
PictureLayers MakePictureLayers(const PictureBuffers& buffers);

}  // namespace daumier::render
