#include "systems/portrait/portrait_weights.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/appearance/albedo_basis.h"
#include "faces/face_model_file.h"
#include "faces/face_model_weights.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"
#include "tests/support/temp_dir.h"

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// A 3DMM as a training fits it: identity modes of its own about a mean of its own.
faces::MorphableModel ModelOfARun() {
  const faces::FaceModel source = testing::SyntheticModel();
  const faces::AlbedoBasis albedo = faces::MakeAlbedoBasis(source.face_template);
  Rng rng(8);
  Eigen::MatrixXf modes = source.identity_shapes.leftCols(6);
  for (Eigen::Index k = 0; k < modes.cols(); ++k)
    modes.col(k) += float(0.1 * rng.Normal()) * source.identity_shapes.col(9);
  geometry::Points mean = source.face_template.neutral;
  mean.col(0) *= 1.01;
  return faces::ModelOfModes(source, {albedo.mean, albedo.modes}, mean, modes, "components");
}

PortraitRunFolder RunOfWeights() {
  PortraitRunFolder run;
  run.directory = "a run";
  run.model = ModelOfARun();
  run.options.network = {.depth = 18, .resolution = 64, .width = 8};
  run.options.pictures.crop = "none";
  run.options.pictures.size = 0.5;
  return run;
}

/// Writes weights as the exporter does, but for the network, whose numbers nothing here reads.
void WriteWeightsOf(const PortraitRunFolder& run, const fs::path& folder) {
  MakeDirectory(folder);
  WeightsParts parts = WritePortraitWeights(run, folder, folder.parent_path());
  Manifest manifest{.kind = kWeightsKind, .verb = "export"};
  manifest.details = {{"weights_version", kWeightsVersion},
                      {"system", kPortraitSystem},
                      {"network", NetworkToJson({run.options.network, run.model.expression_weights})}};
  manifest.details.update(parts.details);
  manifest.checksums = parts.checksums;
  for (const char* file : {kWeightsCard, kWeightsNetwork}) {
    WriteFileAtomically(folder / file, file);
    manifest.checksums[file] = Sha256(file);
  }
  WriteManifest(folder, manifest);
}

class PortraitWeightsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    faces::WriteFaceModelWeights(folder_ / "face-synthetic", testing::SyntheticModel());
    WriteWeightsOf(RunOfWeights(), folder_ / "portrait");
  }
  void ChangeDetails(const std::function<void(Json&)>& change) const {
    Manifest manifest = ReadManifest(folder_ / "portrait", kWeightsKind);
    change(manifest.details);
    WriteManifest(folder_ / "portrait", manifest);
  }

  const testing::TempDir folder_;
};

TEST_F(PortraitWeightsTest, HaveTheFacesAndOptionsOfTheRun) {
  const PortraitRunFolder run = RunOfWeights(), read = ReadPortraitFolder(folder_ / "portrait");
  EXPECT_EQ(read.directory, folder_ / "portrait");
  EXPECT_EQ(ToJson(read.options.network), ToJson(run.options.network));
  EXPECT_EQ(read.options.pictures.crop, "none");
  EXPECT_EQ(read.options.pictures.size, 0.5);
  EXPECT_EQ(read.model.expression_names, run.model.expression_names);
  EXPECT_EQ(read.model.expression_weights, run.model.expression_weights);
  EXPECT_EQ(read.model.identity_source, "components");
  EXPECT_TRUE(read.model.centre.isApprox(run.model.centre, 1e-12));
  EXPECT_TRUE(read.model.albedo_modes == run.model.albedo_modes);
  Rng rng(3);
  for (int i = 0; i < 5; ++i) {
    const std::vector<float> x = testing::DrawPortrait(run.model, rng);
    const geometry::Points difference =
        faces::Reconstruct(read.model, x).vertices - faces::Reconstruct(run.model, x).vertices;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 10 * faces::kShapeToleranceCm);
    EXPECT_GT(difference.cwiseAbs().maxCoeff(), 0);
  }
}

TEST_F(PortraitWeightsTest, RecordHowFarFacesAreFromThoseOfTheRun) {
  const Json details = ReadManifest(folder_ / "portrait", kWeightsKind).details;
  EXPECT_GT(details.at("largest_vertex_error_mm").get<double>(), 1e-6);
  EXPECT_LT(details.at("largest_vertex_error_mm").get<double>(), kWeightsToleranceMm);
  EXPECT_EQ(details.at("largest_colour_error").get<double>(), 0);
  EXPECT_EQ(details.at("face_model"), "face-synthetic");
  EXPECT_EQ(details.at("needs").at("face-synthetic"), DataHash(folder_ / "face-synthetic"));
}

TEST_F(PortraitWeightsTest, OfOneReleaseBelongTogether) {
  faces::FaceModel other = testing::SyntheticModel();
  other.identity_shapes *= 0.5F;
  faces::WriteFaceModelWeights(folder_ / "face-synthetic", other);
  ExpectError([&] { ReadPortraitWeights(folder_ / "portrait"); }, "needs other weights than those of");
  fs::remove_all(folder_ / "face-synthetic");
  ExpectError([&] { ReadPortraitWeights(folder_ / "portrait"); }, "face-synthetic, which are missing");
}

TEST_F(PortraitWeightsTest, ARunOfAnotherSourceIsRefused) {
  const auto write = [&](const std::function<void(PortraitRunFolder&)>& change) {
    PortraitRunFolder run = RunOfWeights();
    change(run);
    MakeDirectory(folder_ / "new");
    WritePortraitWeights(run, folder_ / "new", folder_.path());
  };
  EXPECT_NO_THROW(write([](PortraitRunFolder&) {}));
  ExpectError([&] { write([](PortraitRunFolder& run) { run.model.face_template.source = "wax"; }); },
              "daumier dataset model --out " + (folder_ / "face-wax").string() + " source.name=wax");
  ExpectError([&] { write([](PortraitRunFolder& run) { run.model.expression *= 1.3F; }); },
              "a run: its 3DMM has other shapes (faces differ by up to ");
  ExpectError([&] { write([](PortraitRunFolder& run) { run.model.albedo_mean.array() += 0.01F; }); },
              "other colours (they differ by up to 0.01");
  ExpectError([&] { write([](PortraitRunFolder& run) { run.model.expression_names[1] = "grin"; }); },
              "other expression shapes");
  ExpectError(
      [&] {
        write([](PortraitRunFolder& run) {
          std::swap(run.model.face_template.triangles(0, 0), run.model.face_template.triangles(0, 1));
        });
      },
      "other triangles");
}

TEST_F(PortraitWeightsTest, AMalformedManifestIsNamed) {
  const auto read = [&] { ReadPortraitWeights(folder_ / "portrait"); };
  const Json details = ReadManifest(folder_ / "portrait", kWeightsKind).details;
  for (const char* key : {"network", "pictures", "face_model"}) {
    ChangeDetails([&](Json& changed) { changed = details, changed.erase(key); });
    ExpectError(read, std::string("manifest.json: details.") + key + " is missing");
  }
  ChangeDetails([&](Json& changed) { changed = details, changed["network"]["depth"] = 1000; });
  ExpectError(read, "depth");
  ChangeDetails([&](Json& changed) { changed = details, changed["network"].erase("expression_weights"); });
  ExpectError(read, "expected a table with 'expression_weights'");
  ChangeDetails([&](Json& changed) { changed = details, changed["network"]["expression_weights"] = "cubic"; });
  ExpectError(read, "'cubic'");
  ChangeDetails([&](Json& changed) { changed = details, changed["pictures"]["crop"] = "cubic"; });
  ExpectError(read, "'crop' is 'cubic'");
  ChangeDetails([&](Json& changed) { changed = details; });
  EXPECT_NO_THROW(read());
}

TEST_F(PortraitWeightsTest, ShapesOfOtherVerticesAreNamed) {
  SafetensorsWriter writer;
  const std::vector<float> mean(9, 0);
  writer.Add<float>("mean", {3, 3}, mean);
  Manifest manifest = ReadManifest(folder_ / "portrait", kWeightsKind);
  manifest.checksums[kIdentityFile] = writer.Write(folder_ / "portrait" / kIdentityFile);
  WriteManifest(folder_ / "portrait", manifest);
  ExpectError([&] { ReadPortraitWeights(folder_ / "portrait"); }, "identity.safetensors: 'mean' is (3, 3), expected (");
}

}  // namespace
}  // namespace daumier::portrait
