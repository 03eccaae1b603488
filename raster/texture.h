#pragma once
#include <cstdint>
#include <vector>

namespace daumier::raster {

/// A picture of any number of channels, row-major, channels next to each other.
template <class T>
struct Texture {
  int height = 0, width = 0, num_channels = 0;
  std::vector<T> texels;  ///< height x width x num_channels, row 0 on top.
};

/// A texture and its halves, quarters and so on, for pictures that show it smaller.
template <class T>
using MipMap = std::vector<Texture<T>>;

/// Coordinates outside of 0..1.
enum class Wrap {
  kClamp,   ///< The nearest texel of the border.
  kRepeat,  ///< The texture repeats.
};

/// Bilinear texture lookup. uv: num_points x 2, u to the right and v up as in OBJ, (0, 0) the lower left corner of the
/// picture, so that the centre of texel (row, column) is ((column + 1/2) / width, 1 - (row + 1/2) / height). values:
/// num_points x num_channels, written. shown: num_points, values are 0 where it is negative (Raster::triangle); or null.
/// @throws Error if the texture has no texels, or not height x width x num_channels of them, or a shown coordinate is not
/// finite.
template <class T>
void LookUpTexture(const Texture<T>& texture, Wrap wrap, int64_t num_points, const T* uv, const int* shown, T* values);

/// Adds the gradient of sum(values * value_gradient) to texture_gradient (as texels) and uv_gradient (num_points x 2);
/// either may be null. Between texels the derivative by uv is that of the cell to the right and below.
template <class T>
void LookUpTextureBackward(const Texture<T>& texture, Wrap wrap, int64_t num_points, const T* uv, const int* shown,
                           const T* value_gradient, T* texture_gradient, T* uv_gradient);

/// Levels of half the size, each the mean of 2 x 2 texels, until a side is odd; a side of 1 stays. Level 0 is the texture.
template <class T>
MipMap<T> MakeMipMap(const Texture<T>& texture);

/// Gradient by the texture, given those by the texels of all levels: adds each level's to the one above, then
/// level_gradients[0] is the result.
template <class T>
void MipMapBackward(MipMap<T>& level_gradients);

/// The level at which a texel is about a pixel: log2 of the larger of the lengths, in texels, of the slopes of uv along x
/// and y; cut to 0..num_levels - 1. uv_slopes: num_points x 2 x 2 of InterpolateSlopes; levels: num_points, written. The
/// choice of a level carries no gradient.
template <class T>
void ChooseLevels(const MipMap<T>& mip_map, int64_t num_points, const T* uv_slopes, T* levels);

/// Trilinear lookup: between the bilinear values of the two levels next to levels[point]. Arguments as LookUpTexture.
template <class T>
void LookUpMipMap(const MipMap<T>& mip_map, Wrap wrap, int64_t num_points, const T* uv, const T* levels,
                  const int* shown, T* values);

/// Adds the gradient of sum(values * value_gradient) to level_gradients (as the mip map; see MipMapBackward) and
/// uv_gradient (num_points x 2); either may be null.
template <class T>
void LookUpMipMapBackward(const MipMap<T>& mip_map, Wrap wrap, int64_t num_points, const T* uv, const T* levels,
                          const int* shown, const T* value_gradient, MipMap<T>* level_gradients, T* uv_gradient);

}  // namespace daumier::raster
