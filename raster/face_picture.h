#pragma once
#include "raster/camera.h"
#include "raster/colour_picture.h"
#include "raster/rigid_pose.h"
#include "raster/spherical_harmonics.h"
#include "raster/vertex_normals.h"

#include <vector>

namespace daumier::raster {

/// A shaded face [Deng et al. 2019]: posed = R v + t, colour = albedo * shade(R n(v)), then ColourPicture. One image; its
/// memory is reused from call to call.
template <class T>
class FacePicture {
 public:
  /// vertices: V x 3, cm, in the model's frame; albedo: V x 3, 0..1. picture: H x W x 4 of the camera, written: RGB over
  /// black and coverage. @throws Error as Rasterise.
  void Forward(const MeshTopology& topology, const T* vertices, const T* albedo,
               const std::array<T, kLightBands>& light, const Pose<T>& pose, const Camera& camera,
               const PictureOptions& options, T* picture);

  /// The gradient of sum(picture * picture_gradient) of the last Forward, whose vertices and albedo are given again.
  /// Written: vertex_gradient, albedo_gradient (V x 3), light_gradient, pose_gradient.
  void Backward(const MeshTopology& topology, const T* vertices, const T* albedo, const T* picture_gradient,
                T* vertex_gradient, T* albedo_gradient, std::array<T, kLightBands>& light_gradient,
                Pose<T>& pose_gradient);

  const ColourPicture<T>& picture() const { return picture_; }

 private:
  ColourPicture<T> picture_;
  NormalMemory<T> normal_memory_;
  Camera camera_;
  std::array<T, kLightBands> light_ = {};
  Pose<T> pose_ = {};
  std::vector<T> posed_, positions_;        ///< V x 3, V x 4
  std::vector<T> normals_, posed_normals_;  ///< V x 3
  std::vector<T> shades_, colours_;         ///< V, V x 3
  std::vector<T> position_gradient_, colour_gradient_, shade_gradient_, normal_gradient_, posed_gradient_;
};

}  // namespace daumier::raster
