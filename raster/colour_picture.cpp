#include "raster/colour_picture.h"

#include "core/error.h"
#include "raster/lanes.h"
#include "raster/surface_point.h"

#include <algorithm>

namespace daumier::raster {

template <class T>
void ColourPicture<T>::Forward(const MeshTopology& topology, const T* positions, const T* colours, int height,
                               int width, const PictureOptions& options, T* picture) {
  FindVisibleTriangles(topology, positions, height, width, options.facing, raster_);
  colours_.resize(topology.num_vertices);
  T differences = 0;  // x - x is 0 for finite numbers alone.
  for (int64_t v = 0; v < topology.num_vertices; ++v) {
    colours_[v] = {colours[3 * v], colours[3 * v + 1], colours[3 * v + 2], T(1)};
    for (int k = 0; k < 3; ++k) differences += colours[3 * v + k] - colours[3 * v + k];
  }
  DAUMIER_CHECK(differences == 0, "colours have a number that is not finite");

  std::fill_n(picture, 4 * raster_.num_pixels(), T(0));
  raster_.barycentric.resize(2 * raster_.num_pixels());
  ForEachCoveredPixel(topology, raster_, [&](int64_t pixel, const std::array<int, 3>& corners, T fx, T fy) {
    const SurfacePoint<T> point = SurfacePointAt(raster_.vertices[corners[0]], raster_.vertices[corners[1]],
                                                 raster_.vertices[corners[2]], fx, fy);
    const T b0 = point.u[0] * point.inverse_sum, b1 = point.u[1] * point.inverse_sum;
    raster_.barycentric[2 * pixel] = b0;
    raster_.barycentric[2 * pixel + 1] = b1;
    Lanes<T> c0, c1, c2;
    LoadLanes(colours_[corners[0]].data(), c0);
    LoadLanes(colours_[corners[1]].data(), c1);
    LoadLanes(colours_[corners[2]].data(), c2);
    StoreLanes<T>(picture + 4 * pixel, b0 * (c0 - c2) + b1 * (c1 - c2) + c2);  // Coverage is 1 exactly.
  });

  FindCrossings(topology, raster_, options.facing, options.antialias, memory_, crossings_);
  differences_.resize(crossings_.size());
  for (size_t i = 0; i < crossings_.size(); ++i) {
    const Crossing<T>& crossing = crossings_[i];
    Lanes<T> first, second, outside;
    LoadLanes(colours_[crossing.first].data(), first);
    LoadLanes(colours_[crossing.second].data(), second);
    LoadLanes(picture + 4 * int64_t(crossing.outside()), outside);
    StoreLanes<T>(differences_[i].data(), first + crossing.weight * (second - first) - outside);
  }
  for (size_t i = 0; i < crossings_.size(); ++i) {
    const Crossing<T>& crossing = crossings_[i];
    const T sign = crossing.surface_is_next ? T(1) : T(-1);
    T *const pixel = picture + 4 * int64_t(crossing.pixel), *const next = picture + 4 * int64_t(crossing.next);
    Lanes<T> difference, old_pixel, old_next;
    LoadLanes(differences_[i].data(), difference);
    LoadLanes(pixel, old_pixel);
    LoadLanes(next, old_next);
    StoreLanes<T>(pixel, old_pixel + sign * crossing.Area(crossing.alpha) * difference);
    StoreLanes<T>(next, old_next - sign * crossing.Area(-crossing.alpha) * difference);
  }
}

template <class T>
inline __attribute__((always_inline)) void ColourPicture<T>::PixelBackward(const MeshTopology& topology, int64_t pixel,
                                                                           T fx, T fy, const T* gradient) {
  const auto& corners = topology.triangles[raster_.triangle[pixel]];
  Lanes<T> g, c0, c1, c2;
  LoadLanes(gradient, g);
  g[3] = 0;  // Coverage is constant inside.
  LoadLanes(colours_[corners[0]].data(), c0);
  LoadLanes(colours_[corners[1]].data(), c1);
  LoadLanes(colours_[corners[2]].data(), c2);
  const SurfacePoint<T> point =
      SurfacePointAt(raster_.vertices[corners[0]], raster_.vertices[corners[1]], raster_.vertices[corners[2]], fx, fy);
  const T b0 = raster_.barycentric[2 * pixel], b1 = raster_.barycentric[2 * pixel + 1], b2 = 1 - b0 - b1;
  // Colours minus the pixel's: their weighted slopes are those of the colour, without cancellation.
  const Lanes<T> mean = b0 * (c0 - c2) + b1 * (c1 - c2) + c2;
  const Lanes<T> slope_x = point.u_dx[0] * (c0 - mean) + point.u_dx[1] * (c1 - mean) + point.u_dx[2] * (c2 - mean);
  const Lanes<T> slope_y = point.u_dy[0] * (c0 - mean) + point.u_dy[1] * (c1 - mean) + point.u_dy[2] * (c2 - mean);
  const Lanes<T> along_x = g * slope_x, along_y = g * slope_y;
  const T qx = -(along_x[0] + along_x[1] + along_x[2]) * point.inverse_area;
  const T qy = -(along_y[0] + along_y[1] + along_y[2]) * point.inverse_area;
  const Lanes<T> q = {qx, qy, T(0), -(fx * qx + fy * qy)};
  const T b[3] = {b0, b1, b2};
  for (int k = 0; k < 3; ++k) {
    VertexGradient& to = gradients_[corners[k]];
    Lanes<T> position, colour;
    LoadLanes(to.position, position);
    LoadLanes(to.colour, colour);
    StoreLanes<T>(to.position, position + b[k] * q);
    StoreLanes<T>(to.colour, colour + b[k] * g);
  }
}

template <class T>
void ColourPicture<T>::Backward(const MeshTopology& topology, const T* picture_gradient, T* position_gradient,
                                T* colour_gradient) {
  gradients_.assign(topology.num_vertices, {});
  for (int row = 0; row < raster_.height; ++row) {
    for (int column = 0; column < raster_.width; ++column) {
      const int64_t pixel = int64_t(row) * raster_.width + column;
      if (raster_.triangle[pixel] < 0) continue;
      PixelBackward(topology, pixel, T(column) + T(0.5), T(row) + T(0.5), picture_gradient + 4 * pixel);
    }
  }
  // A blend passes gradient to the edge, to its colour, and to the colour of the pixel outside.
  std::fill_n(position_gradient, 4 * int64_t(topology.num_vertices), T(0));
  for (size_t i = 0; i < crossings_.size(); ++i) {
    const Crossing<T>& crossing = crossings_[i];
    const T sign = crossing.surface_is_next ? T(1) : T(-1), lean = crossing.AreaSlope();
    const T to_pixel = sign * crossing.Area(crossing.alpha), to_next = -sign * crossing.Area(-crossing.alpha);
    const T *const g_pixel = picture_gradient + 4 * int64_t(crossing.pixel), *const g_next = picture_gradient +
                                                                                             4 * int64_t(crossing.next);
    VertexGradient &first = gradients_[crossing.first], &second = gradients_[crossing.second];
    T by_alpha = 0, by_weight = 0, outside_gradient[4];
    for (int k = 0; k < 4; ++k) {
      by_alpha += sign * differences_[i][k] * (lean * g_pixel[k] + (1 - lean) * g_next[k]);
      const T g = to_pixel * g_pixel[k] + to_next * g_next[k];
      by_weight += g * (colours_[crossing.second][k] - colours_[crossing.first][k]);
      first.colour[k] += (1 - crossing.weight) * g;
      second.colour[k] += crossing.weight * g;
      outside_gradient[k] = -g;
    }
    CrossingBackward(crossing, raster_, -by_alpha, by_weight, position_gradient);
    const int outside = crossing.outside();
    if (raster_.triangle[outside] < 0) continue;
    PixelBackward(topology, outside, T(outside % raster_.width) + T(0.5), T(outside / raster_.width) + T(0.5),
                  outside_gradient);
  }
  for (int64_t v = 0; v < topology.num_vertices; ++v) {
    for (int k = 0; k < 4; ++k) position_gradient[4 * v + k] += gradients_[v].position[k];
    for (int k = 0; k < 3; ++k) colour_gradient[3 * v + k] = gradients_[v].colour[k];
  }
}

template class ColourPicture<float>;
template class ColourPicture<double>;

}  // namespace daumier::raster
