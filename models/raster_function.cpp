#include "models/raster_function.h"

#include "core/error.h"
#include "raster/batch.h"
#include "raster/face_picture.h"
#include "tensor/shape.h"

#include <torch/csrc/autograd/custom_function.h>

#include <array>
#include <vector>

namespace daumier::models {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

void CheckRasterTensor(const torch::Tensor& tensor, at::IntArrayRef shape, at::ScalarType type, const char* name) {
  tensor::CheckShape(tensor, shape, name);
  DAUMIER_CHECK(tensor.is_cpu(), "{} is not in the memory of the CPU, where the renderer works", name);
  DAUMIER_CHECK(tensor.scalar_type() == type && (type == torch::kFloat32 || type == torch::kFloat64),
                "{} has numbers of type {}, expected float32 or float64 throughout", name,
                c10::toString(tensor.scalar_type()));
}

/// The pictures of a batch, as autograd keeps them from forward to backward.
template <class Picture>
struct PictureBatch : torch::CustomClassHolder {
  SharedTopology topology;
  std::vector<Picture> images;
};

template <class T>
torch::Tensor ForwardColours(AutogradContext* context, const SharedTopology& topology, const torch::Tensor& positions,
                             const torch::Tensor& colours, int height, int width,
                             const raster::PictureOptions& options) {
  auto batch = c10::make_intrusive<PictureBatch<raster::ColourPicture<T>>>();
  batch->topology = topology;
  batch->images.resize(positions.size(0));
  torch::Tensor pictures = torch::empty({positions.size(0), height, width, 4}, positions.options());
  const T *const p = positions.data_ptr<T>(), *const c = colours.data_ptr<T>();
  T* const to = pictures.data_ptr<T>();
  const int64_t num_vertices = topology->num_vertices;
  raster::ForEachImage(int(positions.size(0)), [&](int64_t i) {
    batch->images[i].Forward(*topology, p + 4 * num_vertices * i, c + 3 * num_vertices * i, height, width, options,
                             to + int64_t(height) * width * 4 * i);
  });
  context->saved_data["batch"] = c10::IValue::make_capsule(batch);
  return pictures;
}

template <class T>
variable_list BackwardColours(AutogradContext* context, const torch::Tensor& gradient) {
  const auto holder = context->saved_data["batch"].toCapsule();
  auto& batch = static_cast<PictureBatch<raster::ColourPicture<T>>&>(*holder);
  const int64_t count = int64_t(batch.images.size()), num_vertices = batch.topology->num_vertices;
  torch::Tensor by_positions = torch::empty({count, num_vertices, 4}, gradient.options());
  torch::Tensor by_colours = torch::empty({count, num_vertices, 3}, gradient.options());
  const T* const g = gradient.data_ptr<T>();
  T *const p = by_positions.data_ptr<T>(), *const c = by_colours.data_ptr<T>();
  raster::ForEachImage(int(count), [&](int64_t i) {
    batch.images[i].Backward(*batch.topology, g + batch.images[i].raster().num_pixels() * 4 * i,
                             p + 4 * num_vertices * i, c + 3 * num_vertices * i);
  });
  return {by_positions, by_colours};
}

class ColourFunction : public torch::autograd::Function<ColourFunction> {
 public:
  static torch::Tensor forward(AutogradContext* context, const torch::Tensor& positions, const torch::Tensor& colours,
                               const SharedTopology& topology, int64_t height, int64_t width,
                               const raster::PictureOptions& options) {
    return positions.scalar_type() == torch::kFloat64
               ? ForwardColours<double>(context, topology, positions, colours, int(height), int(width), options)
               : ForwardColours<float>(context, topology, positions, colours, int(height), int(width), options);
  }

  static variable_list backward(AutogradContext* context, const variable_list& gradients) {
    const torch::Tensor gradient = gradients[0].contiguous();
    variable_list by = gradient.scalar_type() == torch::kFloat64 ? BackwardColours<double>(context, gradient)
                                                                 : BackwardColours<float>(context, gradient);
    by.resize(6);  // Nothing for topology, sizes and options.
    return by;
  }
};

template <class T>
torch::Tensor ForwardFaces(AutogradContext* context, const SharedTopology& topology, const torch::Tensor& vertices,
                           const torch::Tensor& albedo, const torch::Tensor& light, const torch::Tensor& pose,
                           const raster::Camera& camera, const raster::PictureOptions& options) {
  auto batch = c10::make_intrusive<PictureBatch<raster::FacePicture<T>>>();
  batch->topology = topology;
  batch->images.resize(vertices.size(0));
  torch::Tensor pictures = torch::empty({vertices.size(0), camera.height, camera.width, 4}, vertices.options());
  const T *const v = vertices.data_ptr<T>(), *const a = albedo.data_ptr<T>(), *const l = light.data_ptr<T>(),
                 *const p = pose.data_ptr<T>();
  T* const to = pictures.data_ptr<T>();
  const int64_t size = 3 * int64_t(topology->num_vertices);
  raster::ForEachImage(int(vertices.size(0)), [&](int64_t i) {
    std::array<T, raster::kLightBands> light_of_image;
    raster::Pose<T> pose_of_image;
    std::copy_n(l + raster::kLightBands * i, raster::kLightBands, light_of_image.begin());
    std::copy_n(p + 6 * i, 6, pose_of_image.begin());
    batch->images[i].Forward(*topology, v + size * i, a + size * i, light_of_image, pose_of_image, camera, options,
                             to + int64_t(camera.height) * camera.width * 4 * i);
  });
  context->saved_data["batch"] = c10::IValue::make_capsule(batch);
  return pictures;
}

template <class T>
variable_list BackwardFaces(AutogradContext* context, const torch::Tensor& gradient) {
  const auto holder = context->saved_data["batch"].toCapsule();
  auto& batch = static_cast<PictureBatch<raster::FacePicture<T>>&>(*holder);
  const variable_list saved = context->get_saved_variables();
  const T *const v = saved[0].data_ptr<T>(), *const a = saved[1].data_ptr<T>(), *const g = gradient.data_ptr<T>();
  const int64_t count = int64_t(batch.images.size()), size = 3 * int64_t(batch.topology->num_vertices);
  const int64_t image_size = gradient[0].numel();
  torch::Tensor by_vertices = torch::empty_like(saved[0]), by_albedo = torch::empty_like(saved[1]);
  torch::Tensor by_light = torch::empty({count, raster::kLightBands}, gradient.options());
  torch::Tensor by_pose = torch::empty({count, 6}, gradient.options());
  T *const gv = by_vertices.data_ptr<T>(), *const ga = by_albedo.data_ptr<T>(), *const gl = by_light.data_ptr<T>(),
           *const gp = by_pose.data_ptr<T>();
  raster::ForEachImage(int(count), [&](int64_t i) {
    std::array<T, raster::kLightBands> light_gradient;
    raster::Pose<T> pose_gradient;
    batch.images[i].Backward(*batch.topology, v + size * i, a + size * i, g + image_size * i, gv + size * i,
                             ga + size * i, light_gradient, pose_gradient);
    std::copy_n(light_gradient.begin(), raster::kLightBands, gl + raster::kLightBands * i);
    std::copy_n(pose_gradient.begin(), 6, gp + 6 * i);
  });
  return {by_vertices, by_albedo, by_light, by_pose};
}

class FaceFunction : public torch::autograd::Function<FaceFunction> {
 public:
  static torch::Tensor forward(AutogradContext* context, const torch::Tensor& vertices, const torch::Tensor& albedo,
                               const torch::Tensor& light, const torch::Tensor& pose, const SharedTopology& topology,
                               const raster::Camera& camera, const raster::PictureOptions& options) {
    context->save_for_backward({vertices, albedo});
    return vertices.scalar_type() == torch::kFloat64
               ? ForwardFaces<double>(context, topology, vertices, albedo, light, pose, camera, options)
               : ForwardFaces<float>(context, topology, vertices, albedo, light, pose, camera, options);
  }

  static variable_list backward(AutogradContext* context, const variable_list& gradients) {
    const torch::Tensor gradient = gradients[0].contiguous();
    variable_list by = gradient.scalar_type() == torch::kFloat64 ? BackwardFaces<double>(context, gradient)
                                                                 : BackwardFaces<float>(context, gradient);
    by.resize(7);  // Nothing for topology, camera and options.
    return by;
  }
};

RenderedPictures SplitChannels(const torch::Tensor& rgba) {
  const torch::Tensor planes = rgba.permute({0, 3, 1, 2});
  return {planes.narrow(1, 0, 3), planes.narrow(1, 3, 1)};
}

}  // namespace

RenderedPictures RenderColours(const SharedTopology& topology, const torch::Tensor& positions,
                               const torch::Tensor& colours, int height, int width,
                               const raster::PictureOptions& options) {
  DAUMIER_CHECK(topology != nullptr, "RenderColours has no mesh");
  CheckRasterTensor(positions, {tensor::kAny, topology->num_vertices, 4}, positions.scalar_type(), "positions");
  CheckRasterTensor(colours, {positions.size(0), topology->num_vertices, 3}, positions.scalar_type(), "colours");
  return SplitChannels(ColourFunction::apply(positions.contiguous(), colours.contiguous(), topology, int64_t(height),
                                             int64_t(width), options));
}

RenderedPictures RenderFace(const SharedTopology& topology, const torch::Tensor& vertices, const torch::Tensor& albedo,
                            const torch::Tensor& light, const torch::Tensor& pose, const raster::Camera& camera,
                            const raster::PictureOptions& options) {
  DAUMIER_CHECK(topology != nullptr, "RenderFace has no mesh");
  const int64_t count = vertices.size(0);
  CheckRasterTensor(vertices, {tensor::kAny, topology->num_vertices, 3}, vertices.scalar_type(), "vertices");
  CheckRasterTensor(albedo, {count, topology->num_vertices, 3}, vertices.scalar_type(), "albedo");
  CheckRasterTensor(light, {count, raster::kLightBands}, vertices.scalar_type(), "light");
  CheckRasterTensor(pose, {count, 6}, vertices.scalar_type(), "pose");
  return SplitChannels(FaceFunction::apply(vertices.contiguous(), albedo.contiguous(), light.contiguous(),
                                           pose.contiguous(), topology, camera, options));
}

torch::Tensor PosedPoints(const torch::Tensor& vertices, const torch::Tensor& pose) {
  tensor::CheckShape(vertices, {tensor::kAny, tensor::kAny, 3}, "vertices");
  tensor::CheckShape(pose, {vertices.size(0), 6}, "pose");
  const auto angle = pose.narrow(1, 0, 3).unbind(1);
  const torch::Tensor cx = angle[0].cos(), sx = angle[0].sin(), cy = angle[1].cos(), sy = angle[1].sin(),
                      cz = angle[2].cos(), sz = angle[2].sin();
  const torch::Tensor rotation = torch::stack({cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx, sz * cy,
                                               sz * sy * sx + cz * cx, sz * sy * cx - cz * sx, -sy, cy * sx, cy * cx},
                                              1)
                                     .view({-1, 3, 3});
  return torch::matmul(vertices, rotation.transpose(1, 2)) + pose.narrow(1, 3, 3).unsqueeze(1);
}

torch::Tensor ProjectedPoints(const torch::Tensor& points, const raster::Camera& camera) {
  tensor::CheckShape(points, {tensor::kAny, tensor::kAny, 3}, "points");
  const auto p = points.unbind(2);
  const torch::Tensor w =
      camera.projection == raster::Camera::Projection::kPerspective ? camera.distance - p[2] : torch::ones_like(p[2]);
  return torch::stack(
      {camera.centre_x * w + camera.focal * p[0], camera.centre_y * w - camera.focal * p[1], -camera.focal * p[2], w},
      2);
}

torch::Tensor PointsInPicture(const torch::Tensor& vertices, const torch::Tensor& pose, const raster::Camera& camera) {
  const torch::Tensor positions = ProjectedPoints(PosedPoints(vertices, pose), camera);
  return positions.narrow(2, 0, 2) / positions.narrow(2, 3, 1);
}

}  // namespace daumier::models
