#pragma once
#include "datasets/read/point_dataset.h"
#include "datasets/read/splits.h"
#include "systems/deform/options.h"
#include "systems/deform/train/run.h"
#include "train/recipe.h"

#include <memory>

namespace daumier::deform {

/// A deformable model and a code of each training face, learnt together [Jung et al. 2022, eq. 1]:
///   data_weight mean |D(z_k, p) - g|^2 + code_weight mean z_k^2,
/// the first mean over the coordinates of all points of the batch, the second over its codes' numbers. Losses also
/// report training_error_mm, the mean distance of the batch's points. Validation finds the codes of unseen faces with
/// the network held fixed, and reports their mean vertex error as mean_vertex_error_mm and, in model units,
/// vertex_error. Databases have to outlive it.
class DeformRecipe : public train::Recipe {
 public:
  /// Draws the first weights and codes from LibTorch's CPU generator. @throws Error if a subset of the split that
  /// training needs is empty, UsageError if the precision is not float32.
  DeformRecipe(const DeformTrainingOptions& options, const faces::FaceDatabase& faces,
               const datasets::PointDatabase& points, const datasets::Split& split, torch::Device device);

  torch::nn::Module& module() override { return *decoder_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return training_.size(); }
  SampleBatch Read(std::span<const int> samples, int64_t epoch) const override { return training_.Get(samples, epoch); }
  train::LossTerms Loss(const train::Batch& batch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "mean_vertex_error_mm"; }

  const AutoDecoder& decoder() const { return *decoder_; }
  AutoDecoder& decoder() { return *decoder_; }
  /// Vertices (n, V, 3) in the model's frame of the validation faces / of all training faces.
  const torch::Tensor& validation_vertices() const { return validation_vertices_; }
  torch::Tensor TrainingVertices() const;

 private:
  const DeformTrainingOptions options_;
  const double mm_per_unit_;
  torch::Device device_;
  datasets::PointDataset training_;
  std::shared_ptr<AutoDecoder> decoder_;
  torch::Tensor validation_vertices_;
};

}  // namespace daumier::deform
