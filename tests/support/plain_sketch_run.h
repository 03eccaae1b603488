#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "core/safetensors.h"
#include "faces/coefficient_prior.h"
#include "faces/face_database.h"
#include "fitting/projected_curves.h"
#include "render/camera_json.h"
#include "runtime/network_runner.h"
#include "systems/sketch/run_folder.h"
#include "tests/support/plain_gaussian.h"
#include "tests/support/synthetic_bilinear.h"
#include "tests/support/synthetic_face.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

/// A sketch run on the synthetic face without LibTorch: a folder whose weights are no network, and a network that
/// predicts a fixed face.
namespace daumier::testing {

inline const char* const kPlainFeatureCurve = "upper_mouth";

inline render::Camera PlainSketchCamera() {
  return render::FrontalCamera({0, 0, 0}, 12, render::kSketchCanvas);
}

/// Faces like the synthetic one, 6 identity and 3 expression weights, the curves of these faces on the canvas, and their
/// normal distribution.
inline sketch::FittedModels PlainSketchModels(const faces::FaceTemplate& face_template) {
  sketch::FittedModels models{SyntheticBilinear(face_template, 6, 3, 1), {}, {}};
  const auto curves = fitting::SeeCurves(face_template, {kPlainFeatureCurve}, PlainSketchCamera());
  const fitting::ProjectedModel projected = fitting::ProjectModel(curves, models.bilinear);
  models.curves = projected.model;
  models.curves.core.row(0) += projected.constant.transpose();
  models.gaussian = PlainGaussian(face_template, models.bilinear);
  return models;
}

/// Writes the files of the fitted models into a run folder, and their checksums into its manifest.
inline void ReplaceFittedModels(const std::filesystem::path& run, const sketch::FittedModels& models) {
  Manifest manifest = ReadManifest(run, "run");
  for (const auto& [file, checksum] : sketch::WriteFittedModels(run, models)) manifest.checksums[file] = checksum;
  WriteManifest(run, manifest);
}

/// Writes a finished run of the system "sketch".
inline void WritePlainSketchRun(const std::filesystem::path& run,
                                const sketch::SketchNetworkOptions& network = {.resolution = 32, .num_points = 20}) {
  const faces::FaceTemplate face_template = SyntheticFace();
  MakeDirectory(run / "best");
  WriteFileAtomically(ResolvedConfig(run), ToToml({{"system", sketch::kSystem}, {"network", ToJson(network)}}));
  Manifest manifest;
  manifest.kind = "run";
  manifest.verb = "train";
  manifest.seed = 7;
  manifest.sources =
      Json::array({{{"name", "synthetic"}, {"version", "1"}, {"checksum", "0"}, {"licence", "CC0-1.0"}}});
  manifest.details = {
      {"system", sketch::kSystem},
      {"sketches", {{"camera", render::CameraToJson(PlainSketchCamera())}, {"feature_curves", {kPlainFeatureCurve}}}}};
  manifest.checksums = faces::WriteFaceTemplate(run, face_template);
  SafetensorsWriter weights;
  const std::array<float, 2> numbers{1, 2};
  weights.Add<float>("weight", {2}, numbers);
  manifest.checksums[kBestFile] = weights.Write(BestWeights(run));
  WriteManifest(run, manifest);
  ReplaceFittedModels(run, PlainSketchModels(face_template));
}

/// A network that ignores the values of its inputs. Row i of the output: the mean u with i * row_step added to its
/// second number, the mean v, and the bilinear face of both. Records its inputs; may be called from several threads.
class FixedNetwork : public runtime::NetworkRunner {
 public:
  explicit FixedNetwork(const faces::BilinearModel& model, float row_step = 0)
      : model_(model), prior_(faces::PriorOf(model)), row_step_(row_step) {}

  Eigen::VectorXf u(int64_t row = 0) const {
    Eigen::VectorXf u = prior_.u_mean;
    u[1] += float(row) * row_step_;
    return u;
  }
  Eigen::VectorXf v() const { return prior_.v_mean; }
  Eigen::VectorXf vertices(int64_t row = 0) const { return faces::Reconstruct(model_, u(row), v()); }

  NamedArrays Run(const NamedArrays& inputs) const override {
    {
      const std::lock_guard lock(mutex_);
      inputs_.push_back(inputs);
    }
    NamedArrays outputs;
    const int64_t count = inputs.begin()->second.shape[0];
    for (int64_t row = 0; row < count; ++row) {
      SetRow(outputs["u"], count, row, u(row));
      SetRow(outputs["v"], count, row, v());
      SetRow(outputs["vertices"], count, row, vertices(row));
    }
    return outputs;
  }

  /// Of every call, in order.
  std::vector<NamedArrays> inputs() const {
    const std::lock_guard lock(mutex_);
    return inputs_;
  }

 private:
  static void SetRow(FloatArray& array, int64_t count, int64_t row, const Eigen::VectorXf& numbers) {
    if (!array.defined()) array = FloatArray({count, numbers.size()});
    std::ranges::copy(numbers, array.row(row));
  }

  faces::BilinearModel model_;
  faces::CoefficientPrior prior_;
  float row_step_;
  mutable std::mutex mutex_;
  mutable std::vector<NamedArrays> inputs_;
};

}  // namespace daumier::testing
