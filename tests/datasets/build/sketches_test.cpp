#include "datasets/build/sketches.h"

#include "core/config.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"
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

class BuildSketchesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 3);
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
  }
  static void TearDownTestSuite() { delete folder_; }

  static inline TempDir* folder_ = nullptr;
};

TEST_F(BuildSketchesTest, MeanHeadStandsInTheMiddle) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const render::Camera camera = SketchCamera(face, 0.62);
  const geometry::Points pixels = render::Project(camera, face.neutral);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const faces::FeatureCurve& curve : face.annotation.curves) {
    if (curve.view != faces::View::kFrontal) continue;
    for (const int vertex : curve.vertices) {
      left = std::min(left, pixels(vertex, 0)), right = std::max(right, pixels(vertex, 0));
      top = std::min(top, pixels(vertex, 1)), bottom = std::max(bottom, pixels(vertex, 1));
    }
  }
  EXPECT_NEAR(bottom - top, 0.62 * 256, 1e-9);
  EXPECT_NEAR((top + bottom) / 2, 128, 1e-9);
  EXPECT_NEAR((left + right) / 2, 128, 1e-9);
}

TEST_F(BuildSketchesTest, StrokesAreTheProjectedCurves) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  const SketchDatabase sketches(*folder_ / "sketches");
  ASSERT_EQ(sketches.num_faces(), faces.num_faces());
  const render::Camera camera = SketchCamera(faces.face_template(), SketchesOptions().curve_height);
  for (const int face : {0, 5, faces.num_faces() - 1}) {
    const geometry::Points pixels = render::Project(camera, faces.points(face));
    const auto strokes = sketches.strokes(face);
    size_t k = 0;
    for (const faces::FeatureCurve& curve : faces.face_template().annotation.curves) {
      if (curve.view != faces::View::kFrontal) continue;
      ASSERT_LT(k, strokes.size());
      EXPECT_EQ(faces::CurveKinds()[strokes[k].kind], curve.kind);
      ASSERT_EQ(strokes[k].points.size(), curve.vertices.size() + (curve.closed ? 1 : 0)) << curve.name;
      for (size_t p = 0; p < curve.vertices.size(); ++p) {
        EXPECT_NEAR(strokes[k].points[p][0], pixels(curve.vertices[p], 0), 1e-4);
        EXPECT_NEAR(strokes[k].points[p][1], pixels(curve.vertices[p], 1), 1e-4);
      }
      if (curve.closed) {
        EXPECT_EQ(strokes[k].points.back(), strokes[k].points.front());
      }
      ++k;
    }
    EXPECT_EQ(k, strokes.size());
  }
}

TEST_F(BuildSketchesTest, EveryFaceFitsTheCanvas) {
  const SketchDatabase sketches(*folder_ / "sketches");
  for (int face = 0; face < sketches.num_faces(); ++face) {
    for (const float coordinate : sketches.curve_points(face)) {
      EXPECT_GT(coordinate, 0.0f);
      EXPECT_LT(coordinate, 256.0f);
    }
  }
}

TEST_F(BuildSketchesTest, ManifestNamesItsFacesAndTheirLicencesAndNoPath) {
  const Manifest manifest = ReadManifest(*folder_ / "sketches", "sketches");
  EXPECT_EQ(manifest.details.at("faces_data_hash"), DataHash(*folder_ / "faces"));
  EXPECT_EQ(manifest.sources, ReadManifest(*folder_ / "faces", "faces").sources);
  EXPECT_EQ(manifest.details.at("camera").at("width"), 256);
  EXPECT_FALSE(manifest.config.contains("faces"));
  EXPECT_EQ(ReadFile(*folder_ / "sketches/manifest.json").find(folder_->path().string()), std::string::npos);
}

TEST_F(BuildSketchesTest, AnInterruptedBuildEndsWithTheSameBytes) {
  SetInterrupted(true);
  ExpectError([&] { testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "stopped"); }, "stopped after");
  SetInterrupted(false);
  testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "stopped");
  EXPECT_EQ(DataHash(*folder_ / "stopped"), DataHash(*folder_ / "sketches"));
}

TEST_F(BuildSketchesTest, ATemplateWithoutCurvesIsRefused) {
  faces::FaceTemplate face = testing::SyntheticFace();
  face.annotation.curves.clear();
  ExpectError([&] { SketchCamera(face, 0.6); }, "no frontal curve");
  face = testing::SyntheticFace();
  face.annotation.curves[0].kind = "moustache";
  ExpectError([&] { SketchCamera(face, 0.6); }, "unknown kind 'moustache'");
}

TEST(SketchesConfig, EveryFileIsParsed) {
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs/sketches")) {
    EXPECT_NO_THROW(ParseOptions<SketchesOptions>(LoadConfig(entry.path()), entry.path().string())) << entry.path();
  }
}

}  // namespace
}  // namespace daumier::datasets
