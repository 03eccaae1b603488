#include "raster/colour_picture.h"

#include "core/error.h"
#include "raster/lanes.h"
#include "raster/surface_point.h"

#include <algorithm>

namespace daumier::raster {
namespace {

/// SurfacePoint of four pixels at once: about four times as fast.
template <class T>
struct FourSurfacePoints {
  FourSurfacePoints(const MeshTopology& topology, const Raster<T>& raster, const int* pixels) {
    for (int k = 0; k < 4; ++k) {
      const auto& corners = topology.triangles[raster.triangle[pixels[k]]];
      for (int j = 0; j < 3; ++j) rows[j][k] = corners[j];
      const int row = pixels[k] / raster.width;
      fx[k] = T(pixels[k] - row * raster.width) + T(0.5);
      fy[k] = T(row) + T(0.5);
    }
    Lanes<T> p0[4], p1[4], p2[4];
    GatherRecords(&raster.vertices[0].x, 4, rows[0], p0);
    GatherRecords(&raster.vertices[0].x, 4, rows[1], p1);
    GatherRecords(&raster.vertices[0].x, 4, rows[2], p2);
    const Lanes<T> x0 = p0[0] - fx, y0 = p0[1] - fy, x1 = p1[0] - fx, y1 = p1[1] - fy, x2 = p2[0] - fx, y2 = p2[1] - fy;
    e[0] = x1 * y2 - x2 * y1, e[1] = x2 * y0 - x0 * y2, e[2] = x0 * y1 - x1 * y0;
    u_dx[0] = (y1 - y2) * p0[3], u_dx[1] = (y2 - y0) * p1[3], u_dx[2] = (y0 - y1) * p2[3];
    u_dy[0] = (x2 - x1) * p0[3], u_dy[1] = (x0 - x2) * p1[3], u_dy[2] = (x1 - x0) * p2[3];
    for (int j = 0; j < 3; ++j) u[j] = e[j] * (j == 0 ? p0[3] : j == 1 ? p1[3] : p2[3]);
  }

  int64_t rows[3][4];  ///< The corners' vertices.
  Lanes<T> fx, fy, e[3], u[3], u_dx[3], u_dy[3];
};

}  // namespace

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

  Interpolate(topology, picture);
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
void ColourPicture<T>::Interpolate(const MeshTopology& topology, T* picture) {
  const int num_pixels = static_cast<int>(raster_.num_pixels());
  covered_.resize(num_pixels + 4);
  int* end = covered_.data();
  for (int pixel = 0; pixel < num_pixels; ++pixel) {
    *end = pixel;
    end += raster_.triangle[pixel] >= 0 ? 1 : 0;
  }
  num_covered_ = size_t(end - covered_.data());
  covered_.resize((num_covered_ + 3) / 4 * 4);
  for (size_t i = num_covered_; i < covered_.size(); ++i) covered_[i] = covered_[num_covered_ - 1];
  barycentrics_.resize(covered_.size() / 4);

  std::fill_n(picture, 4 * raster_.num_pixels(), T(0));
  for (size_t i = 0; i < covered_.size(); i += 4) {
    const FourSurfacePoints<T> points(topology, raster_, &covered_[i]);
    const Lanes<T> inverse_sum = 1 / (points.u[0] + points.u[1] + points.u[2]);
    const Lanes<T> b0 = points.u[0] * inverse_sum, b1 = points.u[1] * inverse_sum;
    StoreLanes<T>(barycentrics_[i / 4].data(), b0);
    StoreLanes<T>(barycentrics_[i / 4].data() + 4, b1);
    for (int k = 0; k < 4; ++k) {
      Lanes<T> c0, c1, c2;
      LoadLanes(colours_[points.rows[0][k]].data(), c0);
      LoadLanes(colours_[points.rows[1][k]].data(), c1);
      LoadLanes(colours_[points.rows[2][k]].data(), c2);
      // Coverage is 1 exactly.
      StoreLanes<T>(picture + 4 * int64_t(covered_[i + k]), b0[k] * (c0 - c2) + b1[k] * (c1 - c2) + c2);
    }
  }
}

template <class T>
void ColourPicture<T>::InterpolateBackward(const MeshTopology& topology, const T* picture_gradient) {
  for (size_t i = 0; i < covered_.size(); i += 4) {
    const FourSurfacePoints<T> points(topology, raster_, &covered_[i]);
    Lanes<T> b[3], g[4], along[3];
    LoadLanes(barycentrics_[i / 4].data(), b[0]);
    LoadLanes(barycentrics_[i / 4].data() + 4, b[1]);
    b[2] = 1 - b[0] - b[1];
    GatherRecords(picture_gradient, 4, &covered_[i], g);
    for (int j = 0; j < 3; ++j) {
      Lanes<T> colour[4];
      GatherRecords(colours_[0].data(), 4, points.rows[j], colour);
      along[j] = g[0] * colour[0] + g[1] * colour[1] + g[2] * colour[2];
    }
    const Lanes<T> mean = b[0] * along[0] + b[1] * along[1] + b[2] * along[2];
    const Lanes<T> inverse_area = -1 / (points.e[0] + points.e[1] + points.e[2]);
    Lanes<T> q[4] = {};
    for (int j = 0; j < 3; ++j) {
      q[0] += points.u_dx[j] * (along[j] - mean);
      q[1] += points.u_dy[j] * (along[j] - mean);
    }
    q[0] *= inverse_area, q[1] *= inverse_area;
    q[3] = -(points.fx * q[0] + points.fy * q[1]);
    Transpose<T>(q[0], q[1], q[2], q[3]);
    g[3] = Lanes<T>{};  // Coverage is constant inside.
    Transpose<T>(g[0], g[1], g[2], g[3]);
    const int count = static_cast<int>(std::min<size_t>(4, num_covered_ - i));
    for (int k = 0; k < count; ++k) {
      for (int j = 0; j < 3; ++j) {
        VertexGradient& to = gradients_[points.rows[j][k]];
        AddLanes<T>(to.position, b[j][k], q[k]);
        AddLanes<T>(to.colour, b[j][k], g[k]);
      }
    }
  }
}

/// A blend passes gradient to the edge, to its colour, and to the colour of the pixel outside.
template <class T>
void ColourPicture<T>::CrossingsBackward(const MeshTopology& topology, const T* picture_gradient,
                                         T* position_gradient) {
  for (size_t i = 0; i < crossings_.size(); ++i) {
    const Crossing<T>& crossing = crossings_[i];
    const T sign = crossing.surface_is_next ? T(1) : T(-1), lean = crossing.AreaSlope();
    const T to_pixel = sign * crossing.Area(crossing.alpha), to_next = -sign * crossing.Area(-crossing.alpha);
    const T *const g_pixel = picture_gradient + 4 * int64_t(crossing.pixel), *const g_next = picture_gradient +
                                                                                             4 * int64_t(crossing.next);
    VertexGradient &first = gradients_[crossing.first], &second = gradients_[crossing.second];
    T by_alpha = 0, by_weight = 0, g[4];
    for (int k = 0; k < 4; ++k) {
      by_alpha += sign * differences_[i][k] * (lean * g_pixel[k] + (1 - lean) * g_next[k]);
      g[k] = to_pixel * g_pixel[k] + to_next * g_next[k];
      by_weight += g[k] * (colours_[crossing.second][k] - colours_[crossing.first][k]);
      first.colour[k] += (1 - crossing.weight) * g[k];
      second.colour[k] += crossing.weight * g[k];
    }
    CrossingBackward(crossing, raster_, -by_alpha, by_weight, position_gradient);

    const int outside = crossing.outside();
    if (raster_.triangle[outside] < 0) continue;
    const auto& corners = topology.triangles[raster_.triangle[outside]];
    const T fx = T(outside % raster_.width) + T(0.5), fy = T(outside / raster_.width) + T(0.5);
    const SurfacePoint<T> point = SurfacePointAt(raster_.vertices[corners[0]], raster_.vertices[corners[1]],
                                                 raster_.vertices[corners[2]], fx, fy);
    T mean = 0, along[3], b[3], qx = 0, qy = 0;
    for (int j = 0; j < 3; ++j) {
      const auto& colour = colours_[corners[j]];
      b[j] = point.u[j] * point.inverse_sum;
      along[j] = g[0] * colour[0] + g[1] * colour[1] + g[2] * colour[2];
      mean += b[j] * along[j];
    }
    for (int j = 0; j < 3; ++j) {
      qx += point.u_dx[j] * (along[j] - mean) * point.inverse_area;
      qy += point.u_dy[j] * (along[j] - mean) * point.inverse_area;
    }
    for (int j = 0; j < 3; ++j) {
      T* const to = position_gradient + 4 * int64_t(corners[j]);
      to[0] += b[j] * qx;
      to[1] += b[j] * qy;
      to[3] -= b[j] * (fx * qx + fy * qy);
      for (int k = 0; k < 3; ++k) gradients_[corners[j]].colour[k] -= b[j] * g[k];
    }
  }
}

template <class T>
void ColourPicture<T>::Backward(const MeshTopology& topology, const T* picture_gradient, T* position_gradient,
                                T* colour_gradient) {
  gradients_.assign(topology.num_vertices, {});
  std::fill_n(position_gradient, 4 * int64_t(topology.num_vertices), T(0));
  if (num_covered_ > 0) InterpolateBackward(topology, picture_gradient);
  CrossingsBackward(topology, picture_gradient, position_gradient);
  for (int64_t v = 0; v < topology.num_vertices; ++v) {
    for (int k = 0; k < 4; ++k) position_gradient[4 * v + k] += gradients_[v].position[k];
    for (int k = 0; k < 3; ++k) colour_gradient[3 * v + k] = gradients_[v].colour[k];
  }
}

template class ColourPicture<float>;
template class ColourPicture<double>;

}  // namespace daumier::raster
