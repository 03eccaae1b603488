#include "raster/face_picture.h"

#include <algorithm>

namespace daumier::raster {

template <class T>
void FacePicture<T>::Forward(const MeshTopology& topology, const T* vertices, const T* albedo,
                             const std::array<T, kLightBands>& light, const Pose<T>& pose, const Camera& camera,
                             const PictureOptions& options, T* picture) {
  const int64_t num_vertices = topology.num_vertices;
  camera_ = camera, light_ = light, pose_ = pose;
  posed_.resize(3 * num_vertices), positions_.resize(4 * num_vertices);
  normals_.resize(3 * num_vertices), posed_normals_.resize(3 * num_vertices);
  shades_.resize(num_vertices), colours_.resize(3 * num_vertices);

  ApplyPose(pose, num_vertices, vertices, posed_.data());
  Project(camera, num_vertices, posed_.data(), positions_.data());
  VertexNormals(topology, vertices, normal_memory_, normals_.data());
  const Pose<T> rotation = {pose[0], pose[1], pose[2], T(0), T(0), T(0)};
  ApplyPose(rotation, num_vertices, normals_.data(), posed_normals_.data());
  Shade(light, num_vertices, posed_normals_.data(), shades_.data());
  for (int64_t v = 0; v < num_vertices; ++v) {
    for (int k = 0; k < 3; ++k) colours_[3 * v + k] = albedo[3 * v + k] * shades_[v];
  }
  picture_.Forward(topology, positions_.data(), colours_.data(), camera.height, camera.width, options, picture);
}

template <class T>
void FacePicture<T>::Backward(const MeshTopology& topology, const T* vertices, const T* albedo,
                              const T* picture_gradient, T* vertex_gradient, T* albedo_gradient,
                              std::array<T, kLightBands>& light_gradient, Pose<T>& pose_gradient) {
  const int64_t num_vertices = topology.num_vertices;
  position_gradient_.resize(4 * num_vertices), colour_gradient_.resize(3 * num_vertices);
  shade_gradient_.resize(num_vertices);
  picture_.Backward(topology, picture_gradient, position_gradient_.data(), colour_gradient_.data());

  std::fill_n(vertex_gradient, 3 * num_vertices, T(0));
  light_gradient.fill(T(0)), pose_gradient.fill(T(0));
  for (int64_t v = 0; v < num_vertices; ++v) {
    T sum = 0;
    for (int k = 0; k < 3; ++k) {
      albedo_gradient[3 * v + k] = colour_gradient_[3 * v + k] * shades_[v];
      sum += colour_gradient_[3 * v + k] * albedo[3 * v + k];
    }
    shade_gradient_[v] = sum;
  }
  posed_gradient_.assign(3 * num_vertices, T(0));
  ShadeBackward(light_, num_vertices, posed_normals_.data(), shade_gradient_.data(), light_gradient,
                posed_gradient_.data());
  normal_gradient_.assign(3 * num_vertices, T(0));
  Pose<T> rotation = {pose_[0], pose_[1], pose_[2], T(0), T(0), T(0)}, rotation_gradient = {};
  ApplyPoseBackward(rotation, num_vertices, normals_.data(), posed_gradient_.data(), rotation_gradient,
                    normal_gradient_.data());
  VertexNormalsBackward(topology, normal_memory_, normal_gradient_.data(), vertex_gradient);

  posed_gradient_.assign(3 * num_vertices, T(0));
  ProjectBackward(camera_, num_vertices, position_gradient_.data(), posed_gradient_.data());
  ApplyPoseBackward(pose_, num_vertices, vertices, posed_gradient_.data(), pose_gradient, vertex_gradient);
  for (int k = 0; k < 3; ++k) pose_gradient[k] += rotation_gradient[k];
}

template class FacePicture<float>;
template class FacePicture<double>;

}  // namespace daumier::raster
