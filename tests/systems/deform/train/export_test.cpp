#include "systems/deform/train/export.h"

#include "core/files.h"
#include "export/onnx_export.h"
#include "export/parity.h"
#include "tensor/tensor_file.h"
#include "tests/support/deform_run_folder.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

const faces::ModelFrame kExportFrame{0.125, {0.5, -0.71, 0.25}};

std::shared_ptr<DeformNetwork> Network(const std::string& kind) {
  torch::manual_seed(4);
  const auto network = MakeDeformNetwork(testing::SmallDeformOptions(kind), testing::SomeTemplate(), kExportFrame);
  network->eval();
  return network;
}

TEST(DeformExport, EveryKindPassesParityAtAnyNumberOfPoints) {
  const testing::TempDir folder;
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    const auto network = Network(kind);
    const exporting::ExportedFunction function = DeformFunction(network);
    const onnx::ModelProto model = exporting::ExportToOnnx(*network, function);
    WriteFileAtomically(folder / (kind + ".onnx"), model.SerializeAsString());
    const exporting::ParityReport parity =
        exporting::CheckParity(folder / (kind + ".onnx"), function, 1, folder.path());
    if (!parity.runtime.has_value()) GTEST_SKIP() << "there is no ONNX Runtime here";
    EXPECT_LT(parity.max_abs_diff(), exporting::kParityTolerance);
  }
}

TEST(DeformExport, TheModelCarriesItsFrame) {
  const auto network = Network("conditioning");
  const onnx::ModelProto model = exporting::ExportToOnnx(*network, DeformFunction(network));
  ASSERT_EQ(model.metadata_props_size(), 1);
  EXPECT_EQ(model.metadata_props(0).key(), "model_from_cm");
  const faces::ModelFrame frame = faces::ModelFrameFromJson(Json::parse(model.metadata_props(0).value()));
  EXPECT_EQ(frame.scale, kExportFrame.scale);
  EXPECT_EQ(frame.offset, kExportFrame.offset);
  const auto dimension = [&](int input, int i) {
    return model.graph().input(input).type().tensor_type().shape().dim(i);
  };
  EXPECT_EQ(dimension(0, 0).dim_value(), 1);
  EXPECT_EQ(dimension(0, 1).dim_value(), 8);
  EXPECT_TRUE(dimension(1, 0).has_dim_param());
  EXPECT_EQ(dimension(1, 1).dim_value(), 3);
}

TEST(DeformExport, ARunBecomesAFolderWithFrameTemplateAndLicences) {
  testing::AllowWarnings();  // There may be no runtime.
  const testing::TempDir folder;
  const auto decoder = testing::WriteDeformRun(folder / "run", "hypernetwork");
  exporting::WriteExport(DescribeDeformExport(folder / "run"), folder / "out");
  const Manifest manifest = ReadManifest(folder / "out", "export");
  VerifyChecksums(folder / "out", manifest);
  EXPECT_EQ(faces::ModelFrameFromJson(manifest.details.at("model_from_cm")).scale, decoder->network()->frame().scale);
  EXPECT_EQ(manifest.sources, ReadManifest(folder / "run", "run").sources);
  const auto points = tensor::LoadTensors(folder / "out/points_template.safetensors");
  EXPECT_TRUE(torch::equal(points.at("vertices"), decoder->network()->template_vertices()));
  const std::string card = ReadFile(folder / "out/model_card.md");
  for (const char* part : {"CC0", "`latent`", "`positions`", "model_from_cm"})
    EXPECT_NE(card.find(part), std::string::npos) << part;
}

TEST(DeformExport, ARunOfAnotherTaskIsRefused) {
  const testing::TempDir folder;
  testing::ExpectError([&] { DescribeDeformExport(folder / "run"); }, "is not a run folder");
  testing::WriteDeformRun(folder / "run", "positions");
  Manifest manifest = ReadManifest(folder / "run", "run");
  manifest.details.erase("product");
  WriteManifest(folder / "run", manifest);
  testing::ExpectError([&] { DescribeDeformExport(folder / "run"); }, "this is a run of the task 'sketch'");
}

}  // namespace
}  // namespace daumier::deform
