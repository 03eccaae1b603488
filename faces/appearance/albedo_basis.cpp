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

constexpr double kBandSigma = 0.012, kBandFall = 0.06;  // Of the first band; how fast they fall.
const Eigen::Vector3f kLightnessStep{1.0f, 1.0f, 0.95f}, kRednessStep{0.40f, -0.30f, -0.22f};

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
  std::vector<Eigen::VectorXf> fields;
  std::map<std::string, int> numbers;
  const auto field = [&](const std::string& name) {
    const auto [found, is_new] = numbers.emplace(name, int(fields.size()));
    if (is_new) fields.push_back(SkinField(face, name).cast<float>());
    return found->second;
  };
  AlbedoBasis basis;
  basis.names = AlbedoModeNames();
  basis.steps.resize(3, kNumAlbedoModes);
  const auto add = [&](int of, const Eigen::Vector3f& step) {
    basis.steps.col(Eigen::Index(basis.field_of.size())) = step;
    basis.field_of.push_back(of);
  };
  for (const AlbedoModeSpec& mode : NamedAlbedoModes()) add(field(mode.field), mode.step);
  const Eigen::MatrixXd bands =
      geometry::FindSmoothestFunctions({face.neutral, face.triangles}, kNumAlbedoBands).functions;
  const int first_band = static_cast<int>(fields.size());
  for (int band = 0; band < kNumAlbedoBands; ++band) fields.push_back(bands.col(band).cast<float>());
  for (const Eigen::Vector3f& step : {kLightnessStep, kRednessStep})
    for (int band = 0; band < kNumAlbedoBands; ++band)
      add(first_band + band, float(kBandSigma / (1 + kBandFall * band)) * step);

  basis.mean = kMeanSkin.transpose().replicate(num_vertices, 1);
  for (const AlbedoModeSpec& part : MeanAlbedoParts())
    basis.mean += SkinField(face, part.field).cast<float>() * part.step.transpose();
  basis.mean = basis.mean.cwiseMax(0.0f).cwiseMin(1.0f).eval();
  basis.fields.resize(num_vertices, Eigen::Index(fields.size()));
  for (size_t f = 0; f < fields.size(); ++f) basis.fields.col(Eigen::Index(f)) = fields[f];
  basis.modes.resize(3 * num_vertices, kNumAlbedoModes);
  for (int k = 0; k < kNumAlbedoModes; ++k) {
    Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(basis.modes.col(k).data(), num_vertices, 3) =
        fields[size_t(basis.field_of[size_t(k)])] * basis.steps.col(k).transpose();
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
  if (basis.fields.rows() == basis.mean.rows()) {
    Eigen::MatrixX3f colours = Eigen::MatrixX3f::Zero(basis.fields.cols(), 3);
    for (Eigen::Index k = 0; k < coefficients.size(); ++k)
      colours.row(basis.field_of[size_t(k)]) += coefficients[k] * basis.steps.col(k).transpose();
    return (basis.mean + basis.fields * colours).cwiseMax(0.0f).cwiseMin(1.0f);
  }
  const Eigen::VectorXf offset = basis.modes * coefficients;
  return (basis.mean + Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(offset.data(),
                                                                                                  basis.mean.rows(), 3))
      .cwiseMax(0.0f)
      .cwiseMin(1.0f);
}

}  // namespace daumier::faces
