#include "systems/portrait/train/portrait_export.h"

#include "core/config.h"
#include "core/run_manifest.h"
#include "export/onnx_export.h"
#include "export/parity.h"
#include "export/torch_runner.h"
#include "export/weights.h"
#include "faces/appearance/albedo_basis.h"
#include "faces/face_model_weights.h"
#include "systems/portrait/portrait_predictor.h"
#include "tensor/module_state.h"
#include "tests/support/expect_error.h"
#include "tests/support/warnings.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PortraitFunction, HasTheNumbersOfTheNetworkWithExpressionsInRange) {
  torch::manual_seed(4);
  PortraitNetwork network(PortraitNetworkOptions{.depth = 18, .resolution = 32, .width = 8},
                          faces::ExpressionWeights::kUnit);
  {
    const torch::NoGradGuard no_grad;
    for (auto& parameter : network->parameters())
      if (parameter.abs().max().item<float>() == 0) parameter.normal_(0, 0.5);
  }
  network->eval();
  const exporting::ExportedFunction function = PortraitFunction(network);
  ASSERT_EQ(function.inputs.size(), 1U);
  Rng rng(1);
  const torch::Tensor crops = function.inputs[0].sample(3, rng);
  EXPECT_EQ(crops.sizes(), (std::vector<int64_t>{3, 3, 32, 32}));
  const torch::Tensor x = function.forward({crops})[0], expression = x.slice(1, 80, 144);
  EXPECT_GE(expression.min().item<float>(), 0);
  EXPECT_LE(expression.max().item<float>(), 1);
  EXPECT_TRUE(x.slice(1, 0, 80).allclose(network->forward(crops).slice(1, 0, 80)));
}

TEST(PortraitExport, DescribesAFinishedRunWhoseGraphAgreesWithLibTorch) {
  testing::AllowWarnings();  // There may be no runtime.
  const exporting::RunExport run = DescribePortraitExport(testing::SmallPortraitRun());
  EXPECT_EQ(run.counts.at("vertices"), testing::SyntheticFace().num_vertices());
  EXPECT_NE(run.card.inputs_and_outputs.find("3, 32, 32"), std::string::npos);
  const testing::TempDir folder;
  const Json parity = exporting::WriteExport(run, folder / "export");
  EXPECT_EQ(parity.at("inputs").at("crop"), "crops of portraits");
  if (parity.at("max_abs_diff").is_number()) {
    EXPECT_LT(parity.at("max_abs_diff").get<double>(), 1e-4);
  }
  const faces::MorphableModel model = faces::ReadMorphableModel(folder / "export");
  EXPECT_EQ(model.expression_names, testing::SyntheticMorphable().expression_names);
  testing::ExpectError([] { DescribePortraitExport(testing::SmallPortraitFolder() / "portraits"); }, "portraits");
}

/// A finished run of a random network with the 3DMM of a training, whose albedo is that of its template.
std::filesystem::path WriteRunWithOwnAlbedo(const std::filesystem::path& run) {
  const faces::FaceModel source = testing::SyntheticModel();
  const faces::AlbedoBasis albedo = faces::MakeAlbedoBasis(source.face_template);
  PortraitTrainingOptions options;
  options.network = {.depth = 18, .resolution = 32, .width = 8};
  options.pictures.crop = "none";
  torch::manual_seed(9);
  fitting::PortraitPose pose = fitting::PortraitPose::Zero();
  pose[5] = -40;
  PortraitNetwork network(options.network, faces::ExpressionWeights::kUnit, pose);
  network->forward(torch::rand({8, 3, 32, 32}));  // Batch norms move away from 0 and 1.
  {
    const torch::NoGradGuard no_grad;
    for (auto& parameter : network->parameters())
      if (parameter.abs().max().item<float>() == 0) parameter.normal_(0, 0.05);
  }
  MakeDirectory(run / "best");
  MakeDirectory(ReportDirectory(run));
  WriteFileAtomically(ReportMetrics(run), R"({"vertex_error_mm": 3})");
  WriteFileAtomically(ResolvedConfig(run), ToToml(ToJson(options)));
  Manifest manifest{.kind = "run", .verb = "train", .seed = 2};
  manifest.config = ToJson(options);
  manifest.config.erase("data");
  manifest.details = {{"system", kPortraitSystem}, {"data", {{"portraits", "abc"}}}};
  manifest.checksums = faces::WriteMorphableFiles(
      run, faces::ModelOfModes(source, {albedo.mean, albedo.modes}, source.face_template.neutral,
                               source.identity_shapes.leftCols(8), "components"));
  manifest.checksums[kBestFile] = tensor::SaveModule(run / kBestFile, *network);
  WriteManifest(run, manifest);
  return run;
}

PortraitPredictor PredictorOf(PortraitRunFolder folder, const exporting::NetworkFunction& network) {
  return PortraitPredictor(std::move(folder), std::make_shared<exporting::TorchRunner>(network, torch::kCPU), nullptr);
}

TEST(PortraitExport, BecomesShippedWeightsThatPredictTheSameFaces) {
  const testing::TempDir folder;
  const std::filesystem::path run = WriteRunWithOwnAlbedo(folder / "run"), shipped = folder / "weights/portrait";
  const auto write = [&] {
    exporting::WriteWeights(DescribePortraitExport(run), MakePortraitNetwork, {.out = shipped});
  };
  MakeDirectory(folder / "weights");
  testing::ExpectError(write, "face-synthetic is missing, the face model");
  faces::WriteFaceModelWeights(folder / "weights/face-synthetic", testing::SyntheticModel());
  write();

  PortraitRunFolder of_weights = ReadPortraitFolder(shipped);
  const auto network = exporting::ReadWeightsNetwork(shipped, of_weights.manifest.details, MakePortraitNetwork);
  const std::vector<systems::Input> inputs = {render::Image(60, 40, 3, 90), render::Image(224, 224, 3, 200)};
  const auto faces = PredictorOf(ReadPortraitFolder(run), NetworkOf(DescribePortraitExport(run))).Predict(inputs);
  const auto others = PredictorOf(std::move(of_weights), network).Predict(inputs);
  for (size_t i = 0; i < inputs.size(); ++i) {
    const double mm = faces::MillimetresPerCm(*faces[i].face_template);
    EXPECT_LT(mm * (faces[i].vertices - others[i].vertices).rowwise().norm().maxCoeff(), 0.5);
    EXPECT_LT((faces[i].identity - others[i].identity).cwiseAbs().maxCoeff(), 0.05);
    EXPECT_GT(faces[i].identity.cwiseAbs().maxCoeff(), 0.01) << "the network does something";
  }
}

}  // namespace
}  // namespace daumier::portrait
