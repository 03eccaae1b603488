#include "fitting/texture_light.h"

#include "core/error.h"
#include "core/parallel.h"
#include "core/statistics.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace daumier::fitting {
namespace {

constexpr int kBands = raster::kLightBands;
using Basis = Eigen::Matrix<double, Eigen::Dynamic, kBands>;
using BandValues = Eigen::Matrix<double, kBands, 1>;
/// Upper limit of the weight of a vertex, so that large triangles of the atlas do not decide alone.
constexpr double kMostWeight = 20;
constexpr double kLeastDeviation = 0.02;

/// phi_k of each normal: the shade of a light of 1 in band k and, with the ambient light, 0 in the others.
Basis BasisOf(const geometry::Points& normals) {
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> directions = normals.cast<float>();
  Basis basis(normals.rows(), kBands);
  Eigen::VectorXf column(normals.rows());
  for (int k = 0; k < kBands; ++k) {
    PortraitLight unit{-float(raster::kAmbientLight)};
    unit[size_t(k)] += 1;
    raster::Shade(unit, normals.rows(), directions.data(), column.data());
    basis.col(k) = column.cast<double>();
  }
  return basis;
}

BandValues WithAmbient(const PortraitLight& light) {
  BandValues values = Eigen::Map<const Eigen::Matrix<float, kBands, 1>>(light.data()).cast<double>();
  values[0] += raster::kAmbientLight;
  return values;
}

double MedianMagnitude(const Eigen::VectorXd& values) {
  std::vector<double> magnitudes(values.data(), values.data() + values.size());
  for (double& value : magnitudes) value = std::abs(value);
  return Median(magnitudes);
}

}  // namespace

PortraitLight FitLight(const geometry::Points& normals, const VertexValues& colours, const PortraitLight& start,
                       const LightFitOptions& options) {
  DAUMIER_CHECK(
      colours.values.rows() == normals.rows() && colours.weights.size() == normals.rows() && colours.values.cols() == 3,
      "{} normals with {} x {} colours of {} weights", normals.rows(), colours.values.rows(), colours.values.cols(),
      colours.weights.size());
  std::vector<int> known;
  for (int v = 0; v < normals.rows(); ++v)
    if (colours.weights[v] > 0) known.push_back(v);
  if (known.empty()) return start;
  const Basis basis = BasisOf(normals(known, Eigen::all));
  const Eigen::VectorXd weights = colours.weights(known).cast<double>().cwiseMin(kMostWeight);
  const Eigen::VectorXd lightness =
      colours.values(known, Eigen::all).cast<double>() * Eigen::Vector3d(0.299, 0.587, 0.114);

  const BandValues centre = WithAmbient(start);
  const Eigen::VectorXd of_start = basis * centre;
  const double scale =
      weights.dot(of_start.cwiseProduct(lightness)) / std::max(1e-9, weights.dot(of_start.cwiseAbs2()));
  BandValues bands = scale * centre;
  for (int i = 0; i < options.num_iterations; ++i) {
    const Eigen::VectorXd residuals = lightness - basis * bands;
    const double deviation = options.tolerance * std::max(kLeastDeviation, 1.4826 * MedianMagnitude(residuals));
    const Eigen::VectorXd counted = weights.array() * (1 + (residuals / deviation).array().square()).square().inverse();
    const double trust = options.trust * counted.sum();
    Eigen::Matrix<double, kBands, kBands> system = basis.transpose() * counted.asDiagonal() * basis;
    system.diagonal().array() += trust;
    bands = system.ldlt().solve(basis.transpose() * counted.cwiseProduct(lightness) + trust * scale * centre);
  }
  const double mean = weights.dot(basis * bands) / weights.sum();
  if (!(mean > 1e-3)) return start;
  bands *= options.mean_shade / mean;
  bands[0] -= raster::kAmbientLight;
  PortraitLight light;
  for (int k = 0; k < kBands; ++k) light[size_t(k)] = float(bands[k]);
  return light;
}

Eigen::VectorXf ShadesOf(const geometry::Points& normals, const PortraitLight& light) {
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> directions = normals.cast<float>();
  Eigen::VectorXf shades(normals.rows());
  raster::Shade(light, normals.rows(), directions.data(), shades.data());
  return shades.cwiseMax(kLeastShade);
}

Eigen::VectorXf WithContrast(const Eigen::VectorXf& shades, double share) {
  const auto mean = float(LightFitOptions{}.mean_shade);
  return mean * (shades.array().max(1e-3F) / mean).pow(float(share));
}

void DivideByShades(const rig::TextureSpace& space, const rig::TexelMap& texels, const Eigen::VectorXf& shades,
                    TexelColours& colours) {
  const Eigen::VectorXf inverse = shades.cwiseInverse();
  OnAllCores(texels.num_texels(), [&](int64_t texel) {
    const auto i = size_t(texel);
    if (texels.triangles[i] < 0 || colours.weights[i] <= 0) return;
    const int* const corner = space.triangles.data() + 3 * size_t(texels.triangles[i]);
    const Eigen::Vector3f& w = texels.weights[i];
    colours.colours[i] *= w[0] * inverse[corner[0]] + w[1] * inverse[corner[1]] + w[2] * inverse[corner[2]];
  });
}

}  // namespace daumier::fitting
