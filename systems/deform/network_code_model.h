#pragma once
#include "faces/face_model.h"
#include "faces/model_frame.h"
#include "fitting/code_model.h"
#include "fitting/code_prior.h"
#include "systems/deform/network_options.h"

#include <filesystem>
#include <memory>
#include <mutex>

namespace daumier::deform {

class DeformWeights;
struct CodedSiren;

/// The SIREN of a run [Jung et al. 2022, eq. 2] without LibTorch: D(p, z) = p + S(p; H(z)), by runtime::SirenKernel.
/// Kinds "hypernetwork" and "conditioning". Codes are standardised by the run's training codes. The SIREN of the last
/// code is kept, so that more points, or the derivative, of the same code do not run the hypernetwork again.
/// Thread-safe.
class NetworkCodeModel : public fitting::CodeModel {
 public:
  /// weights: the safetensors file. @throws Error naming the file if arrays are missing or of other shapes than the
  /// options say, or if the kind has no SIREN.
  NetworkCodeModel(faces::FaceTemplate face_template, const DeformOptions& options,
                   const std::filesystem::path& weights);
  ~NetworkCodeModel() override;

  const faces::FaceTemplate& face_template() const override { return face_template_; }
  int num_numbers() const override { return int(prior_.mean.size()); }
  bool is_linear() const override { return false; }
  double usual_radius() const override { return prior_.usual_radius; }
  geometry::Points Vertices(const Eigen::VectorXd& code) const override;
  Eigen::VectorXd Positions(const Eigen::VectorXd& code, std::span<const int> vertices) const override;
  Eigen::MatrixXd Derivative(const Eigen::VectorXd& code, std::span<const int> vertices) const override;
  Eigen::VectorXd Latent(const Eigen::VectorXd& code) const override { return prior_.mean + prior_.factor * code; }

 private:
  std::shared_ptr<const CodedSiren> SirenOf(const Eigen::VectorXd& code) const;

  faces::FaceTemplate face_template_;
  faces::ModelFrame frame_;
  runtime::SirenLayout siren_;
  fitting::CodePrior prior_;
  std::unique_ptr<const DeformWeights> weights_;
  mutable std::mutex last_mutex_;  ///< Guards the two below.
  mutable Eigen::VectorXd last_code_;
  mutable std::shared_ptr<const CodedSiren> last_siren_;  ///< Shared with the calls that are reading it.
};

/// Codes of the training faces of a run, in their order, standardised, N x latent. @throws Error as NetworkCodeModel.
Eigen::MatrixXd TrainingCodes(const DeformOptions& options, const std::filesystem::path& weights);

struct LinearFaces;
/// A linear run (kind "linear") as a linear model in standardised codes. @throws Error as NetworkCodeModel.
LinearFaces LinearFacesOfRun(const faces::FaceTemplate& face_template, const DeformOptions& options,
                             const std::filesystem::path& weights);

}  // namespace daumier::deform
