#include "systems/sketch/fitted_models.h"

namespace daumier::sketch {
namespace {

constexpr const char* kBilinear = "bilinear.safetensors";
constexpr const char* kCurves = "curves.safetensors";
constexpr const char* kBasis = "basis.safetensors";
constexpr const char* kGaussian = "gaussian.safetensors";

}  // namespace

std::map<std::string, std::string> WriteFittedModels(const std::filesystem::path& directory,
                                                     const FittedModels& models) {
  std::map<std::string, std::string> checksums;
  checksums[kBilinear] = faces::WriteBilinearModel(directory / kBilinear, models.bilinear);
  checksums[kCurves] = faces::WriteBilinearModel(directory / kCurves, models.curves);
  if (models.basis.size() > 0) checksums[kBasis] = faces::WriteFaceBasis(directory / kBasis, models.basis);
  if (models.gaussian.size() > 0)
    checksums[kGaussian] = faces::WriteFaceGaussian(directory / kGaussian, models.gaussian);
  return checksums;
}

FittedModels ReadFittedModels(const std::filesystem::path& directory) {
  FittedModels models{
      faces::ReadBilinearModel(directory / kBilinear), faces::ReadBilinearModel(directory / kCurves), {}, {}};
  if (std::filesystem::exists(directory / kBasis)) models.basis = faces::ReadFaceBasis(directory / kBasis);
  if (std::filesystem::exists(directory / kGaussian)) models.gaussian = faces::ReadFaceGaussian(directory / kGaussian);
  return models;
}

}  // namespace daumier::sketch
