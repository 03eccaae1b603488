#include "datasets/build/points.h"

#include "core/config.h"
#include "core/files.h"
#include "datasets/build/face_attributes.h"
#include "datasets/read/point_database.h"
#include "faces/open_mouth.h"
#include "geometry/surface_samples.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;

class BuildPointsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    FacesOptions faces = testing::SyntheticFacesOptions(2);
    faces.num_interpolated = 3;
    faces.family_size = 2;
    BuildFaces(testing::SyntheticModel(), faces, *folder_ / "faces");
    BuildPoints(Options(), *folder_ / "points");
  }
  static void TearDownTestSuite() { delete folder_; }

  static PointsOptions Options() {
    PointsOptions options;
    options.faces = (*folder_ / "faces").string();
    options.num_samples = 500;
    options.mouth_gap = 0.2;
    options.seed = 5;
    return options;
  }

  static inline TempDir* folder_ = nullptr;
};

TEST_F(BuildPointsTest, SamplesAreDrawnOnTheFacesOwnSurface) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  const PointDatabase points(*folder_ / "points");
  ASSERT_EQ(points.num_faces(), faces.num_faces());
  ASSERT_EQ(points.num_samples(), 500);
  for (const int face : {0, 9, faces.num_faces() - 1}) {
    Rng rng = Stream(5, "surface samples", uint64_t(face));
    const geometry::SurfaceSamples expected =
        geometry::SampleSurface({faces.points(face), faces.face_template().triangles}, 500, rng);
    const SurfaceSamples samples = points.samples(face);
    EXPECT_TRUE(std::ranges::equal(samples.triangles, expected.triangles)) << face;
    EXPECT_TRUE(std::ranges::equal(samples.weights, expected.weights)) << face;
  }
}

TEST_F(BuildPointsTest, TheTemplateHasItsMouthOpenInTheModelFrame) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const PointDatabase points(*folder_ / "points");
  const faces::ModelFrame frame = faces::HeadFrame(face, 2.1);
  EXPECT_EQ(points.frame().scale, frame.scale);
  EXPECT_EQ(points.frame().offset, frame.offset);
  const geometry::Points expected = frame.FromCm(faces::OpenMouth(face, 0.2 / frame.scale));
  const auto vertices = points.template_vertices();
  for (int v = 0; v < face.num_vertices(); ++v) {
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(vertices[size_t(3 * v + k)], expected(v, k), 1e-6);
  }
  const auto height = [&](int landmark) { return vertices[size_t(3 * face.annotation.landmarks[landmark] + 1)]; };
  EXPECT_NEAR(height(62) - height(66), 0.2, 1e-6);
  EXPECT_EQ(points.face_template().neutral, face.neutral);
}

TEST_F(BuildPointsTest, AttributesAreThoseOfTheFaces) {
  const AttributeTable table = FaceAttributes(faces::FaceDatabase(*folder_ / "faces"));
  const PointDatabase points(*folder_ / "points");
  EXPECT_EQ(points.attribute_names(), table.names);
  for (int face = 0; face < points.num_faces(); ++face)
    EXPECT_TRUE(std::ranges::equal(points.attributes(face), table.values.row(face)));
}

TEST_F(BuildPointsTest, ManifestNamesItsFacesAndTheirLicencesAndNoPath) {
  const Manifest manifest = ReadManifest(*folder_ / "points", "points");
  EXPECT_EQ(manifest.details.at("faces_data_hash"), DataHash(*folder_ / "faces"));
  EXPECT_EQ(manifest.sources, ReadManifest(*folder_ / "faces", "faces").sources);
  EXPECT_FALSE(manifest.config.contains("faces"));
  EXPECT_EQ(manifest.seed, 5u);
  EXPECT_EQ(ReadFile(*folder_ / "points/manifest.json").find(folder_->path().string()), std::string::npos);
}

TEST_F(BuildPointsTest, AnInterruptedBuildEndsWithTheSameBytes) {
  ExpectError([&] { BuildPoints(Options(), *folder_ / "stopped", testing::CancelledTask()); }, "stopped after");
  BuildPoints(Options(), *folder_ / "stopped");
  EXPECT_EQ(DataHash(*folder_ / "stopped"), DataHash(*folder_ / "points"));
}

TEST_F(BuildPointsTest, WithoutSamplesThereAreVerticesAlone) {
  PointsOptions options = Options();
  options.num_samples = 0;
  BuildPoints(options, *folder_ / "none");
  EXPECT_EQ(PointDatabase(*folder_ / "none").samples(3).triangles.size(), 0u);
}

TEST(PointsConfig, EveryFileIsParsed) {
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs/points")) {
    EXPECT_NO_THROW(ParseOptions<PointsOptions>(LoadConfig(entry.path()), entry.path().string())) << entry.path();
  }
}

TEST(PointsConfig, PaperHasAsManySamplesAsTheReferenceInAdditionToVertices) {
  const auto file = testing::SourceRoot() / "configs/points/paper.toml";
  EXPECT_EQ(11551 + ParseOptions<PointsOptions>(LoadConfig(file), file.string()).num_samples, 23132);
}

}  // namespace
}  // namespace daumier::datasets
