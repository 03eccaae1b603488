#include "systems/sketch/predictor.h"

#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>
#include <thread>

namespace daumier::sketch {
namespace {

using fitting::Circles;
using testing::ExpectError;

class SketchPredictorTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::WritePlainSketchRun(folder_->path());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  SketchPredictorTest()
      : run_(ReadSketchRunFolder(folder_->path())),
        fixed_(std::make_shared<testing::FixedNetwork>(run_.models.bilinear)) {}

  SketchPredictor Open(const PredictOptions& options) const { return {run_, fixed_, options}; }
  /// The drawing's frame is the canvas.
  static PredictOptions Keep() { return {.framing = "keep", .refine = false}; }
  /// The whole chain, with few frames.
  static PredictOptions WholeChain() {
    PredictOptions options{.deform = true};
    options.search.shares = {1.0, 0.8};
    options.search.places_x = options.search.places_y = options.search.starts = options.search.rounds = 1;
    return options;
  }
  static std::vector<systems::Input> OneInput() { return {render::Drawing{256, 256, Circles()}}; }

  inline static std::unique_ptr<testing::TempDir> folder_;
  const SketchRunFolder run_;
  const std::shared_ptr<const testing::FixedNetwork> fixed_;
};

TEST(SheetPlacement, TheLongerSideIsTheCanvasAndTheShorterOneIsCentred) {
  const render::Placement wide = SheetPlacement({512, 256, {}});
  EXPECT_EQ(wide.scale, 0.5);
  EXPECT_EQ(wide.shift, Eigen::Vector2d(0, 64));
  const render::Placement high = SheetPlacement({64, 128, {}});
  EXPECT_EQ(high.scale, 2);
  EXPECT_EQ(high.shift, Eigen::Vector2d(64, 0));
}

TEST_F(SketchPredictorTest, WithoutFramingAndRefinementTheFaceIsTheNetworks) {
  const auto results = Open(Keep()).Predict(OneInput());
  ASSERT_EQ(results.size(), 1u);
  const systems::FaceResult& result = results[0];
  EXPECT_EQ(result.identity, fixed_->u());
  EXPECT_EQ(result.expression, fixed_->v());
  const Eigen::VectorXf vertices = fixed_->vertices();
  ASSERT_EQ(3 * result.vertices.rows(), vertices.size());
  for (Eigen::Index i = 0; i < result.vertices.rows(); ++i)
    EXPECT_EQ(result.vertices.row(i), vertices.segment<3>(3 * i).transpose().cast<double>());
  EXPECT_EQ(result.drawn.front().points, Circles().front().points);
  ASSERT_TRUE(result.frame.has_value());
  EXPECT_EQ(result.frame->scale, 1);
  const Json& distance = result.record["two_way_distance_px"];
  EXPECT_EQ(distance["before"], distance["after"]);
  EXPECT_EQ(distance["before"], distance["framed"]);
}

TEST_F(SketchPredictorTest, OfSeveralInputsTheOneThatFailsIsNamedByItsPosition) {
  std::vector<systems::Input> inputs = OneInput();
  inputs.emplace_back(geometry::PolygonMesh{});
  const SketchPredictor predictor(run_, fixed_, Keep());
  ExpectError([&] { predictor.Predict(inputs); }, "input 2 of 2: a mesh is no input of a sketch run");
  ExpectError([&] { predictor.Predict(std::span(inputs).subspan(1)); }, "a mesh is no input of a sketch run");
}

TEST_F(SketchPredictorTest, EveryInputHasAFaceWithTemplateCurvesAndLandmarks) {
  std::vector<systems::Input> inputs = OneInput();
  inputs.emplace_back(render::RasteriseStrokes(Circles(), 256));
  const auto results = Open(WholeChain()).Predict(inputs);
  ASSERT_EQ(results.size(), 2u);
  for (const systems::FaceResult& result : results) {
    ASSERT_NE(result.face_template, nullptr);
    EXPECT_EQ(result.vertices.rows(), result.face_template->num_vertices());
    EXPECT_TRUE(result.vertices.allFinite());
    EXPECT_EQ(result.identity.size(), 6);
    EXPECT_EQ(result.expression.size(), 3);
    EXPECT_EQ(result.curves.size(), 1u);
    EXPECT_FALSE(result.drawn.empty());
    ASSERT_EQ(result.landmarks.rows(), 68);
    const int chin = result.face_template->annotation.landmarks[8];
    EXPECT_EQ(result.landmarks.row(8), result.vertices.row(chin));
    EXPECT_EQ(result.record["frame"]["scale"], result.frame->scale);
    for (const char* const distance : {"before", "framed", "after", "after_trimmed"})
      EXPECT_GE(result.record["two_way_distance_px"][distance].get<double>(), 0) << distance;
  }
}

TEST_F(SketchPredictorTest, WarnsOfABadFitWithTheFigure) {
  for (const bool deform : {false, true}) {
    PredictOptions options = Keep();
    options.deform = deform;
    const SketchPredictor predictor = Open(options);
    const std::vector<render::Stroke> curves = predictor.CurvesOf(predictor.FromStrokes({Circles()}).front());
    const std::vector<systems::Input> good{render::Drawing{256, 256, curves}};
    EXPECT_EQ(predictor.Predict(good)[0].warnings, std::vector<std::string>{});
    const auto bad = predictor.Predict(OneInput());
    ASSERT_EQ(bad[0].warnings.size(), 1u) << deform;
    EXPECT_NE(bad[0].warnings[0].find("the predicted face fits the drawing badly: its lines are "), std::string::npos);
    EXPECT_NE(bad[0].warnings[0].find("--keep-frame"), std::string::npos);
    EXPECT_GT(bad[0].record["two_way_distance_px"]["framed"].get<double>(), kBadFitPx);
  }
}

TEST_F(SketchPredictorTest, OfABadFitInAFoundFrameTheFrameIsNotBlamed) {
  PredictOptions options = WholeChain();
  options.deform = false;
  options.refine = false;
  const auto bad = Open(options).Predict(OneInput());
  ASSERT_GT(bad[0].record["two_way_distance_px"]["after"].get<double>(), kBadFitPx);
  ASSERT_EQ(bad[0].warnings.size(), 1u);
  EXPECT_NE(bad[0].warnings[0].find("Is it one frontal face"), std::string::npos);
}

TEST_F(SketchPredictorTest, TheMeanOfEqualFacesOverNearFramesIsThisFace) {
  PredictOptions options = WholeChain();
  options.refine = options.deform = false;
  const auto results = Open(options).Predict(OneInput());
  EXPECT_TRUE(results[0].identity.isApprox(fixed_->u(), 1e-5f));
  EXPECT_TRUE(results[0].expression.isApprox(fixed_->v(), 1e-5f));
  const Eigen::VectorXf vertices = fixed_->vertices();
  for (Eigen::Index i = 0; i < results[0].vertices.rows(); ++i)
    EXPECT_LT((results[0].vertices.row(i) - vertices.segment<3>(3 * i).transpose().cast<double>()).norm(), 1e-4);
}

TEST_F(SketchPredictorTest, NoInputsAreNoFaces) {
  EXPECT_TRUE(Open(Keep()).Predict({}).empty());
  EXPECT_TRUE(fixed_->inputs().empty());
}

TEST_F(SketchPredictorTest, AMeshIsRefused) {
  const std::vector<systems::Input> inputs{geometry::PolygonMesh{}};
  ExpectError([&] { Open(Keep()).Predict(inputs); }, "a mesh is no input of a sketch run");
}

TEST_F(SketchPredictorTest, DeformedNeedsThePredictorToBeOpenedForIt) {
  const SketchPredictor predictor = Open(Keep());
  const fitting::PredictedFace face = predictor.FromStrokes({Circles()}).front();
  ExpectError([&] { predictor.Deformed(face, Circles()); }, "the predictor was opened without deform=true");
}

TEST_F(SketchPredictorTest, DeformedMovesTheCurvesOntoTheStrokesAndKeepsDepths) {
  const SketchPredictor predictor = Open(WholeChain());
  const fitting::PredictedFace face = predictor.FromStrokes({Circles()}).front();
  std::vector<render::Stroke> strokes = predictor.CurvesOf(face);
  for (auto& point : strokes[0].points) point[1] += 4;
  const fitting::PredictedFace deformed = predictor.Deformed(face, strokes);
  const auto distance = [&](const fitting::PredictedFace& of) {
    return fitting::DistanceBetween(predictor.CurvesOf(of), strokes).two_way();
  };
  EXPECT_LT(distance(deformed), 0.5 * distance(face));
  EXPECT_EQ(deformed.u, face.u);
  for (size_t z = 2; z < face.vertices.size(); z += 3) EXPECT_NEAR(deformed.vertices[z], face.vertices[z], 1e-4);
}

TEST_F(SketchPredictorTest, RefinedMovesTheCurvesTowardsTheStrokes) {
  PredictOptions options = Keep();
  options.refinement.placement_rounds = 0;
  const SketchPredictor predictor = Open(options);
  const fitting::PredictedFace face = predictor.FromStrokes({Circles()}).front();
  std::vector<render::Stroke> strokes = predictor.CurvesOf(face);
  for (auto& point : strokes[0].points) point[1] += 4;
  const fitting::PredictedFace refined = predictor.Refined(face, strokes);
  EXPECT_LT(fitting::DistanceBetween(predictor.CurvesOf(refined), strokes).two_way(),
            fitting::DistanceBetween(predictor.CurvesOf(face), strokes).two_way());
}

TEST_F(SketchPredictorTest, TwoThreadsPredictWhatOneDoes) {
  const SketchPredictor predictor = Open(WholeChain());
  const auto expected = predictor.Predict(OneInput());
  std::vector<std::vector<systems::FaceResult>> found(2);
  std::vector<std::jthread> threads;
  for (auto& results : found) threads.emplace_back([&] { results = predictor.Predict(OneInput()); });
  for (std::jthread& thread : threads) thread.join();
  for (const auto& results : found) {
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].vertices, expected[0].vertices);
    EXPECT_EQ(results[0].identity, expected[0].identity);
    EXPECT_EQ(results[0].record, expected[0].record);
  }
}

TEST_F(SketchPredictorTest, ACancelledTaskPredictsNothing) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(Open(Keep()).Predict(OneInput(), Task(source.get_token())), Cancelled);
  EXPECT_TRUE(fixed_->inputs().empty());
}

TEST_F(SketchPredictorTest, ReportsEachDrawing) {
  std::vector<int64_t> done;
  const Task task({}, [&](const TaskProgress& progress) { done.push_back(progress.done); });
  std::vector<systems::Input> inputs = OneInput();
  inputs.push_back(inputs[0]);
  Open(Keep()).Predict(inputs, task);
  EXPECT_EQ(done, (std::vector<int64_t>{1, 2}));
}

/// Faces of circles side by side, the second one the largest.
std::vector<render::Stroke> SideBySide(int count) {
  std::vector<render::Stroke> strokes;
  for (int i = 0; i < count; ++i)
    for (const render::Stroke& stroke : render::MapToCanvas(Circles(), {i == 1 ? 1.2 : 1.0, {600.0 * i, 0}}))
      strokes.push_back(stroke);
  return strokes;
}

TEST_F(SketchPredictorTest, OfTwoFacesTheLargestIsPredictedWithAWarning) {
  PredictOptions options = WholeChain();
  options.deform = false;
  const auto results = Open(options).Predict(std::vector<systems::Input>{render::Drawing{1200, 400, SideBySide(2)}});
  ASSERT_EQ(results.size(), 1u);
  const auto names_the_sheet = [](const systems::FaceResult& result) {
    return std::ranges::count_if(
        result.warnings, [](const std::string& warning) { return warning.find("the sheet holds 2 faces") == 0; });
  };
  EXPECT_EQ(names_the_sheet(results[0]), 1);
  EXPECT_EQ(results[0].drawn.size(), SideBySide(1).size());
  const auto one = Open(options).Predict(std::vector<systems::Input>{render::Drawing{1200, 400, SideBySide(1)}});
  EXPECT_EQ(names_the_sheet(one[0]), 0);
}

TEST_F(SketchPredictorTest, AllFacesOfASheetAreInputsOfTheirOwnIfWished) {
  PredictOptions options = WholeChain();
  const systems::Input sheet = render::Drawing{1800, 400, SideBySide(3)};
  EXPECT_EQ(Open(options).Separate(sheet).size(), 1u);
  options.faces = "all";
  const auto inputs = Open(options).Separate(sheet);
  ASSERT_EQ(inputs.size(), 3u);
  for (const systems::Input& input : inputs)
    EXPECT_EQ(std::get<render::Drawing>(input).strokes.size(), SideBySide(1).size());
  EXPECT_EQ(Open(options).Separate(render::Drawing{256, 256, Circles()}).size(), 1u);
  EXPECT_EQ(Open(options).Separate(geometry::PolygonMesh{}).size(), 1u) << "what it is not refuses Predict";
  options.framing = "keep";
  EXPECT_EQ(Open(options).Separate(sheet).size(), 1u) << "the sheet is the canvas";
}

/// Requests the stop of a task in the middle of a prediction.
class StoppingNetwork : public testing::FixedNetwork {
 public:
  StoppingNetwork(const faces::BilinearModel& model, std::stop_source source)
      : FixedNetwork(model), source_(std::move(source)) {}
  NamedArrays Run(const NamedArrays& input) const override {
    source_.request_stop();
    return FixedNetwork::Run(input);
  }

 private:
  mutable std::stop_source source_;
};

TEST_F(SketchPredictorTest, ACancelledTaskEndsInTheMiddleOfAPrediction) {
  for (const size_t count : {1, 2}) {
    const std::stop_source source;
    const SketchPredictor predictor(run_, std::make_shared<StoppingNetwork>(run_.models.bilinear, source),
                                    WholeChain());
    std::vector<systems::Input> inputs = OneInput();
    inputs.resize(count, inputs[0]);
    EXPECT_THROW(predictor.Predict(inputs, Task(source.get_token())), Cancelled) << count;
  }
}

TEST_F(SketchPredictorTest, ThousandsOfStrokesAreWrittenAsTheyAreAndPredictedFromFew) {
  std::vector<render::Stroke> strokes;
  for (int i = 0; i < 1000; ++i)
    for (const render::Stroke& stroke : Circles()) strokes.push_back(stroke);
  PredictOptions options = WholeChain();
  options.deform = false;
  const auto few = Open(options).Predict(OneInput());
  const auto many = Open(options).Predict(std::vector<systems::Input>{render::Drawing{256, 256, strokes}});
  EXPECT_EQ(many[0].drawn.size(), strokes.size());
  EXPECT_NEAR(many[0].frame->scale, few[0].frame->scale, 0.02);
}

}  // namespace
}  // namespace daumier::sketch
