#include "models/deform_run.h"

#include "core/config.h"
#include "core/files.h"
#include "faces/face_database.h"
#include "tensor/eigen.h"
#include "tensor/module_state.h"
#include "tests/support/deform_networks.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::models {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// A run folder as a training leaves it, with codes of three faces.
class DeformRunTest : public ::testing::Test {
 protected:
  DeformRunTest() {
    const faces::FaceTemplate face_template = testing::SyntheticFace();
    const faces::ModelFrame frame = faces::HeadFrame(face_template, 2.1);
    torch::manual_seed(2);
    decoder_ = std::make_shared<AutoDecoder>(
        MakeDeformNetwork(testing::SmallDeformOptions("hypernetwork"),
                          tensor::CopyToTensor(frame.FromCm(face_template.neutral)), frame),
        3);
    MakeDirectory(run() / "best");
    WriteFileAtomically(run() / "resolved.toml", ToToml({{"product", "deform"},
                                                         {"network", ToJson(decoder_->network()->options())},
                                                         {"loss", {{"data_weight", 2e3}, {"code_weight", 5e5}}}}));
    Manifest manifest;
    manifest.kind = "run";
    manifest.verb = "train";
    manifest.counts = {{"training_faces", 3}};
    manifest.details = {{"product", "deform"}};
    manifest.checksums = faces::WriteFaceTemplate(run(), face_template);
    manifest.checksums["best/model.safetensors"] = tensor::SaveModule(run() / "best/model.safetensors", *decoder_);
    WriteManifest(run(), manifest);
  }

  fs::path run() const { return folder_ / "run"; }

  const testing::TempDir folder_;
  std::shared_ptr<AutoDecoder> decoder_;
};

TEST_F(DeformRunTest, IsReadBackWithTemplateFrameWeightsAndCodes) {
  const DeformRun read = LoadDeformRun(run());
  EXPECT_TRUE(torch::equal(read.codes, decoder_->codes()));
  EXPECT_TRUE(torch::equal(read.network->template_vertices(), decoder_->network()->template_vertices()));
  EXPECT_EQ(read.network->frame().scale, decoder_->network()->frame().scale);
  EXPECT_TRUE(torch::equal(read.network->DeformVertices(read.codes), decoder_->network()->DeformVertices(read.codes)));
  EXPECT_EQ(read.data_weight, 2e3);
  EXPECT_EQ(read.code_weight, 5e5);
  EXPECT_FALSE(read.network->is_training());
}

TEST_F(DeformRunTest, RefusesWhatIsNoFinishedRunOfThisProduct) {
  ExpectError([&] { LoadDeformRun(folder_ / "absent"); }, "is not a run folder");
  Manifest manifest = ReadManifest(run(), "run");
  manifest.details.erase("product");
  WriteManifest(run(), manifest);
  ExpectError([&] { LoadDeformRun(run()); }, "a run of kind 'sketch', not of a deformable model");
  manifest.details["product"] = "deform";
  WriteManifest(run(), manifest);
  fs::rename(run() / "best", run() / "worst");
  ExpectError([&] { LoadDeformRun(run()); }, "has no best weights yet");
}

TEST_F(DeformRunTest, RefusesDamagedWeightsAndThoseOfAnotherNetwork) {
  const fs::path weights = run() / "best/model.safetensors";
  const std::string bytes = ReadFile(weights);
  WriteFileAtomically(weights, bytes.substr(0, bytes.size() / 2));
  ExpectError([&] { LoadDeformRun(run()); }, "model.safetensors");
  WriteFileAtomically(weights, bytes);
  Json config = LoadConfig(run() / "resolved.toml");
  config["network"]["width"] = 64;
  WriteFileAtomically(run() / "resolved.toml", ToToml(config));
  ExpectError([&] { LoadDeformRun(run()); }, "model.safetensors");
}

TEST(ProductOf, ARunThatTellsNoneIsOfASketchNetwork) {
  EXPECT_EQ(ProductOf({}), "sketch");
  Manifest manifest;
  manifest.details = {{"product", "deform"}};
  EXPECT_EQ(ProductOf(manifest), "deform");
}

TEST(AutoDecoder, CodesBeginAsADeviationOfOneHundredth) {
  torch::manual_seed(6);
  const AutoDecoder decoder(MakeDeformNetwork(testing::SmallDeformOptions("positions"), testing::SomeTemplate(), {}),
                            500);
  EXPECT_NEAR(decoder.codes().std().item<double>(), 0.01, 5e-4);
}

}  // namespace
}  // namespace daumier::models
