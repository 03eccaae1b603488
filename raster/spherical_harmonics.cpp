#include "raster/spherical_harmonics.h"

namespace daumier::raster {
namespace {

/// The light as a polynomial of the normal.
template <class T>
struct LightPolynomial {
  explicit LightPolynomial(const std::array<T, kLightBands>& light)
      : one((light[0] + T(kAmbientLight)) * T(0.886227) - light[6] * T(0.700624)),
        y(light[1] * T(-1.772454)),
        z(light[2] * T(1.772454)),
        x(light[3] * T(-1.772454)),
        xy(light[4] * T(2.427032)),
        yz(light[5] * T(-2.427032)),
        zz(light[6] * T(3 * 0.700624)),
        xz(light[7] * T(-2.427032)),
        xx_yy(light[8] * T(1.213516)) {}
  T one, y, z, x, xy, yz, zz, xz, xx_yy;
};

}  // namespace

template <class T>
void Shade(const std::array<T, kLightBands>& light, int64_t num_normals, const T* normals, T* shades) {
  const LightPolynomial<T> p(light);
  for (int64_t i = 0; i < num_normals; ++i) {
    const T x = normals[3 * i], y = normals[3 * i + 1], z = normals[3 * i + 2];
    shades[i] = p.one + p.x * x + p.y * y + p.z * z + p.xy * x * y + p.yz * y * z + p.xz * x * z + p.zz * z * z +
                p.xx_yy * (x * x - y * y);
  }
}

template <class T>
void ShadeBackward(const std::array<T, kLightBands>& light, int64_t num_normals, const T* normals,
                   const T* shade_gradient, std::array<T, kLightBands>& light_gradient, T* normal_gradient) {
  const LightPolynomial<T> p(light);
  T one = 0, sum_x = 0, sum_y = 0, sum_z = 0, xy = 0, yz = 0, zz = 0, xz = 0, xx_yy = 0;
  for (int64_t i = 0; i < num_normals; ++i) {
    const T x = normals[3 * i], y = normals[3 * i + 1], z = normals[3 * i + 2], g = shade_gradient[i];
    normal_gradient[3 * i] += g * (p.x + p.xy * y + p.xz * z + 2 * p.xx_yy * x);
    normal_gradient[3 * i + 1] += g * (p.y + p.xy * x + p.yz * z - 2 * p.xx_yy * y);
    normal_gradient[3 * i + 2] += g * (p.z + p.yz * y + p.xz * x + 2 * p.zz * z);
    one += g, sum_x += g * x, sum_y += g * y, sum_z += g * z;
    xy += g * x * y, yz += g * y * z, xz += g * x * z;
    zz += g * z * z, xx_yy += g * (x * x - y * y);
  }
  light_gradient[0] += T(0.886227) * one;
  light_gradient[1] -= T(1.772454) * sum_y;
  light_gradient[2] += T(1.772454) * sum_z;
  light_gradient[3] -= T(1.772454) * sum_x;
  light_gradient[4] += T(2.427032) * xy;
  light_gradient[5] -= T(2.427032) * yz;
  light_gradient[6] += T(0.700624) * (3 * zz - one);
  light_gradient[7] -= T(2.427032) * xz;
  light_gradient[8] += T(1.213516) * xx_yy;
}

#define DAUMIER_INSTANTIATE(T)                                                                \
  template void Shade(const std::array<T, kLightBands>&, int64_t, const T*, T*);              \
  template void ShadeBackward(const std::array<T, kLightBands>&, int64_t, const T*, const T*, \
                              std::array<T, kLightBands>&, T*);
DAUMIER_INSTANTIATE(float)
DAUMIER_INSTANTIATE(double)
#undef DAUMIER_INSTANTIATE

}  // namespace daumier::raster
