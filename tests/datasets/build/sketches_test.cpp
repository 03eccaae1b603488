#include "datasets/build/sketches.h"

#include "core/config.h"
#include "core/files.h"
#include "datasets/read/sketch_database.h"
#include "faces/face_database.h"
#include "tests/support/cancelled_task.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST_F(BuildSketchesTest, FirstStrokesAreTheProjectedCurvesInTheExactView) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  const SketchDatabase sketches(*folder_ / "sketches");
  ASSERT_EQ(sketches.num_faces(), faces.num_faces());
  const render::Camera camera =
      SketchCamera(faces.face_template(), faces::View::kFrontal, SketchesOptions().curve_height);
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
    EXPECT_EQ(int(k), sketches.num_curves());
    for (; k < strokes.size(); ++k) EXPECT_EQ(sketches.kinds()[size_t(strokes[k].kind)], "wrinkle");
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
  const auto build = [&](const Task& task) {
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "stopped", task);
  };
  ExpectError([&] { build(testing::CancelledTask()); }, "stopped after");
  build({});
  EXPECT_EQ(DataHash(*folder_ / "stopped"), DataHash(*folder_ / "sketches"));
}

TEST_F(BuildSketchesTest, MoreViewsAddSketchesAndChangeNone) {
  SketchesOptions options;
  options.faces = (*folder_ / "faces").string();
  options.num_views = 2;
  BuildSketches(options, *folder_ / "two");
  options.num_views = 3;
  BuildSketches(options, *folder_ / "three");
  const SketchDatabase one(*folder_ / "sketches"), two(*folder_ / "two"), three(*folder_ / "three");
  EXPECT_EQ(three.num_views(), 3);
  for (const int face : {0, 3}) {
    EXPECT_EQ(one.curve_points(face), three.curve_points(face, 0));
    EXPECT_EQ(two.curve_points(face, 1), three.curve_points(face, 1));
    EXPECT_NE(three.curve_points(face, 1), three.curve_points(face, 2));
    EXPECT_NE(three.curve_points(face, 1), three.curve_points(face, 0));
  }
}

TEST_F(BuildSketchesTest, TurnedViewsComeLastAndChangeNoOther) {
  SketchesOptions options;
  options.faces = (*folder_ / "faces").string();
  options.num_views = 2;
  BuildSketches(options, *folder_ / "straight");
  options.turned = {.count = 2, .least = 30, .greatest = 40};
  BuildSketches(options, *folder_ / "turned");
  const SketchDatabase straight(*folder_ / "straight"), turned(*folder_ / "turned");
  EXPECT_EQ(turned.num_views(), 2);
  EXPECT_EQ(turned.num_turned_views(), 2);
  for (const int face : {0, 4}) {
    EXPECT_EQ(turned.curve_points(face, 1), straight.curve_points(face, 1));
    EXPECT_LT(std::abs(turned.facts(face, 1).yaw), 10);
    for (const int view : {2, 3}) {
      EXPECT_GE(std::abs(turned.facts(face, view).yaw), 29);
      EXPECT_LE(std::abs(turned.facts(face, view).yaw), 41);
    }
  }
  options.view = "side";
  ExpectError([&] { BuildSketches(options, *folder_ / "neither"); }, "frontal sketches alone are turned");
}

TEST_F(BuildSketchesTest, FactsAreProjectedFromTheFace) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  const SketchDatabase sketches(*folder_ / "sketches");
  const auto& landmarks = faces.face_template().annotation.landmarks;
  for (const int face : {0, 5}) {
    const geometry::Points pixels = render::Project(sketches.camera(), faces.points(face));
    const SketchFacts facts = sketches.facts(face);
    for (size_t i = 0; i < landmarks.size(); ++i) {
      EXPECT_NEAR(facts.landmarks[i][0], pixels(landmarks[i], 0), 1e-4);
      EXPECT_NEAR(facts.landmarks[i][1], pixels(landmarks[i], 1), 1e-4);
    }
    EXPECT_EQ(facts.visible.size() * 2, sketches.curve_points(face).size());
  }
}

TEST_F(BuildSketchesTest, TheSideViewHasItsOwnCurves) {
  SketchesOptions options;
  options.faces = (*folder_ / "faces").string();
  options.view = "side";
  BuildSketches(options, *folder_ / "side");
  const SketchDatabase sketches(*folder_ / "side");
  int num_curves = 0;
  const faces::FaceDatabase faces(*folder_ / "faces");
  for (const auto& curve : faces.face_template().annotation.curves) num_curves += curve.view == faces::View::kSide;
  EXPECT_EQ(sketches.num_curves(), num_curves);
}

TEST(SketchesConfig, EveryFileIsParsed) {
  for (const auto& entry : fs::directory_iterator(testing::SourceRoot() / "configs/sketches")) {
    EXPECT_NO_THROW(ParseOptions<SketchesOptions>(LoadConfig(entry.path()), entry.path().string())) << entry.path();
  }
}

}  // namespace
}  // namespace daumier::datasets
