#include "systems/deform/network_code_model.h"

#include "core/error.h"
#include "core/parallel.h"
#include "core/safetensors.h"
#include "systems/deform/deform_weights.h"
#include "systems/deform/linear_code_model.h"

#include <string>
#include <utility>
#include <vector>

namespace daumier::deform {
namespace {

faces::ModelFrame FrameOf(const SafetensorsFile& file, const std::filesystem::path& path) {
  DAUMIER_CHECK(file.contains("network.model_from_cm") && file.at("network.model_from_cm").size() == 4,
                "{}: there is no frame 'network.model_from_cm' of four numbers. Train again", path.string());
  const auto numbers = file.at("network.model_from_cm").As<double>();
  return {numbers[0], {numbers[1], numbers[2], numbers[3]}};
}

Eigen::MatrixXd LatentsOfRun(const SafetensorsFile& file, const std::filesystem::path& path, int latent) {
  DAUMIER_CHECK(file.contains("codes") && file.at("codes").shape.size() == 2 && file.at("codes").shape[1] == latent,
                "{}: there are no codes of training faces of {} numbers. Train again", path.string(), latent);
  const ArrayView& codes = file.at("codes");
  return Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
             codes.As<float>().data(), codes.shape[0], codes.shape[1])
      .cast<double>();
}

/// Points that one call of the kernel decodes, of a whole surface and of a few points.
constexpr int64_t kManyPoints = 2400, kFewPoints = 240;

/// Displaced points, 3P floats.
Floats Decoded(const runtime::SirenLayout& siren, const float* parameters, const Floats& points) {
  const int64_t num_points = std::ssize(points) / 3, block = num_points > kManyPoints ? kManyPoints : kFewPoints;
  Floats positions(points.size());
  OnAllCores((num_points + block - 1) / block, [&](int64_t b) {
    const int64_t begin = b * block, count = std::min(block, num_points - begin);
    runtime::SirenKernel(siren).Forward(parameters, points.data() + 3 * begin, count, positions.data() + 3 * begin);
    for (int64_t i = 3 * begin; i < 3 * (begin + count); ++i) positions[size_t(i)] += points[size_t(i)];
  });
  return positions;
}

}  // namespace

NetworkCodeModel::NetworkCodeModel(faces::FaceTemplate face_template, const DeformOptions& options,
                                   const std::filesystem::path& weights)
    : face_template_(std::move(face_template)), siren_(options.siren()) {
  const SafetensorsFile file(weights);
  frame_ = FrameOf(file, weights);
  prior_ = fitting::PriorOfCodes(LatentsOfRun(file, weights, options.latent));
  weights_ = std::make_unique<const DeformWeights>(options, file, weights, prior_, face_template_.num_vertices());
}

NetworkCodeModel::~NetworkCodeModel() = default;

std::shared_ptr<const CodedSiren> NetworkCodeModel::SirenOf(const Eigen::VectorXd& code) const {
  DAUMIER_CHECK(code.size() == prior_.mean.size(), "a code of {} numbers, expected {}", code.size(),
                prior_.mean.size());
  {
    const std::lock_guard lock(last_mutex_);
    if (last_siren_ && last_code_ == code) return last_siren_;
  }
  auto siren = std::make_shared<const CodedSiren>(weights_->At(code));
  const std::lock_guard lock(last_mutex_);
  last_code_ = code;
  last_siren_ = siren;
  return siren;
}

geometry::Points NetworkCodeModel::Vertices(const Eigen::VectorXd& code) const {
  const Floats positions = Decoded(siren_, SirenOf(code)->parameters.data(), weights_->all_points());
  const geometry::Points vertices = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(
                                        positions.data(), std::ssize(positions) / 3, 3)
                                        .cast<double>();
  return frame_.ToCm(vertices);
}

Eigen::VectorXd NetworkCodeModel::Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  const Floats positions = Decoded(siren_, SirenOf(code)->parameters.data(), weights_->Points(vertices));
  Eigen::VectorXd numbers(std::ssize(positions));
  for (size_t i = 0; i < positions.size(); ++i)
    numbers[Eigen::Index(i)] = (double(positions[i]) - frame_.offset[Eigen::Index(i % 3)]) / frame_.scale;
  return numbers;
}

Eigen::MatrixXd NetworkCodeModel::Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const {
  return weights_->Derivative(*SirenOf(code), weights_->Points(vertices)) / frame_.scale;
}

Eigen::MatrixXd TrainingCodes(const DeformOptions& options, const std::filesystem::path& weights) {
  const Eigen::MatrixXd latents = LatentsOfRun(SafetensorsFile(weights), weights, options.latent);
  return fitting::StandardisedCodes(fitting::PriorOfCodes(latents), latents);
}

LinearFaces LinearFacesOfRun(const faces::FaceTemplate& face_template, const DeformOptions& options,
                             const std::filesystem::path& weights) {
  const SafetensorsFile file(weights);
  const faces::ModelFrame frame = FrameOf(file, weights);
  const fitting::CodePrior prior = fitting::PriorOfCodes(LatentsOfRun(file, weights, options.latent));
  const int64_t num_coordinates = 3 * face_template.num_vertices();
  const auto mean = ArrayOf(file, weights, "network.mean", {num_coordinates});
  const auto rows = ArrayOf(file, weights, "network.rows", {options.latent, num_coordinates});
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> own_rows(rows.data(), options.latent, num_coordinates);
  LinearFaces result;
  result.face_template = face_template;
  result.usual_radius = prior.usual_radius;
  result.rows = (prior.factor / frame.scale).transpose().cast<float>() * own_rows;
  const Eigen::RowVectorXd middle = Eigen::Map<const Eigen::RowVectorXf>(mean.data(), num_coordinates).cast<double>() +
                                    (prior.mean.transpose().cast<float>() * own_rows).cast<double>();
  result.mean = frame.ToCm(Eigen::Map<const geometry::Points>(middle.data(), num_coordinates / 3, 3));
  return result;
}

}  // namespace daumier::deform
