#include "systems/sketch/predictor.h"

#include "fitting/stroke_distance.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_parser_network.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
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

  static std::shared_ptr<const DrawingParser> Parser(
      std::shared_ptr<const runtime::NetworkRunner> network =
          std::make_shared<testing::IdealParserNetwork>(ParserNetworkOptions()),
      const DrawingParserOptions& options = {}) {
    return std::make_shared<const DrawingParser>(ParserNetworkOptions(), std::move(network), options);
  }
  SketchPredictor Open(const PredictOptions& options) const {
    return {run_, fixed_, options.framing == "keep" ? nullptr : Parser(), options};
  }
  /// The drawing's frame is the canvas.
  static PredictOptions Keep() { return {.framing = "keep", .refine = false}; }
  /// The network's face alone, in the frame of the parsed drawing.
  static PredictOptions NoFit() { return {.fit = false}; }
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
  EXPECT_EQ(result.record["frame"]["scale"], 1.0);
  EXPECT_FALSE(result.record.contains("states"));
  EXPECT_FALSE(result.record.contains("fit"));
}

TEST_F(SketchPredictorTest, OfSeveralInputsTheOneThatFailsIsNamedByItsPosition) {
  std::vector<systems::Input> inputs = OneInput();
  inputs.emplace_back(geometry::PolygonMesh{});
  const SketchPredictor predictor = Open(Keep());
  ExpectError([&] { predictor.Predict(inputs); }, "input 2 of 2: a mesh is no input of this run");
  ExpectError([&] { predictor.Predict(std::span(inputs).subspan(1)); }, "a mesh is no input of this run");
}

TEST_F(SketchPredictorTest, EveryInputHasAFaceWithTemplateCurvesAndLandmarks) {
  std::vector<systems::Input> inputs = OneInput();
  inputs.emplace_back(render::RasteriseStrokes(Circles(), 256));
  const auto results = Open({}).Predict(inputs);
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
    EXPECT_EQ(result.record["frame"]["turn_degrees"], result.frame->turn_degrees);
    EXPECT_EQ(result.record["states"],
              (Json{{"mouth", "closed"}, {"eye_right", "open"}, {"eye_left", "open"}, {"view", "front"}}));
    for (const char* const key : {"points_rms_share", "residual_scale", "yaw_degrees", "pitch_degrees",
                                  "flipped_triangles", "crossed_lips", "crossed_lids"})
      EXPECT_TRUE(result.record["fit"][key].is_number()) << key;
  }
}

TEST_F(SketchPredictorTest, WithoutAFitTheFaceIsTheNetworksInTheFrameOfThePoints) {
  const systems::FaceResult result = Open(NoFit()).Predict(OneInput()).front();
  EXPECT_EQ(result.identity, fixed_->u());
  const Eigen::VectorXf vertices = fixed_->vertices();
  for (Eigen::Index i = 0; i < result.vertices.rows(); ++i)
    EXPECT_EQ(result.vertices.row(i), vertices.segment<3>(3 * i).transpose().cast<double>());
  EXPECT_FALSE(result.record.contains("fit"));
  EXPECT_EQ(result.record["states"]["mouth"], "closed");
  const DrawingFitter fitter(run_, Parser());
  const render::Placement frame = fitter.FrameOf(fitter.Parse(Circles()));
  EXPECT_NEAR(result.frame->scale, frame.scale, 1e-3);
  EXPECT_NEAR(result.frame->turn_degrees, frame.turn_degrees, 0.1);
}

TEST_F(SketchPredictorTest, AFittedFaceIsNotTheNetworksAndKeepsItsCoefficients) {
  const systems::FaceResult fitted = Open({}).Predict(OneInput()).front(),
                            plain = Open(NoFit()).Predict(OneInput()).front();
  EXPECT_GT((fitted.vertices - plain.vertices).rowwise().norm().maxCoeff(), 0.01);
  EXPECT_EQ(fitted.identity, plain.identity);
  EXPECT_EQ(fitted.expression, plain.expression);
}

/// IdealParserNetwork with other scores of states or labels.
class OtherParserNetwork : public testing::IdealParserNetwork {
 public:
  using Change = std::function<void(NamedArrays& outputs)>;
  explicit OtherParserNetwork(Change change) : IdealParserNetwork(ParserNetworkOptions()), change_(std::move(change)) {}

  NamedArrays Run(const NamedArrays& inputs) const override {
    NamedArrays outputs = IdealParserNetwork::Run(inputs);
    change_(outputs);
    return outputs;
  }

 private:
  Change change_;
};

/// Views of the sheet and of its mirror image.
OtherParserNetwork::Change SeesView(faces::DrawnView view, faces::DrawnView of_mirrored) {
  return [=](NamedArrays& outputs) {
    FloatArray& states = outputs.at("states");
    for (int64_t row = 0; row < states.shape[0]; ++row) {
      std::fill_n(states.row(row) + 7, faces::kNumDrawnViews, 0.0f);
      states.row(row)[7 + int(row == 0 ? view : of_mirrored)] = 9;
    }
  };
}

/// The heat maps of points in another order: points that belong to no face.
void ShufflePoints(NamedArrays& outputs) {
  FloatArray& maps = outputs.at("heat_maps");
  const int64_t size = maps.shape[2] * maps.shape[3];
  for (int64_t row = 0; row < maps.shape[0]; ++row) {
    const std::vector<float> before(maps.row(row), maps.row(row) + maps.row_size());
    for (int64_t point = 0; point < faces::kNumFacePoints; ++point)
      std::copy_n(before.begin() + (7 * point + 3) % faces::kNumFacePoints * size, size, maps.row(row) + point * size);
  }
}

TEST_F(SketchPredictorTest, ADrawingThatDiffersFromAnyFaceIsWarnedOfWithTheFigure) {
  const systems::FaceResult face = Open({}).Predict(OneInput()).front();
  EXPECT_LT(face.record["fit"]["residual_scale"].get<double>(), 3);
  EXPECT_EQ(face.warnings, std::vector<std::string>{});
  const auto shuffled = Parser(std::make_shared<OtherParserNetwork>(ShufflePoints), {.mirror = false});
  const systems::FaceResult wild = SketchPredictor(run_, fixed_, shuffled).Predict(OneInput()).front();
  EXPECT_GT(wild.record["fit"]["residual_scale"].get<double>(), 3);
  EXPECT_EQ(std::ranges::count_if(
                wild.warnings,
                [](const std::string& warning) { return warning.starts_with("the drawing differs from any face: "); }),
            1);
}

TEST_F(SketchPredictorTest, AProfileIsRefusedInWords) {
  const auto profile =
      Parser(std::make_shared<OtherParserNetwork>(SeesView(faces::DrawnView::kProfile, faces::DrawnView::kProfile)));
  ExpectError([&] { SketchPredictor(run_, fixed_, profile).Predict(OneInput()); },
              "the drawing shows a face from the side (probability 1.00)");
  EXPECT_TRUE(fixed_->inputs().empty());
}

TEST_F(SketchPredictorTest, ATurnedFaceIsWrittenUprightAndItsTurnRecorded) {
  using enum faces::DrawnView;
  const auto turned = Parser(std::make_shared<OtherParserNetwork>(SeesView(kThreeQuarterLeft, kThreeQuarterRight)));
  const systems::FaceResult result = SketchPredictor(run_, fixed_, turned).Predict(OneInput()).front();
  EXPECT_EQ(result.record["states"]["view"], "three-quarter-left");
  EXPECT_NE(result.record["fit"]["yaw_degrees"], 0.0);
  const DrawingFitter fitter(run_, turned);
  const Eigen::VectorXf network = fixed_->vertices();
  const std::vector<float> upright = fitter.FittedTo(Circles(), {network.data(), size_t(network.size())}).vertices;
  for (Eigen::Index i = 0; i < result.vertices.rows(); ++i)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(result.vertices(i, axis), upright[size_t(3 * i + axis)], 0.05);
}

TEST_F(SketchPredictorTest, TheNetworkReadsTheLinesOfTheFaceOrAllIfThereAreNone) {
  // Hair where the label map's column is at least `from`.
  const auto hair_from = [](int64_t from) {
    return [from](NamedArrays& outputs) {
      FloatArray& labels = outputs.at("labels");
      const int64_t side = labels.shape[3];
      for (int64_t row = 0; row < labels.shape[0]; ++row)
        for (int64_t cell = 0; cell < side * side; ++cell)
          if (cell % side >= from) labels.row(row)[int64_t(faces::LineLabel::kHair) * side * side + cell] = 99;
    };
  };
  const auto ink = [&](int64_t from) {
    const auto network = std::make_shared<testing::FixedNetwork>(run_.models.bilinear);
    SketchPredictor(run_, network, Parser(std::make_shared<OtherParserNetwork>(hair_from(from)), {.mirror = false}),
                    NoFit())
        .Predict(OneInput());
    const NamedArrays input = network->inputs().at(0);
    double sum = 0;
    for (const float value : input.at("sketch").values) sum += value;
    return sum;
  };
  const double all = ink(128), half = ink(64), none = ink(0);
  EXPECT_NEAR(half, 0.5 * all, 0.1 * all);
  EXPECT_NEAR(none, all, 1e-3 * all);
}

TEST_F(SketchPredictorTest, FramingNeedsAParserAndTheNormalDistributionOfFaces) {
  ExpectError([&] { SketchPredictor(run_, fixed_, nullptr); }, "a drawing is framed by a parser of drawings");
  SketchRunFolder earlier = run_;
  earlier.models.gaussian = {};
  ExpectError([&] { SketchPredictor(earlier, fixed_, Parser()); }, "the run has no gaussian.safetensors");
  EXPECT_NO_THROW(SketchPredictor(earlier, fixed_, nullptr, Keep()));
}

TEST_F(SketchPredictorTest, NoInputsAreNoFaces) {
  EXPECT_TRUE(Open(Keep()).Predict({}).empty());
  EXPECT_TRUE(fixed_->inputs().empty());
}

TEST_F(SketchPredictorTest, AMeshIsRefused) {
  const std::vector<systems::Input> inputs{geometry::PolygonMesh{}};
  ExpectError([&] { Open(Keep()).Predict(inputs); }, "a mesh is no input of this run");
}

TEST_F(SketchPredictorTest, RefinedMovesTheCurvesTowardsTheStrokes) {
  PredictOptions options = Keep();
  options.refine = true;
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
  const SketchPredictor predictor = Open({});
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
  const PredictOptions options = NoFit();
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
  PredictOptions options;
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
    const SketchPredictor predictor(run_, std::make_shared<StoppingNetwork>(run_.models.bilinear, source), Parser());
    std::vector<systems::Input> inputs = OneInput();
    inputs.resize(count, inputs[0]);
    EXPECT_THROW(predictor.Predict(inputs, Task(source.get_token())), Cancelled) << count;
  }
}

TEST_F(SketchPredictorTest, ThousandsOfStrokesAreWrittenAsTheyAreAndPredictedFromFew) {
  std::vector<render::Stroke> strokes;
  for (int i = 0; i < 1000; ++i)
    for (const render::Stroke& stroke : Circles()) strokes.push_back(stroke);
  const auto few = Open(NoFit()).Predict(OneInput());
  const auto many = Open(NoFit()).Predict(std::vector<systems::Input>{render::Drawing{256, 256, strokes}});
  EXPECT_EQ(many[0].drawn.size(), strokes.size());
  EXPECT_NEAR(many[0].frame->scale, few[0].frame->scale, 0.02);
}

}  // namespace
}  // namespace daumier::sketch
