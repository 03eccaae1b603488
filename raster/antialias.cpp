#include "raster/antialias.h"

#include <algorithm>

namespace daumier::raster {

template <class T>
void InterpolateCrossings(const std::vector<Crossing<T>>& crossings, int num_channels, const T* attributes, T* values) {
  for (const Crossing<T>& crossing : crossings) {
    const T *const first = attributes + int64_t(crossing.first) * num_channels, *const second =
                                                                                    attributes +
                                                                                    int64_t(crossing.second) *
                                                                                        num_channels;
    for (int k = 0; k < num_channels; ++k) *values++ = first[k] + crossing.weight * (second[k] - first[k]);
  }
}

template <class T>
void InterpolateCrossingsBackward(const std::vector<Crossing<T>>& crossings, const Raster<T>& raster, int num_channels,
                                  const T* attributes, const T* value_gradient, T* attribute_gradient,
                                  T* position_gradient) {
  const T* g = value_gradient;
  for (const Crossing<T>& crossing : crossings) {
    const int64_t first = int64_t(crossing.first) * num_channels, second = int64_t(crossing.second) * num_channels;
    T by_weight = 0;
    for (int k = 0; k < num_channels; ++k) by_weight += g[k] * (attributes[second + k] - attributes[first + k]);
    if (position_gradient != nullptr) CrossingBackward(crossing, raster, T(0), by_weight, position_gradient);
    for (int k = 0; k < num_channels && attribute_gradient != nullptr; ++k) {
      attribute_gradient[first + k] += (1 - crossing.weight) * g[k];
      attribute_gradient[second + k] += crossing.weight * g[k];
    }
    g += num_channels;
  }
}

template <class T>
void Antialias(const std::vector<Crossing<T>>& crossings, int64_t num_pixels, int num_channels, const T* picture,
               const T* edge_values, T* antialiased) {
  std::copy_n(picture, num_pixels * num_channels, antialiased);
  for (const Crossing<T>& crossing : crossings) {
    const T sign = crossing.surface_is_next ? T(1) : T(-1);
    const T to_pixel = sign * crossing.Area(crossing.alpha), to_next = -sign * crossing.Area(-crossing.alpha);
    const T* const outside = picture + int64_t(crossing.outside()) * num_channels;
    T *const pixel = antialiased + int64_t(crossing.pixel) * num_channels, *const next =
                                                                               antialiased +
                                                                               int64_t(crossing.next) * num_channels;
    for (int k = 0; k < num_channels; ++k) {
      const T difference = edge_values[k] - outside[k];
      pixel[k] += to_pixel * difference;
      next[k] += to_next * difference;
    }
    edge_values += num_channels;
  }
}

template <class T>
void AntialiasBackward(const std::vector<Crossing<T>>& crossings, const Raster<T>& raster, int num_channels,
                       const T* picture, const T* edge_values, const T* antialiased_gradient, T* picture_gradient,
                       T* edge_value_gradient, T* position_gradient) {
  for (int64_t i = 0; i < raster.num_pixels() * num_channels; ++i) picture_gradient[i] += antialiased_gradient[i];
  for (const Crossing<T>& crossing : crossings) {
    const T sign = crossing.surface_is_next ? T(1) : T(-1), lean = crossing.AreaSlope();
    const T to_pixel = sign * crossing.Area(crossing.alpha), to_next = -sign * crossing.Area(-crossing.alpha);
    const int64_t outside = int64_t(crossing.outside()) * num_channels;
    const T *const g_pixel = antialiased_gradient + int64_t(crossing.pixel) * num_channels, *const g_next =
                                                                                                antialiased_gradient +
                                                                                                int64_t(crossing.next) *
                                                                                                    num_channels;
    T by_alpha = 0;
    for (int k = 0; k < num_channels; ++k) {
      const T difference = edge_values[k] - picture[outside + k];
      by_alpha += sign * difference * (lean * g_pixel[k] + (1 - lean) * g_next[k]);
      const T g = to_pixel * g_pixel[k] + to_next * g_next[k];
      edge_value_gradient[k] += g;
      picture_gradient[outside + k] -= g;
    }
    CrossingBackward(crossing, raster, -by_alpha, T(0), position_gradient);
    edge_values += num_channels;
    edge_value_gradient += num_channels;
  }
}

#define DAUMIER_INSTANTIATE(T)                                                                                 \
  template void InterpolateCrossings(const std::vector<Crossing<T>>&, int, const T*, T*);                      \
  template void InterpolateCrossingsBackward(const std::vector<Crossing<T>>&, const Raster<T>&, int, const T*, \
                                             const T*, T*, T*);                                                \
  template void Antialias(const std::vector<Crossing<T>>&, int64_t, int, const T*, const T*, T*);              \
  template void AntialiasBackward(const std::vector<Crossing<T>>&, const Raster<T>&, int, const T*, const T*,  \
                                  const T*, T*, T*, T*);
DAUMIER_INSTANTIATE(float)
DAUMIER_INSTANTIATE(double)
#undef DAUMIER_INSTANTIATE

}  // namespace daumier::raster
