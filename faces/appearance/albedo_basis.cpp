#include "faces/appearance/albedo_basis.h"

#include "core/error.h"
#include "faces/appearance/albedo_modes.h"
#include "faces/appearance/skin_fields.h"
#include "geometry/smoothest_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace daumier::faces {
namespace {

constexpr double kBandSigma = 0.022, kBandFall = 0.06;  // Of the first band; how fast they fall.
const Eigen::Vector3f kLightnessStep{1.0f, 1.0f, 0.95f}, kRednessStep{0.7f, -0.45f, -0.35f};

std::vector<std::string> AlbedoModeNames() {
  std::vector<std::string> names;
  for (const AlbedoModeSpec& mode : NamedAlbedoModes()) names.push_back(mode.name);
  for (const char* kind : {"lightness", "redness"})
    for (int k = 0; k < kNumAlbedoBands; ++k) names.push_back(fmt::format("{}_band_{}", kind, k));
  return names;
}

}  // namespace

AlbedoBasis MakeAlbedoBasis(const FaceTemplate& face) {
  const int num_vertices = face.num_vertices();
  std::map<std::string, Eigen::VectorXf> fields;
  const auto field = [&](const std::string& name) -> const Eigen::VectorXf& {
    auto found = fields.find(name);
    if (found == fields.end()) found = fields.emplace(name, SkinField(face, name).cast<float>()).first;
    return found->second;
  };
  AlbedoBasis basis;
  basis.names = AlbedoModeNames();
  basis.mean = kMeanSkin.transpose().replicate(num_vertices, 1);
  for (const AlbedoModeSpec& part : MeanAlbedoParts()) basis.mean += field(part.field) * part.step.transpose();
  basis.mean = basis.mean.cwiseMax(0.0f).cwiseMin(1.0f).eval();
  basis.modes.resize(3 * num_vertices, kNumAlbedoModes);
  const auto set = [&](int k, const Eigen::VectorXf& weights, const Eigen::Vector3f& step) {
    Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(basis.modes.col(k).data(), num_vertices, 3) =
        weights * step.transpose();
  };
  int k = 0;
  for (const AlbedoModeSpec& mode : NamedAlbedoModes()) set(k++, field(mode.field), mode.step);
  const Eigen::MatrixXf bands =
      geometry::FindSmoothestFunctions({face.neutral, face.triangles}, kNumAlbedoBands).functions.cast<float>();
  for (const Eigen::Vector3f& step : {kLightnessStep, kRednessStep}) {
    for (int band = 0; band < kNumAlbedoBands; ++band)
      set(k++, bands.col(band), float(kBandSigma / (1 + kBandFall * band)) * step);
  }
  return basis;
}

int AlbedoMode(const std::string& name) {
  static const std::vector<std::string> names = AlbedoModeNames();
  const auto found = std::find(names.begin(), names.end(), name);
  DAUMIER_CHECK(found != names.end(), "there is no albedo mode '{}'", name);
  return static_cast<int>(found - names.begin());
}

Eigen::MatrixXf AlbedoOf(const AlbedoBasis& basis, const Eigen::VectorXf& coefficients) {
  DAUMIER_CHECK(coefficients.size() == basis.modes.cols(), "{} albedo coefficients, expected {}", coefficients.size(),
                basis.modes.cols());
  const Eigen::VectorXf offset = basis.modes * coefficients;
  return (basis.mean + Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(offset.data(),
                                                                                                  basis.mean.rows(), 3))
      .cwiseMax(0.0f)
      .cwiseMin(1.0f);
}

}  // namespace daumier::faces
