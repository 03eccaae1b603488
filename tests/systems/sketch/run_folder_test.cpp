#include "systems/sketch/run_folder.h"

#include "tests/support/expect_error.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/random_bilinear.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using testing::ExpectError;

class SketchRunFolderTest : public ::testing::Test {
 protected:
  SketchRunFolderTest() { testing::WritePlainSketchRun(run()); }

  std::filesystem::path run() const { return folder_ / "run"; }
  void ExpectRefused(const std::string& part) const {
    ExpectError([&] { ReadSketchRunFolder(run()); }, part);
  }
  void SetDetails(const Json& details) const {
    Manifest manifest = ReadManifest(run(), "run");
    manifest.details = details;
    WriteManifest(run(), manifest);
  }

  const testing::TempDir folder_;
};

TEST_F(SketchRunFolderTest, IsReadBackWithTemplateModelsOptionsAndFrame) {
  const SketchRunFolder read = ReadSketchRunFolder(run());
  const faces::FaceTemplate face_template = testing::SyntheticFace();
  const FittedModels models = testing::PlainSketchModels(face_template);
  EXPECT_EQ(read.directory, run());
  EXPECT_EQ(read.manifest.seed, 7u);
  EXPECT_EQ(read.config["system"], "sketch");
  EXPECT_EQ(read.face_template.triangles, face_template.triangles);
  EXPECT_EQ(read.models.bilinear.core, models.bilinear.core);
  EXPECT_EQ(read.models.curves.core, models.curves.core);
  EXPECT_EQ(read.models.basis.size(), 0);
  EXPECT_EQ(read.models.gaussian.mean, models.gaussian.mean);
  EXPECT_EQ(read.models.gaussian.rows, models.gaussian.rows);
  EXPECT_EQ(read.network_options.resolution, 32);
  EXPECT_EQ(read.network_options.num_points, 20);
  EXPECT_EQ(read.camera.width, 256);
  EXPECT_EQ(read.camera.scale, testing::PlainSketchCamera().scale);
  EXPECT_EQ(read.feature_curves, std::vector<std::string>{testing::kPlainFeatureCurve});
}

TEST_F(SketchRunFolderTest, AnEarlierRunHasNoSystem) {
  Json details = ReadManifest(run(), "run").details;
  details.erase("system");
  SetDetails(details);
  EXPECT_NO_THROW(ReadSketchRunFolder(run()));
}

TEST_F(SketchRunFolderTest, ARunOfAnotherTaskIsRefusedWithBothNames) {
  SetDetails({{"system", "deform"}});
  ExpectRefused("this is a run of the task 'deform' (expected a run of 'sketch')");
}

TEST_F(SketchRunFolderTest, AConfigWithoutANetworkIsRefused) {
  WriteFileAtomically(ResolvedConfig(run()), "[net]\nwidth = 8\n");
  ExpectRefused("resolved.toml has no table 'network'");
}

TEST_F(SketchRunFolderTest, AnUnknownNetworkOptionIsRefusedWithTheFile) {
  WriteFileAtomically(ResolvedConfig(run()), "[network]\nwidths = 8\n");
  ExpectRefused("resolved.toml: unknown key 'widths'; did you mean 'width'?");
}

TEST_F(SketchRunFolderTest, ABilinearModelOfAnotherTemplateIsRefused) {
  FittedModels models = testing::PlainSketchModels(testing::SyntheticFace());
  models.bilinear = testing::RandomBilinear(10, 6, 3, 1);
  testing::ReplaceFittedModels(run(), models);
  ExpectRefused("the bilinear model has 30 coordinates, but the template");
}

TEST_F(SketchRunFolderTest, AManifestWithoutTheFrameOfItsSketchesIsRefused) {
  SetDetails({{"system", "sketch"}});
  ExpectRefused("the manifest does not hold the frame of the sketches");
}

TEST_F(SketchRunFolderTest, AFileThatDiffersFromItsChecksumIsNamed) {
  std::filesystem::resize_file(run() / "bilinear.safetensors", 100);
  ExpectRefused("bilinear.safetensors");
}

}  // namespace
}  // namespace daumier::sketch
