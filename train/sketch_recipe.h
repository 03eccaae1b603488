#pragma once
#include "core/options.h"
#include "datasets/read/sketch_database.h"
#include "datasets/read/sketch_dataset.h"
#include "datasets/read/splits.h"
#include "faces/bilinear_model.h"
#include "faces/face_database.h"
#include "losses/vertex_loss.h"
#include "models/sketch_network.h"
#include "train/recipe.h"
#include "train/trainer.h"

#include <filesystem>
#include <optional>
#include <string>

namespace daumier::train {

struct SketchDataOptions {
  std::string faces, sketches;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces.");
    visit("sketches", sketches, Text{}, "Folder of their sketches.");
  }
};

struct SketchTrainingOptions {
  SketchDataOptions data;
  datasets::SplitOptions split;
  faces::BilinearOptions bilinear;
  datasets::SketchVariation sketch;
  models::PixelCnnOptions network;
  OptimiserOptions optimiser;
  TrainerOptions trainer;
  std::string loss = "gram";
  double curve_weight = 2;
  uint64_t seed = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("data", data, Table{}, "What is learnt from.");
    visit("split", split, Table{}, "Who trains, who validates, who tests.");
    visit("bilinear", bilinear, Table{}, "The bilinear face model, fitted on training faces.");
    visit("sketch", sketch, Table{}, "Which sketch of a face is seen in training.");
    visit("network", network, Table{}, "The network.");
    visit("optimiser", optimiser, Table{}, "AdamW and its schedule.");
    trainer.Visit(visit);
    visit("loss", loss, Choices{{"gram", "vertices"}},
          "How the vertex loss is computed; gram reads no vertex in a step and gives the same number.");
    visit("curve_weight", curve_weight, Range{1, 1000},
          "Weight of the vertices of feature curves in the vertex loss; all others weigh 1.");
    visit("seed", seed, Range{0, 9e15},
          "Of the split, the first weights, the order of the samples and their augmentation.");
  }
};

/// w of the vertex loss [Han et al. 2017, eq. 2], V: curve_weight on the vertices of the annotation's feature curves, 1
/// elsewhere.
torch::Tensor CurveVertexWeights(const faces::FaceTemplate& face_template, double curve_weight);

/// A sketch network on the training faces of a split, whose sketches vary from epoch to epoch; those of
/// validation are exact and not augmented. The validation's mean_vertex_error_mm is the one of
/// eval/metrics.h over the region `face`. The databases have to outlive it.
class SketchRecipe : public Recipe {
 public:
  /// Draws the first weights from LibTorch's CPU generator. @throws Error if a side of the split that training needs is
  /// empty.
  SketchRecipe(const SketchTrainingOptions& options, const faces::FaceDatabase& faces,
               const datasets::SketchDatabase& sketches, const datasets::Split& split,
               const faces::BilinearModel& bilinear, torch::Device device);

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return training_.size(); }
  LossTerms Loss(const std::vector<int>& samples, int64_t epoch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "mean_vertex_error_mm"; }
  tensor::NamedTensors BatchTensors(const std::vector<int>& samples, int64_t epoch) override;

  const models::SketchNetwork& network() const { return network_; }

 private:
  /// Vertices of some faces, (B, 3V), on the device.
  torch::Tensor Targets(std::span<const int> faces) const;
  losses::VertexMoments MomentsOf(const std::vector<int>& samples) const;
  void PrecomputeMoments();

  const faces::FaceDatabase& faces_;
  torch::Device device_;
  datasets::SketchDataset training_, validation_;
  models::SketchNetwork network_;
  torch::Tensor vertex_weights_;
  std::optional<losses::GramVertexLoss> gram_loss_;
  losses::VertexMoments moments_;  ///< A row a training sample; of the gram loss alone.
};

/// `daumier train` of a sketch network: opens the databases, splits, fits the bilinear model on training faces, trains,
/// and leaves a run folder that models::LoadSketchRun reads. The manifest tells the split, what the bilinear model was
/// fitted on, the hashes of the data and their licences, and holds no path. device: "cpu" or "cuda".
/// @throws UsageError as ParseOptions and OpenRunFolder, Error as Train and the databases.
TrainingSummary TrainSketch(const Json& config, const std::filesystem::path& run_directory, bool resume,
                            const std::string& device);

}  // namespace daumier::train
