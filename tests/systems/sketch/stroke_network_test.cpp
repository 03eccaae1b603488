#include "systems/sketch/stroke_network.h"

#include "fitting/curve_recovery.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <thread>

namespace daumier::sketch {
namespace {

using fitting::Circles;
using Shape = std::vector<int64_t>;

std::vector<float> Numbers(const Eigen::VectorXf& vector) {
  return {vector.begin(), vector.end()};
}

std::vector<float> Row(const FloatArray& array, int64_t row) {
  return {array.row(row), array.row(row) + array.row_size()};
}

/// Two sketches, of which the second has one circle less.
std::vector<std::vector<render::Stroke>> TwoSketches() {
  std::vector<std::vector<render::Stroke>> sketches{Circles(), Circles()};
  sketches[1].pop_back();
  return sketches;
}

/// A run with these network options, and a stroke network with a fixed one whose rows differ.
struct OpenedRun {
  explicit OpenedRun(const SketchNetworkOptions& options) {
    testing::WritePlainSketchRun(folder.path(), options);
    run = ReadSketchRunFolder(folder.path());
    fixed = std::make_shared<testing::FixedNetwork>(run.models.bilinear, 0.1f);
  }

  StrokeNetwork network() const { return {run, fixed}; }

  testing::TempDir folder;
  SketchRunFolder run;
  std::shared_ptr<testing::FixedNetwork> fixed;
};

TEST(InkOf, IsOneMinusTheGreyOfTheRaster) {
  const std::vector<float> ink = InkOf(Circles(), 64);
  const render::Image raster = render::RasteriseStrokes(Circles(), 64);
  ASSERT_EQ(ink.size(), 64u * 64u);
  for (size_t i = 0; i < ink.size(); ++i) EXPECT_NEAR(ink[i], 1 - raster.pixels[i] / 255.0, 1e-6);
}

TEST(StrokeNetwork, AnImageNetworkReadsOneRasterASketch) {
  const OpenedRun opened({.resolution = 32});
  opened.network().Predict(TwoSketches());
  const auto inputs = opened.fixed->inputs();
  ASSERT_EQ(inputs.size(), 1u);
  ASSERT_EQ(inputs[0].size(), 1u);
  const FloatArray& sketch = inputs[0].at("sketch");
  EXPECT_EQ(sketch.shape, (Shape{2, 1, 32, 32}));
  for (int64_t i = 0; i < 2; ++i) EXPECT_EQ(Row(sketch, i), InkOf(TwoSketches()[size_t(i)], 32));
}

TEST(StrokeNetwork, EachSketchHasTheFaceOfItsRow) {
  const OpenedRun opened({.resolution = 32});
  const auto faces = opened.network().Predict(TwoSketches());
  ASSERT_EQ(faces.size(), 2u);
  for (const int64_t row : {0, 1}) {
    const fitting::PredictedFace& face = faces[size_t(row)];
    EXPECT_EQ(face.u, opened.fixed->u(row));
    EXPECT_EQ(face.v, opened.fixed->v());
    EXPECT_EQ(face.vertices, Numbers(opened.fixed->vertices(row)));
  }
  EXPECT_NE(faces[0].vertices, faces[1].vertices);
}

TEST(StrokeNetwork, NoSketchesAreNoFacesAndNoCall) {
  const OpenedRun opened({.resolution = 32});
  EXPECT_TRUE(opened.network().Predict({}).empty());
  EXPECT_TRUE(opened.fixed->inputs().empty());
}

TEST(StrokeNetwork, APointNetworkReadsFourNumbersAPoint) {
  const OpenedRun opened({.trunk = "points", .num_points = 20});
  opened.network().Predict(TwoSketches());
  const auto inputs = opened.fixed->inputs();
  ASSERT_EQ(inputs.size(), 1u);
  ASSERT_EQ(inputs[0].size(), 1u);
  EXPECT_EQ(inputs[0].at("points").shape, (Shape{2, 4, 20}));
}

TEST(StrokeNetwork, APointNetworkRefusesASketchWithoutLength) {
  const OpenedRun opened({.trunk = "points", .num_points = 20});
  testing::ExpectError([&] { opened.network().Predict({{{0, {{5, 5}}}}}); }, "there is no stroke to sample points on");
}

TEST(StrokeNetwork, AShapeNetworkReadsTheMeanFaceAndThenRecoveredCurvesTwice) {
  const OpenedRun opened({.trunk = "shape"});
  const StrokeNetwork network = opened.network();
  network.Predict(TwoSketches());
  const auto inputs = opened.fixed->inputs();
  ASSERT_EQ(inputs.size(), 3u);
  const faces::CoefficientPrior prior = faces::PriorOf(opened.run.models.curves);
  std::vector<float> mean = Numbers(prior.u_mean);
  mean.insert(mean.end(), prior.v_mean.begin(), prior.v_mean.end());
  const faces::CurveEncoder encoder(opened.run.models.curves);
  for (const int64_t row : {0, 1}) {
    EXPECT_EQ(inputs[0].at("shape").shape, (Shape{2, 9}));
    EXPECT_EQ(Row(inputs[0].at("shape"), row), mean);
    const auto projected = fitting::Project(network.curves(), Numbers(opened.fixed->vertices(row)));
    const auto recovered =
        fitting::RecoverCurves(encoder, network.curves().offsets, projected, TwoSketches()[size_t(row)]);
    for (const size_t call : {1u, 2u})
      EXPECT_EQ(Row(inputs[call].at("shape"), row), Numbers(recovered.numbers())) << call;
  }
}

TEST(StrokeNetwork, AnImageNetworkWithShapeInputReadsBoth) {
  const OpenedRun opened({.shape_input = "late", .resolution = 32});
  opened.network().Predict({Circles()});
  const auto inputs = opened.fixed->inputs();
  ASSERT_EQ(inputs.size(), 3u);
  for (const NamedArrays& input : inputs) {
    EXPECT_EQ(input.at("sketch").shape, (Shape{1, 1, 32, 32}));
    EXPECT_EQ(input.at("shape").shape, (Shape{1, 9}));
  }
}

TEST(StrokeNetwork, CurvesOfAFaceAreItsFeatureCurvesInTheCameraOfTheSketches) {
  const OpenedRun opened({.resolution = 32});
  const StrokeNetwork network = opened.network();
  const fitting::PredictedFace face = network.Predict({Circles()}).front();
  const auto curves = network.CurvesOf(face);
  ASSERT_EQ(curves.size(), 1u);
  ASSERT_EQ(curves[0].points.size(), size_t(network.curves().num_points()));
  const render::Camera camera = testing::PlainSketchCamera();
  const size_t first = 3 * size_t(network.curves().vertices[0]);
  EXPECT_NEAR(curves[0].points[0][0], 128 + camera.scale * face.vertices[first], 1e-3);
  EXPECT_NEAR(curves[0].points[0][1], 128 - camera.scale * face.vertices[first + 1], 1e-3);
}

TEST(StrokeNetwork, AFeatureCurveThatTheTemplateLacksIsRefused) {
  OpenedRun opened({.resolution = 32});
  opened.run.feature_curves = {"moustache"};
  testing::ExpectError([&] { opened.network(); }, "no curve 'moustache'");
}

TEST(StrokeNetwork, PredictsInSeveralThreadsAsInOne) {
  const OpenedRun opened({.shape_input = "late", .resolution = 32});
  const StrokeNetwork network = opened.network();
  const auto expected = network.Predict(TwoSketches());
  std::vector<std::vector<fitting::PredictedFace>> found(4);
  std::vector<std::jthread> threads;
  for (auto& faces : found) threads.emplace_back([&] { faces = network.Predict(TwoSketches()); });
  for (std::jthread& thread : threads) thread.join();
  for (const auto& faces : found) {
    ASSERT_EQ(faces.size(), expected.size());
    for (size_t i = 0; i < faces.size(); ++i) EXPECT_EQ(faces[i].vertices, expected[i].vertices);
  }
}

}  // namespace
}  // namespace daumier::sketch
