#include "fitting/sketch_predictor.h"

#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/sketch_run_folder.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::fitting {

namespace {

/// Paper with a black square of ink in rows and columns [low, high).
render::Image Drawing(int height, int width, int low, int high) {
  render::Image drawing(height, width, 1, 255);
  for (int row = low; row < high; ++row) {
    for (int column = low; column < high; ++column) drawing.at(row, column) = 0;
  }
  return drawing;
}

TEST(InkOfDrawing, IsOneOnInkAndZeroOnPaper) {
  const auto ink = InkOfDrawing(Drawing(32, 32, 8, 16), 32);
  EXPECT_EQ(ink[8 * 32 + 8], 1.0f);
  EXPECT_EQ(ink[7 * 32 + 8], 0.0f);
  EXPECT_EQ(std::count(ink.begin(), ink.end(), 1.0f), 64);
}

TEST(InkOfDrawing, ANegativeGivesTheSame) {
  render::Image negative = Drawing(32, 32, 8, 16);
  for (uint8_t& value : negative.pixels) value = 255 - value;
  EXPECT_EQ(InkOfDrawing(negative, 16), InkOfDrawing(Drawing(32, 32, 8, 16), 16));
}

TEST(InkOfDrawing, GreyPaperAndInkGiveTheSame) {
  render::Image grey = Drawing(32, 32, 8, 16);
  for (uint8_t& value : grey.pixels) value = value == 0 ? 60 : 200;
  EXPECT_EQ(InkOfDrawing(grey, 32), InkOfDrawing(Drawing(32, 32, 8, 16), 32));
}

TEST(InkOfDrawing, AWidePictureIsPaddedAboveAndBelow) {
  const auto ink = InkOfDrawing(Drawing(16, 32, 4, 8), 32);
  EXPECT_EQ(ink[(8 + 4) * 32 + 4], 1.0f);
  EXPECT_EQ(std::count(ink.begin(), ink.end(), 1.0f), 16);
}

TEST(InkOfDrawing, RefusesAnEmptyPage) {
  testing::ExpectError([] { InkOfDrawing(render::Image(32, 32, 1, 255), 32); }, "shows no lines");
}

TEST(PredictSketches, WritesAMeshAndAPictureOfTheTemplatesTopology) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  render::WriteImage(folder / "drawing.png", Drawing(40, 40, 10, 20));
  PredictSketches(folder / "run", {folder / "drawing.png"}, folder / "out");
  const geometry::PolygonMesh mesh = geometry::ReadObj(folder / "out/drawing.obj");
  const auto run = models::LoadSketchRun(folder / "run");
  EXPECT_EQ(mesh.vertices.rows(), run.face_template.num_vertices());
  EXPECT_EQ(mesh.num_polygons(), run.face_template.triangles.rows());
  EXPECT_GT(render::ReadImage(folder / "out/drawing.png").width, 3 * 300);
}

TEST(PredictSketches, RefusesTwoInputsOfOneNameBeforeItWrites) {
  const testing::TempDir folder;
  testing::WriteSketchRun(folder / "run");
  MakeDirectory(folder / "a");
  MakeDirectory(folder / "b");
  for (const char* name : {"a/x.png", "b/x.png"}) render::WriteImage(folder / name, Drawing(40, 40, 10, 20));
  testing::ExpectError(
      [&] {
        PredictSketches(folder / "run", {folder / "a/x.png", folder / "b/x.png"}, folder / "out");
      },
      "two inputs are named x");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace daumier::fitting
