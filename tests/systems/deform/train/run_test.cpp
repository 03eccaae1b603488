#include "systems/deform/train/run.h"

#include "systems/deform/network_code_model.h"
#include "tests/support/deform_run_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

class DeformRunTest : public ::testing::Test {
 protected:
  fs::path run() const { return folder_ / "run"; }

  const testing::TempDir folder_;
  const std::shared_ptr<AutoDecoder> decoder_ = testing::WriteDeformRun(run(), "hypernetwork");
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

TEST(DeformRun, IsDecodedWithoutLibTorch) {
  for (const char* kind : {"hypernetwork", "conditioning"}) {
    const testing::TempDir folder;
    const auto decoder = testing::WriteDeformRun(folder / "run", kind);
    const NetworkCodeModel model(testing::SyntheticFace(), decoder->network()->options(),
                                 folder / "run/best/model.safetensors");
    const Eigen::VectorXd code = Eigen::VectorXd::LinSpaced(model.num_numbers(), -1, 2);
    const Eigen::VectorXf latent = model.Latent(code).cast<float>();
    const torch::Tensor codes = torch::from_blob(const_cast<float*>(latent.data()), {1, latent.size()});
    const geometry::Points truth = decoder->network()->frame().ToCm(
        tensor::CopyToMatrix<double>(decoder->network()->DeformVertices(codes)[0].detach()));
    EXPECT_LT((model.Vertices(code) - truth).cwiseAbs().maxCoeff(), 1e-4) << kind;
  }
}

TEST_F(DeformRunTest, RefusesWhatIsNoFinishedRunOfThisProduct) {
  ExpectError([&] { LoadDeformRun(folder_ / "absent"); }, "is not a run folder");
  Manifest manifest = ReadManifest(run(), "run");
  manifest.details.erase("product");
  WriteManifest(run(), manifest);
  ExpectError([&] { LoadDeformRun(run()); }, "this is a run of the task 'sketch' (expected a run of 'deform')");
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

TEST(AutoDecoder, CodesBeginAsADeviationOfOneHundredth) {
  torch::manual_seed(6);
  const AutoDecoder decoder(MakeDeformNetwork(testing::SmallDeformOptions("positions"), testing::SomeTemplate(), {}),
                            500);
  EXPECT_NEAR(decoder.codes().std().item<double>(), 0.01, 5e-4);
}

}  // namespace
}  // namespace daumier::deform
