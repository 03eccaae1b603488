#include "systems/deform/import_authors_model.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/safetensors.h"
#include "systems/deform/open_code_model.h"
#include "systems/deform/run_folder.h"
#include "tests/support/authors_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;

AuthorsFiles FilesIn(const TempDir& folder) {
  return {folder / "checkpoint.pth", folder / "template.obj", folder / "template.json", ""};
}

TEST(ImportAuthorsModel, TheRunDecodesByTheEquationsOfThePaper) {
  const TempDir folder;
  const NamedArrays state = testing::WriteAuthorsFiles(folder.path());
  const Json summary = ImportAuthorsModel(FilesIn(folder), folder / "run");
  EXPECT_EQ(summary.at("training_faces"), 40);
  EXPECT_EQ(summary.at("layers"), 5);
  EXPECT_EQ(summary.at("unused_tensors"), 10);
  const OpenedModel opened = OpenCodeModel(folder / "run");
  EXPECT_EQ(opened.kind, "hypernetwork");
  EXPECT_TRUE(opened.faces.empty());
  const geometry::Points points = testing::AuthorsTemplate();
  Eigen::VectorXd code = Eigen::VectorXd::LinSpaced(opened.model->num_numbers(), -1, 2);
  for (int i = 0; i < 3; ++i, code = -0.5 * code.reverse()) {
    const Eigen::VectorXd latent = opened.model->Latent(code);
    const geometry::Points vertices = opened.model->Vertices(code);
    double largest = 0, difference = 0;
    for (Eigen::Index v = 0; v < points.rows(); v += 7) {
      const Eigen::Vector3d truth = 10 * testing::AuthorsPosition(state, latent, points.row(v).transpose());
      largest = std::max(largest, truth.cwiseAbs().maxCoeff());
      difference = std::max(difference, (vertices.row(v).transpose() - truth).cwiseAbs().maxCoeff());
    }
    EXPECT_LT(difference, 1e-5 * largest);
  }
}

TEST(ImportAuthorsModel, TheTemplateIsThatMeshInCentimetres) {
  const TempDir folder;
  testing::WriteAuthorsFiles(folder.path());
  ImportAuthorsModel(FilesIn(folder), folder / "run");
  const DeformRunFolder run = ReadDeformRunFolder(folder / "run");
  EXPECT_TRUE(run.is_imported());
  EXPECT_EQ(run.data_weight, 3e3);
  EXPECT_EQ(run.code_weight, 1e6);
  EXPECT_LT((run.face_template.neutral - 10 * testing::AuthorsTemplate()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(run.face_template.triangles, testing::SyntheticFace().triangles);
  EXPECT_EQ(run.face_template.annotation.landmarks, testing::SyntheticFace().annotation.landmarks);
  EXPECT_EQ(run.manifest.verb, "import");
  EXPECT_EQ(run.manifest.sources[0].at("licence"), kAuthorsLicence);
  EXPECT_EQ(run.manifest.details.at("imported").at("checkpoint"), Sha256OfFile(folder / "checkpoint.pth"));
}

TEST(ImportAuthorsModel, EqualFilesGiveEqualBytesAndReplaceAnEarlierImport) {
  const TempDir folder;
  testing::WriteAuthorsFiles(folder.path());
  ImportAuthorsModel(FilesIn(folder), folder / "a");
  ImportAuthorsModel(FilesIn(folder), folder / "b");
  EXPECT_EQ(DataHash(folder / "a"), DataHash(folder / "b"));
  AuthorsFiles other = FilesIn(folder);
  other.licence = "Given to me";
  ImportAuthorsModel(other, folder / "b");
  EXPECT_EQ(ReadManifest(folder / "b", "run").sources[1].at("licence"), "Given to me");
}

TEST(ImportAuthorsModel, RefusesATemplateThatLiesElsewhere) {
  const TempDir folder;
  testing::WriteAuthorsFiles(folder.path());
  geometry::WriteObj(folder / "template.obj",
                     geometry::TriangleMesh{10 * testing::AuthorsTemplate(), testing::SyntheticFace().triangles});
  ExpectError([&] { ImportAuthorsModel(FilesIn(folder), folder / "run"); },
              "expected about x -0.85 .. 0.85, y -0.71 .. 1.4, z -1.15 .. 0.63");
  EXPECT_FALSE(fs::exists(folder / "run"));
}

TEST(ImportAuthorsModel, KeepsARunThatWasTrained) {
  const TempDir folder;
  testing::WriteAuthorsFiles(folder.path());
  Manifest trained;
  trained.kind = "run";
  trained.verb = "train";
  MakeDirectory(folder / "run");
  WriteManifest(folder / "run", trained);
  ExpectError([&] { ImportAuthorsModel(FilesIn(folder), folder / "run"); }, "this is a run that was trained");
}

TEST(ImportAuthorsModel, NothingIsWrittenOfABadCheckpoint) {
  const TempDir folder;
  NamedArrays state = testing::WriteAuthorsFiles(folder.path());
  state.erase("hyper_net.nets.4.net.1.0.bias");
  testing::WriteTorchState(folder / "checkpoint.pth", state);
  ExpectError([&] { ImportAuthorsModel(FilesIn(folder), folder / "run"); },
              (folder / "checkpoint.pth").string() + ": there is no tensor 'hyper_net.nets.4.net.1.0.bias'");
  EXPECT_FALSE(fs::exists(folder / "run"));
}

}  // namespace
}  // namespace daumier::deform
