#pragma once
#include "raster/crossings.h"

#include <cstdint>
#include <vector>

namespace daumier::raster {

/// Attributes of the surface where silhouette edges cross: values[i] = (1 - weight) a[first] + weight a[second] for
/// crossing i. attributes: V x num_channels; values: crossings x num_channels, written.
template <class T>
void InterpolateCrossings(const std::vector<Crossing<T>>& crossings, int num_channels, const T* attributes, T* values);

/// Adds the gradient of sum(values * value_gradient) to attribute_gradient (V x num_channels) and to position_gradient
/// (V x 4; its third column is unchanged); either may be null.
template <class T>
void InterpolateCrossingsBackward(const std::vector<Crossing<T>>& crossings, const Raster<T>& raster, int num_channels,
                                  const T* attributes, const T* value_gradient, T* attribute_gradient,
                                  T* position_gradient);

/// Blends pixels along silhouettes. With the colours e of the surface at the edge and o of the pixel outside of it,
/// D = o - e if the surface is on the side of `pixel`, else e - o:
///   out[pixel] += G(alpha) D,  out[next] -= G(-alpha) D,  G(a) = integral over y in [-1/2, 1/2] of max(0, a + slope y),
/// which is the area of each pixel on the other side of a straight edge. picture, antialiased: num_pixels x
/// num_channels, not the same memory. edge_values: crossings x num_channels, of InterpolateCrossings. The colour at the
/// edge is not that of the pixel's centre: with the latter the gradient of a shaded surface is biased.
template <class T>
void Antialias(const std::vector<Crossing<T>>& crossings, int64_t num_pixels, int num_channels, const T* picture,
               const T* edge_values, T* antialiased);

/// Adds the gradient of sum(antialiased * antialiased_gradient) to picture_gradient (H x W x num_channels),
/// edge_value_gradient (crossings x num_channels) and position_gradient (V x 4; its third column is unchanged). `slope` is
/// held constant: it only decides how a movement of the edge is divided between the two pixels. With P the sum over
/// channels of (G'(alpha) g[pixel] + G'(-alpha) g[next]) D, and x along the pair:
///   dL/dx_first = -P (1 - share), dL/dx_second = -P share, dL/dy = -slope dL/dx.
template <class T>
void AntialiasBackward(const std::vector<Crossing<T>>& crossings, const Raster<T>& raster, int num_channels,
                       const T* picture, const T* edge_values, const T* antialiased_gradient, T* picture_gradient,
                       T* edge_value_gradient, T* position_gradient);

}  // namespace daumier::raster
