#include "raster/texture.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::raster {
namespace {

template <class T>
void CheckTexture(const Texture<T>& texture) {
  DAUMIER_CHECK(texture.height > 0 && texture.width > 0 && texture.num_channels > 0 &&
                    int64_t(texture.texels.size()) == int64_t(texture.height) * texture.width * texture.num_channels,
                "a texture of {} x {} texels with {} channels has {} numbers", texture.height, texture.width,
                texture.num_channels, texture.texels.size());
}

/// Along one axis: two texels and the share of the second one. Clamped coordinates have no derivative.
template <class T>
struct AxisPlace {
  int first, second;
  T share;
  T slope;  ///< Of `share` by the coordinate in texels: 1, or 0 where clamped.
};

template <class T>
AxisPlace<T> PlaceOn(T coordinate, int size, Wrap wrap) {
  DAUMIER_CHECK(std::isfinite(coordinate), "a texture coordinate is not finite");
  if (wrap == Wrap::kRepeat) coordinate -= std::floor(coordinate / T(size)) * T(size);
  T place = coordinate - T(0.5), slope = 1;
  if (wrap == Wrap::kClamp && !(place >= 0 && place <= T(size - 1))) {
    place = std::min(std::max(place, T(0)), T(size - 1));
    slope = 0;
  }
  const T below = std::floor(place);
  const int first = static_cast<int>(below), second = first + 1;
  if (wrap == Wrap::kClamp) return {first, std::min(second, size - 1), place - below, slope};
  return {(first + size) % size, second % size, place - below, slope};
}

/// The four texels of a lookup, their weights, and the slopes of the weights by u and v.
template <class T>
struct TexelCell {
  TexelCell(const Texture<T>& texture, Wrap wrap, const T* uv) {
    const AxisPlace<T> x = PlaceOn(uv[0] * T(texture.width), texture.width, wrap);
    const AxisPlace<T> y = PlaceOn((1 - uv[1]) * T(texture.height), texture.height, wrap);
    const int columns[2] = {x.first, x.second}, rows[2] = {y.first, y.second};
    const T on_x[2] = {1 - x.share, x.share}, on_y[2] = {1 - y.share, y.share};
    const T slope_u[2] = {-x.slope * T(texture.width), x.slope * T(texture.width)};
    const T slope_v[2] = {y.slope * T(texture.height), -y.slope * T(texture.height)};
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        offset[2 * r + c] = (int64_t(rows[r]) * texture.width + columns[c]) * texture.num_channels;
        weight[2 * r + c] = on_y[r] * on_x[c];
        by_u[2 * r + c] = on_y[r] * slope_u[c];
        by_v[2 * r + c] = slope_v[r] * on_x[c];
      }
    }
  }

  int64_t offset[4];
  T weight[4], by_u[4], by_v[4];
};

/// Adds factor * value.
template <class T>
void AddLookUp(const Texture<T>& texture, Wrap wrap, const T* uv, T factor, T* value) {
  const TexelCell<T> cell(texture, wrap, uv);
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < texture.num_channels; ++k) {
      value[k] += factor * cell.weight[i] * texture.texels[cell.offset[i] + k];
    }
  }
}

template <class T>
void AddLookUpBackward(const Texture<T>& texture, Wrap wrap, const T* uv, T factor, const T* g, T* texture_gradient,
                       T* uv_gradient) {
  const TexelCell<T> cell(texture, wrap, uv);
  for (int i = 0; i < 4; ++i) {
    T along = 0;
    for (int k = 0; k < texture.num_channels; ++k) {
      along += g[k] * texture.texels[cell.offset[i] + k];
      if (texture_gradient != nullptr) texture_gradient[cell.offset[i] + k] += factor * cell.weight[i] * g[k];
    }
    if (uv_gradient == nullptr) continue;
    uv_gradient[0] += factor * cell.by_u[i] * along;
    uv_gradient[1] += factor * cell.by_v[i] * along;
  }
}

/// The two levels of a trilinear lookup.
struct LevelPair {
  int first, second;
  double share;
};

template <class T>
LevelPair LevelsAt(const MipMap<T>& mip_map, T level) {
  const int last = static_cast<int>(mip_map.size()) - 1;
  const double at = std::min(std::max(double(level), 0.0), double(last));
  const int first = std::min(static_cast<int>(at), std::max(last - 1, 0));
  return {first, std::min(first + 1, last), at - first};
}

template <class T>
void CheckMipMap(const MipMap<T>& mip_map) {
  DAUMIER_CHECK(!mip_map.empty(), "a mip map has no levels");
  for (const Texture<T>& level : mip_map) CheckTexture(level);
}

}  // namespace

template <class T>
void LookUpTexture(const Texture<T>& texture, Wrap wrap, int64_t num_points, const T* uv, const int* shown, T* values) {
  CheckTexture(texture);
  std::fill_n(values, num_points * texture.num_channels, T(0));
  for (int64_t i = 0; i < num_points; ++i) {
    if (shown != nullptr && shown[i] < 0) continue;
    AddLookUp(texture, wrap, uv + 2 * i, T(1), values + i * texture.num_channels);
  }
}

template <class T>
void LookUpTextureBackward(const Texture<T>& texture, Wrap wrap, int64_t num_points, const T* uv, const int* shown,
                           const T* value_gradient, T* texture_gradient, T* uv_gradient) {
  CheckTexture(texture);
  for (int64_t i = 0; i < num_points; ++i) {
    if (shown != nullptr && shown[i] < 0) continue;
    AddLookUpBackward(texture, wrap, uv + 2 * i, T(1), value_gradient + i * texture.num_channels, texture_gradient,
                      uv_gradient == nullptr ? nullptr : uv_gradient + 2 * i);
  }
}

template <class T>
MipMap<T> MakeMipMap(const Texture<T>& texture) {
  CheckTexture(texture);
  MipMap<T> levels = {texture};
  for (;;) {
    const Texture<T>& above = levels.back();
    const bool may_halve = (above.height % 2 == 0 || above.height == 1) && (above.width % 2 == 0 || above.width == 1);
    if (!may_halve || (above.height == 1 && above.width == 1)) return levels;
    Texture<T> half{std::max(above.height / 2, 1), std::max(above.width / 2, 1), above.num_channels, {}};
    half.texels.assign(int64_t(half.height) * half.width * half.num_channels, T(0));
    const int step_y = above.height / half.height, step_x = above.width / half.width;
    const T share = T(1) / T(step_y * step_x);
    for (int row = 0; row < above.height; ++row) {
      for (int64_t i = 0; i < int64_t(above.width) * above.num_channels; ++i) {
        const int64_t column = i / above.num_channels / step_x, channel = i % above.num_channels;
        half.texels[(int64_t(row / step_y) * half.width + column) * half.num_channels + channel] +=
            share * above.texels[int64_t(row) * above.width * above.num_channels + i];
      }
    }
    levels.push_back(std::move(half));
  }
}

template <class T>
void MipMapBackward(MipMap<T>& level_gradients) {
  for (size_t level = level_gradients.size(); level-- > 1;) {
    const Texture<T>& half = level_gradients[level];
    Texture<T>& above = level_gradients[level - 1];
    const int step_y = above.height / half.height, step_x = above.width / half.width;
    const T share = T(1) / T(step_y * step_x);
    for (int row = 0; row < above.height; ++row) {
      for (int64_t i = 0; i < int64_t(above.width) * above.num_channels; ++i) {
        const int64_t column = i / above.num_channels / step_x, channel = i % above.num_channels;
        above.texels[int64_t(row) * above.width * above.num_channels + i] +=
            share * half.texels[(int64_t(row / step_y) * half.width + column) * half.num_channels + channel];
      }
    }
  }
}

template <class T>
void ChooseLevels(const MipMap<T>& mip_map, int64_t num_points, const T* uv_slopes, T* levels) {
  CheckMipMap(mip_map);
  const T width = T(mip_map[0].width), height = T(mip_map[0].height), last = T(mip_map.size() - 1);
  for (int64_t i = 0; i < num_points; ++i) {
    const T *const s = uv_slopes + 4 * i, u_x = s[0] * width, u_y = s[1] * width, v_x = s[2] * height,
                   v_y = s[3] * height;
    const T square = std::max(u_x * u_x + v_x * v_x, u_y * u_y + v_y * v_y);
    levels[i] = square > 1 ? std::min(std::log2(square) / 2, last) : T(0);
  }
}

template <class T>
void LookUpMipMap(const MipMap<T>& mip_map, Wrap wrap, int64_t num_points, const T* uv, const T* levels,
                  const int* shown, T* values) {
  CheckMipMap(mip_map);
  const int num_channels = mip_map[0].num_channels;
  std::fill_n(values, num_points * num_channels, T(0));
  for (int64_t i = 0; i < num_points; ++i) {
    if (shown != nullptr && shown[i] < 0) continue;
    const LevelPair at = LevelsAt(mip_map, levels[i]);
    AddLookUp(mip_map[at.first], wrap, uv + 2 * i, T(1 - at.share), values + i * num_channels);
    if (at.share > 0) AddLookUp(mip_map[at.second], wrap, uv + 2 * i, T(at.share), values + i * num_channels);
  }
}

template <class T>
void LookUpMipMapBackward(const MipMap<T>& mip_map, Wrap wrap, int64_t num_points, const T* uv, const T* levels,
                          const int* shown, const T* value_gradient, MipMap<T>* level_gradients, T* uv_gradient) {
  CheckMipMap(mip_map);
  const int num_channels = mip_map[0].num_channels;
  const auto texels = [&](int level) {
    return level_gradients == nullptr ? nullptr : (*level_gradients)[level].texels.data();
  };
  for (int64_t i = 0; i < num_points; ++i) {
    if (shown != nullptr && shown[i] < 0) continue;
    const LevelPair at = LevelsAt(mip_map, levels[i]);
    const T* const g = value_gradient + i * num_channels;
    T* const by_uv = uv_gradient == nullptr ? nullptr : uv_gradient + 2 * i;
    AddLookUpBackward(mip_map[at.first], wrap, uv + 2 * i, T(1 - at.share), g, texels(at.first), by_uv);
    if (at.share > 0) {
      AddLookUpBackward(mip_map[at.second], wrap, uv + 2 * i, T(at.share), g, texels(at.second), by_uv);
    }
  }
}

#define DAUMIER_INSTANTIATE(T)                                                                                   \
  template void LookUpTexture(const Texture<T>&, Wrap, int64_t, const T*, const int*, T*);                       \
  template void LookUpTextureBackward(const Texture<T>&, Wrap, int64_t, const T*, const int*, const T*, T*, T*); \
  template MipMap<T> MakeMipMap(const Texture<T>&);                                                              \
  template void MipMapBackward(MipMap<T>&);                                                                      \
  template void ChooseLevels(const MipMap<T>&, int64_t, const T*, T*);                                           \
  template void LookUpMipMap(const MipMap<T>&, Wrap, int64_t, const T*, const T*, const int*, T*);               \
  template void LookUpMipMapBackward(const MipMap<T>&, Wrap, int64_t, const T*, const T*, const int*, const T*,  \
                                     MipMap<T>*, T*);
DAUMIER_INSTANTIATE(float)
DAUMIER_INSTANTIATE(double)
#undef DAUMIER_INSTANTIATE

}  // namespace daumier::raster
