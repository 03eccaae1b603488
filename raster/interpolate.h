#pragma once
#include "raster/visibility.h"

namespace daumier::raster {

/// Vertex attributes at the pixels: picture[p] = b0 a[i0] + b1 a[i1] + b2 a[i2] for the corners i of the triangle that
/// pixel p shows, 0 where it shows none. attributes: V x num_channels; picture: H x W x num_channels, written.
/// `raster` is that of Rasterise, with barycentrics.
template <class T>
void Interpolate(const MeshTopology& topology, const Raster<T>& raster, int num_channels, const T* attributes,
                 T* picture);

/// Adds the gradient of sum(picture * picture_gradient) to attribute_gradient (V x num_channels) and to
/// barycentric_gradient (H x W x 2); either may be null.
template <class T>
void InterpolateBackward(const MeshTopology& topology, const Raster<T>& raster, int num_channels, const T* attributes,
                         const T* picture_gradient, T* attribute_gradient, T* barycentric_gradient);

/// Slopes of the attributes over the picture, for the choice of mip levels: slopes, H x W x num_channels x 2, is written
/// with (d/dx, d/dy) a pixel, 0 where it shows nothing. No gradient passes through them.
template <class T>
void InterpolateSlopes(const MeshTopology& topology, const Raster<T>& raster, int num_channels, const T* attributes,
                       T* slopes);

}  // namespace daumier::raster
