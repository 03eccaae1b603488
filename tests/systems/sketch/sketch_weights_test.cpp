#include "systems/sketch/sketch_weights.h"

#include "core/error.h"
#include "core/files.h"
#include "core/half.h"
#include "core/safetensors.h"
#include "faces/face_model_weights.h"
#include "tests/support/expect_error.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/synthetic_model.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// A run whose network has the basis of its Gaussian.
SketchRunFolder RunWithGaussianBasis() {
  SketchRunFolder run;
  run.directory = "a run";
  run.face_template = testing::SyntheticModel().face_template;
  run.models = testing::PlainSketchModels(run.face_template);
  run.models.basis = faces::BasisOf(run.models.gaussian);
  run.network_options = {.residual = run.models.basis.size(), .basis = "gaussian"};
  run.camera = testing::PlainSketchCamera();
  run.feature_curves = {testing::kPlainFeatureCurve};
  return run;
}

/// Writes weights as the exporter does, of the network its basis alone.
void WriteSketchWeightsOf(const SketchRunFolder& run, const fs::path& folder) {
  MakeDirectory(folder);
  const WeightsParts parts = WriteSketchWeights(run, folder.parent_path());
  Manifest manifest{.kind = kWeightsKind, .verb = "export"};
  manifest.details = {{"weights_version", kWeightsVersion},
                      {"system", kSystem},
                      {"network", NetworkToJson({run.network_options, {6, 3, 9, run.face_template.num_vertices()}})}};
  manifest.details.update(parts.details);
  const auto& rows = run.models.basis.rows;
  std::vector<Half> halves(size_t(rows.size()));
  std::ranges::transform(std::span(rows.data(), size_t(rows.size())), halves.begin(), HalfFromFloat);
  SafetensorsWriter network;
  network.Add<Half>("basis", {rows.rows(), rows.cols()}, halves);
  manifest.checksums[kWeightsNetwork] = network.Write(folder / kWeightsNetwork);
  WriteFileAtomically(folder / kWeightsCard, "card");
  manifest.checksums[kWeightsCard] = Sha256("card");
  WriteManifest(folder, manifest);
}

class SketchWeightsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    faces::WriteFaceModelWeights(folder_ / "face-synthetic", testing::SyntheticModel());
    WriteSketchWeightsOf(RunWithGaussianBasis(), folder_ / "sketch");
  }
  void ChangeDetails(const std::function<void(Json&)>& change) const {
    Manifest manifest = ReadManifest(folder_ / "sketch", kWeightsKind);
    change(manifest.details);
    WriteManifest(folder_ / "sketch", manifest);
  }

  const testing::TempDir folder_;
};

TEST_F(SketchWeightsTest, HaveTheTemplateCameraAndGaussianOfTheRun) {
  const SketchRunFolder run = RunWithGaussianBasis(), read = ReadSketchFolder(folder_ / "sketch");
  EXPECT_EQ(read.face_template.num_vertices(), run.face_template.num_vertices());
  EXPECT_EQ(read.feature_curves, run.feature_curves);
  EXPECT_EQ(read.camera.scale, run.camera.scale);
  EXPECT_EQ(ToJson(read.network_options), ToJson(run.network_options));
  EXPECT_EQ(read.models.bilinear.num_coordinates(), 0);
  const faces::FaceGaussian &gaussian = run.models.gaussian, &other = read.models.gaussian;
  EXPECT_EQ(other.num_symmetric, gaussian.num_symmetric);
  ASSERT_EQ(other.size(), gaussian.size());
  EXPECT_LT((other.mean - gaussian.mean).cwiseAbs().maxCoeff(), 0.02);  // Half has 11 bits.
  EXPECT_LT((other.rows - gaussian.rows).cwiseAbs().maxCoeff(), 0.005);
}

TEST_F(SketchWeightsTest, AreRefusedOfANetworkThatTheyCannotHold) {
  SketchRunFolder run = RunWithGaussianBasis();
  run.network_options.basis = "faces";
  ExpectError([&] { WriteSketchWeights(run, folder_.path()); }, "network.basis=\"gaussian\"");
  ExpectError([&] { WriteSketchWeights(RunWithGaussianBasis(), folder_ / "nowhere"); }, "daumier dataset model");
  run = RunWithGaussianBasis();
  run.face_template.neutral(0, 0) += 1;
  ExpectError([&] { WriteSketchWeights(run, folder_.path()); }, "another template");
}

TEST_F(SketchWeightsTest, MalformedOnesAreNamed) {
  ChangeDetails([](Json& details) { details["gaussian"]["mean"] = "a"; });
  ExpectError([&] { ReadSketchWeights(folder_ / "sketch"); }, "manifest.json: details are malformed");
  ChangeDetails([](Json& details) { details.erase("gaussian"); });
  ExpectError([&] { ReadSketchWeights(folder_ / "sketch"); }, "details.gaussian is missing");
}

TEST_F(SketchWeightsTest, NeedTheFaceModelTheyWereMadeWith) {
  fs::remove_all(folder_ / "face-synthetic");
  ExpectError([&] { ReadSketchWeights(folder_ / "sketch"); }, "face-synthetic");
}

TEST(SketchNetworkOfWeights, SurvivesJson) {
  const SketchNetworkOfWeights network{{.residual = 5, .basis = "gaussian"}, {6, 3, 9, 40}};
  const SketchNetworkOfWeights read = SketchNetworkFromJson(NetworkToJson(network));
  EXPECT_EQ(ToJson(read.options), ToJson(network.options));
  EXPECT_EQ(ToJson(read.sizes), ToJson(network.sizes));
  ExpectError([] { SketchNetworkFromJson(Json::object()); }, "no tables 'options' and 'sizes'");
}

}  // namespace
}  // namespace daumier::sketch
