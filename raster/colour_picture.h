#pragma once
#include "raster/crossings.h"
#include "raster/mesh_topology.h"
#include "raster/visibility.h"

#include <array>
#include <vector>

namespace daumier::raster {

struct PictureOptions {
  Facing facing = Facing::kFront;
  AntialiasOptions antialias = {};

  bool operator==(const PictureOptions&) const = default;
};

/// A picture of triangles with a colour a vertex: Rasterise, Interpolate and Antialias in one, and their gradient in
/// one. The same numbers to rounding, in a fraction of the time. One image: keep one object for each image of a batch;
/// its memory is reused from call to call.
template <class T>
class ColourPicture {
 public:
  /// positions: V x 4, homogeneous pixel coordinates (raster/camera.h). colours: V x 3. picture: H x W x 4, written:
  /// RGB over black and coverage 0..1, antialiased; in front of a background it is RGB + (1 - coverage) background.
  /// @throws Error as Rasterise.
  void Forward(const MeshTopology& topology, const T* positions, const T* colours, int height, int width,
               const PictureOptions& options, T* picture);

  /// The gradient of sum(picture * picture_gradient) of the last Forward; picture_gradient: H x W x 4. Written:
  /// position_gradient (V x 4, its third column 0) and colour_gradient (V x 3).
  void Backward(const MeshTopology& topology, const T* picture_gradient, T* position_gradient, T* colour_gradient);

  /// Of the last Forward, without barycentrics.
  const Raster<T>& raster() const { return raster_; }
  const std::vector<Crossing<T>>& crossings() const { return crossings_; }

 private:
  struct alignas(8 * sizeof(T)) VertexGradient {
    T position[4], colour[4];
  };

  void Interpolate(const MeshTopology& topology, T* picture);
  void InterpolateBackward(const MeshTopology& topology, const T* picture_gradient);
  void CrossingsBackward(const MeshTopology& topology, const T* picture_gradient, T* position_gradient);

  Raster<T> raster_;
  CrossingMemory<T> memory_;
  std::vector<Crossing<T>> crossings_;
  size_t num_covered_ = 0;
  std::vector<std::array<T, 4>> differences_;  ///< Colour at the edge minus that outside, of each crossing.
  std::vector<std::array<T, 4>> colours_;      ///< V: RGB, 1.
  std::vector<int> covered_;  ///< Pixels that show a triangle, ascending; the last repeated to a multiple of 4.
  std::vector<std::array<T, 8>> barycentrics_;  ///< b0, b1 of four of them.
  std::vector<VertexGradient> gradients_;
};

}  // namespace daumier::raster
