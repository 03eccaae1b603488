#pragma once
#include "datasets/read/sketch_database.h"
#include "datasets/read/sketch_dataset.h"
#include "faces/curve_encoder.h"
#include "faces/face_database.h"
#include "losses/vertex_loss.h"
#include "systems/sketch/options.h"
#include "systems/sketch/train/network.h"
#include "train/recipe.h"

#include <filesystem>
#include <optional>
#include <string>

namespace daumier::sketch {

/// w of the vertex loss [Han et al. 2017, eq. 2], V: curve_weight on the vertices of the annotation's feature curves, 1
/// elsewhere.
torch::Tensor CurveVertexWeights(const faces::FaceTemplate& face_template, double curve_weight);

/// A sketch network with the softmax layers of the first step of training, which read its last features.
class SketchClassifierImpl : public torch::nn::Module {
 public:
  SketchClassifierImpl(SketchNetwork network, int num_identities, int num_expressions);

  /// Scores before the softmax: identities (B, I), expressions (B, E).
  struct Scores {
    torch::Tensor identity, expression;
  };
  Scores forward(const SketchNetworkImpl::BranchFeatures& features);

 private:
  SketchNetwork network_;
  torch::nn::Linear identity_, expression_;
};
TORCH_MODULE(SketchClassifier);

/// A sketch network on the training faces of a split, whose sketches vary from epoch to epoch; those of validation vary
/// in the same way, but not with the epoch, and are seen in the exact view. Its stages [Han et al. 2017, section 4.4]:
///   classification   cross-entropy of identity (person x level) and expression; an interpolated face has neither, and
///                    counts as 0
///   regression       squared distance of u and v, standardised, from those that the bilinear model was fitted with
///                    (train/coefficient_targets.h), convolutions frozen
///   tuning           the vertex loss; the only one of a training without shares for the others
/// The validation's mean_vertex_error_mm is the one of eval/metrics.h over the region `face`. Databases and models have
/// to outlive it.
class SketchRecipe : public train::Recipe {
 public:
  /// Draws the first weights from LibTorch's CPU generator. @throws Error if a subset of the split that training needs
  /// is empty.
  SketchRecipe(const SketchTrainingOptions& options, const faces::FaceDatabase& faces,
               const datasets::SketchDatabase& sketches, const datasets::Split& split, const FittedModels& models,
               torch::Device device);

  torch::nn::Module& module() override;
  torch::nn::Module& product() override { return *network_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return training_.size(); }
  std::vector<train::Stage> stages() const override;
  void EnterStage(int stage) override;
  /// What SketchDataset::Get returns, and with loss = "vertices" the vertices, B x 3V in cm.
  SampleBatch Read(std::span<const int> samples, int64_t epoch) const override;
  train::LossTerms Loss(const train::Batch& batch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "mean_vertex_error_mm"; }

  const SketchNetwork& network() const { return network_; }

 private:
  datasets::SketchReading Reading(bool fixed) const;
  /// Vertices of some faces, B x 3V in cm.
  FloatArray Vertices(std::span<const int> faces) const;
  void PrecomputeMoments();
  /// Classes and coefficients of the training samples.
  void PrecomputeClasses(const std::vector<int>& identities);
  void PrecomputeCoefficients(const std::vector<int>& identities, const faces::BilinearModel& bilinear);

  /// The network's features of a batch, computed in the precision of the step, as float32.
  SketchNetworkImpl::BranchFeatures Features(const train::Batch& batch);
  train::LossTerms ClassificationLoss(const SketchNetworkImpl::BranchFeatures& features, const torch::Tensor& samples);
  train::LossTerms RegressionLoss(const SketchNetworkImpl::BranchFeatures& features, const torch::Tensor& samples);
  train::LossTerms VertexLoss(const SketchNetworkImpl::BranchFeatures& features, const train::Batch& batch);

  const SketchTrainingOptions options_;
  const faces::FaceDatabase& faces_;
  torch::Device device_;
  faces::CurveEncoder encoder_;
  datasets::SketchDataset training_, validation_;
  SketchNetwork network_;
  SketchClassifier classifier_{nullptr};  ///< Where there is a stage for it.
  std::string stage_ = "tuning";
  torch::Tensor vertex_weights_;
  std::optional<losses::GramVertexLoss> gram_loss_;
  // A row a training sample, each of the stage that needs it alone.
  losses::SufficientStatistics moments_;
  torch::Tensor identity_classes_, expression_classes_;  ///< (N) int64; -100 is no class.
  FaceCoefficients coefficients_;
};

}  // namespace daumier::sketch
