#include "systems/sketch/train/evaluation.h"

#include "core/files.h"
#include "core/manifest.h"
#include "eval/metrics.h"
#include "eval/nearest_neighbour.h"
#include "eval/ridge_regression.h"
#include "render/strokes.h"
#include "systems/sketch/metrics.h"
#include "systems/sketch/train/run_data.h"
#include "tensor/eigen.h"
#include "tensor/torch_version.h"
#include "tests/support/expect_error.h"
#include "tests/support/parser_run_folder.h"
#include "tests/systems/sketch/train/run_fixture.h"

#include <cmath>
#include <map>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

class SketchEvalTest : public SketchRunFixture {
 protected:
  static reports::Evaluation Evaluate(const char* run, const SketchEvalOptions& options = {}) {
    FolderCache databases;
    return EvaluateSketchRun(*folder_ / run, options, databases);
  }
  static Json Metrics(const SketchEvalOptions& options = {}) { return Evaluate("run", options).metrics; }
};

TEST_F(SketchEvalTest, HasTheAgreedKeysAndAReport) {
  const reports::Evaluation evaluation = Evaluate("run");
  const Json& metrics = evaluation.metrics;
  for (const char* key :
       {"mean_vertex_error_mm", "p90_vertex_error_mm", "mean_face_baseline_mm", "nearest_neighbour_mm", "ridge_mm",
        "model_limit_mm", "seconds", "ridge_lambda", "interocular_share"})
    EXPECT_GT(metrics.at(key).get<double>(), 0) << key;
  EXPECT_EQ(metrics.at("num_faces"), 8);  // One person, two levels, four expressions.
  EXPECT_EQ(metrics.at("num_persons"), 1);
  EXPECT_EQ(metrics.at("split"), "test");
  EXPECT_EQ(metrics.at("shape_input"), "none");
  EXPECT_EQ(metrics.at("table").size(), 8u);
  EXPECT_EQ(metrics.at("table")[0].at("error"), metrics.at("mean_vertex_error_mm"));
  reports::WriteEvaluation(*folder_ / "report", evaluation);
  EXPECT_EQ(reports::ReadMetrics(*folder_ / "report"), metrics);
  VerifyChecksums(*folder_ / "report", ReadManifest(*folder_ / "report", "report"));
}

TEST_F(SketchEvalTest, ItsMetricsAreReadBackAsItsTable) {
  const reports::Evaluation evaluation = Evaluate("run");
  const reports::MetricTable read = ReadSketchMetrics(evaluation.metrics);
  EXPECT_EQ(reports::TableJson(read)[1], reports::TableJson(evaluation.table)[1]);
  EXPECT_EQ(read.result, evaluation.table.result);
  EXPECT_EQ(read.faces, evaluation.table.faces);
  EXPECT_EQ(read.data_hash, evaluation.table.data_hash);
  EXPECT_EQ(read.rows[0].details.at("regions_mm"), evaluation.metrics.at("regions_mm"));
}

/// Makes the network of a run predict one face for every sketch: u and v are the first unit vectors, to which the basis
/// has that face.
void PredictOneFace(const fs::path& run, const Eigen::VectorXf& face) {
  SketchNetwork network = LoadSketchRun(run).network;
  const at::NoGradGuard no_grad;
  for (auto& named : network->named_parameters())
    if (named.key().find("_output") != std::string::npos) named.value().zero_();
  auto buffers = network->named_buffers();
  for (const char* mean : {"u_mean", "v_mean"}) {
    buffers[mean].zero_();
    buffers[mean][0] = 1;
  }
  buffers["basis"][0] = tensor::CopyToTensor(face.transpose()).reshape({-1});
  tensor::SaveModule(run / "best" / "model.safetensors", *network);
}

TEST_F(SketchEvalTest, ANetworkThatPredictsTheMeanFaceHasItsErrors) {
  WriteRun(*folder_ / "mean run");
  const SketchRunData data = OpenSketchRunData(*folder_ / "mean run");
  const eval::SketchSamples samples{[&](int face) { return data.faces.vertices(face); },
                                    [&](int face) { return data.sketches.curve_points(face); }};
  PredictOneFace(*folder_ / "mean run", eval::MeanFace(samples.vertices, data.split.train).transpose());
  const reports::Evaluation evaluation = Evaluate("mean run");
  const reports::MetricRow &network = reports::FindRow(evaluation.table, ""),
                           &mean = reports::FindRow(evaluation.table, kMeanFace);
  ASSERT_EQ(network.face_errors.size(), mean.face_errors.size());
  for (size_t face = 0; face < mean.face_errors.size(); ++face)
    EXPECT_NEAR(network.face_errors[face], mean.face_errors[face], 1e-9) << face;
  EXPECT_NEAR(network.error().mean, mean.error().mean, 1e-9);
  EXPECT_NEAR(network.error().interval->low, mean.error().interval->low, 1e-9);
}

TEST_F(SketchEvalTest, ANetworkWithoutFiniteErrorsIsRefusedByItsRow) {
  WriteRun(*folder_ / "nan run");
  const SketchRunData data = OpenSketchRunData(*folder_ / "nan run");
  PredictOneFace(*folder_ / "nan run", Eigen::VectorXf::Constant(data.run.models.bilinear.num_coordinates(), NAN));
  testing::ExpectError([&] { Evaluate("nan run"); }, "row 'network', 'error' of faces");
}

TEST_F(SketchEvalTest, DatabasesAreOpenedOnceForSeveralRuns) {
  WriteRun(*folder_ / "other run");
  FolderCache databases;
  for (const char* run : {"run", "other run", "run"})
    EvaluateSketchRun(*folder_ / run, {.baselines = false}, databases);
  EXPECT_EQ(databases.size(), 2u) << "faces and sketches";
}

TEST_F(SketchEvalTest, KeepsPredictionsOfTheFacesThatSheetsShow) {
  const reports::Evaluation evaluation = Evaluate("run", {.strength = 1, .baselines = false});
  ASSERT_TRUE(evaluation.predictions.has_value());
  const std::vector<double>& errors = evaluation.table.rows[0].face_errors;
  EXPECT_EQ(evaluation.predictions->faces.size(), errors.size()) << "all, of so few";
  for (size_t i = 0; i < errors.size(); ++i) {
    const reports::FacePrediction& face = evaluation.predictions->at(evaluation.table.faces[i]);
    EXPECT_NEAR(face.mean_error_mm(), errors[i], 1e-3);
    EXPECT_EQ(face.sketch.height, render::kSketchCanvas);
  }
  EXPECT_EQ(evaluation.report.samples.size(), 4u);
}

TEST_F(SketchEvalTest, RegionsMakeUpTheFace) {
  FolderCache databases;
  const SketchRunData data = OpenSketchRunData(*folder_ / "run", databases);
  const reports::Evaluation evaluation = Evaluate("run", {.baselines = false});
  const Eigen::VectorXd& map = evaluation.report.mean_error_mm;
  const std::vector<int>& region = data.faces.face_template().annotation.regions.at("face");
  double sum = 0, least = 1e9, most = 0;
  for (const int vertex : region) sum += map[vertex];
  const double error = evaluation.table.rows[0].error().mean;
  EXPECT_NEAR(sum / double(region.size()), error, 1e-9);
  EXPECT_EQ((map.array().isNaN()).count(), map.size() - Eigen::Index(region.size()));
  EXPECT_EQ(evaluation.metrics.at("regions_mm").size(), 4u);
  for (const Json& of_region : evaluation.metrics.at("regions_mm")) {
    least = std::min(least, of_region.get<double>());
    most = std::max(most, of_region.get<double>());
  }
  EXPECT_LE(least, error);
  EXPECT_GE(most, error);
}

TEST_F(SketchEvalTest, StopsIfItsTaskIsCancelled) {
  std::stop_source stop;
  stop.request_stop();
  FolderCache databases;
  EXPECT_THROW(EvaluateSketchRun(*folder_ / "run", {}, databases, Task(stop.get_token())), Cancelled);
}

TEST_F(SketchEvalTest, MeasuresBaselinesAsWorkedOutByHand) {
  const Json metrics = Metrics({.split = "validation"});
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const eval::SketchSamples samples{[&](int face) { return data.faces.vertices(face); },
                                    [&](int face) { return data.sketches.curve_points(face); }};
  const Eigen::VectorXf mean = eval::MeanFace(samples.vertices, data.split.train).transpose();
  std::vector<double> errors;
  for (const int face : data.split.validation) {
    errors.push_back(eval::MeanVertexError({mean.data(), size_t(mean.size())}, data.faces.vertices(face),
                                           data.faces.face_template().annotation.regions.at("face"),
                                           faces::MillimetresPerCm(data.faces.face_template())));
  }
  EXPECT_NEAR(metrics.at("mean_face_baseline_mm").get<double>(), Mean(errors), 1e-9);
  EXPECT_LT(metrics.at("model_limit_mm").get<double>(), metrics.at("mean_face_baseline_mm").get<double>());
}

TEST_F(SketchEvalTest, EveryRowOfTheTableHasAShapeInput) {
  const Json metrics = Metrics();
  std::map<std::string, int> rows;
  for (const Json& row : metrics.at("table")) ++rows[row.at("shape_input").get<std::string>()];
  EXPECT_EQ(rows, (std::map<std::string, int>{{"none", 5}, {"given", 1}, {"predicted", 1}, {"recovered", 1}}));
  const Json& px = metrics.at("shape_error_px");
  EXPECT_LT(px.at("given"), px.at("predicted")) << "an untrained network predicts badly";
  EXPECT_GT(px.at("given"), 0.0);
}

TEST_F(SketchEvalTest, ANetworkThatReadsShapeIsMeasuredWithGivenAndRecoveredNumbers) {
  WriteRun(*folder_ / "shape run", {.trunk = "shape", .hidden = 16, .branch = 16});
  const Json given = Evaluate("shape run").metrics;
  EXPECT_EQ(given.at("shape_input"), "given");
  EXPECT_EQ(given.at("table").size(), 6u) << "nothing can be recovered";
  const Json recovered = Evaluate("shape run", {.recover_with = (*folder_ / "run").string()}).metrics;
  EXPECT_EQ(recovered.at("shape_input"), "recovered");
  EXPECT_EQ(recovered.at("table").size(), 9u);
  EXPECT_EQ(recovered.at("table")[0].at("shape_input"), "given");
  EXPECT_EQ(recovered.at("table")[0].at("error"), given.at("mean_vertex_error_mm"));
  EXPECT_EQ(recovered.at("table")[1].at("error"), recovered.at("mean_vertex_error_mm"));
  EXPECT_NE(recovered.at("mean_vertex_error_mm"), given.at("mean_vertex_error_mm"));
  testing::ExpectError([&] { Evaluate("run", {.recover_with = (*folder_ / "shape run").string()}); },
                       "reads curve coefficients itself");
  Manifest deform;
  deform.kind = "run";
  deform.verb = "train";
  deform.details["system"] = "deform";
  MakeDirectory(*folder_ / "deform");
  WriteManifest(*folder_ / "deform", deform);
  testing::ExpectError([&] { Evaluate("shape run", {.recover_with = (*folder_ / "deform").string()}); },
                       "this is a run of the task 'deform' (expected a run of 'sketch')");
}

TEST_F(SketchEvalTest, FitsAndRefinesIfRequested) {
  testing::WriteParserRun(*folder_ / "parser");
  const Json metrics = Metrics({.parser = (*folder_ / "parser").string(), .fit = true, .refine = true, .deform = true});
  std::map<std::string, std::string> input;
  for (const Json& row : metrics.at("table")) input[row.at("name")] = row.at("shape_input");
  EXPECT_EQ(input.at("network, refined"), "none");
  EXPECT_EQ(input.at("network, fitted"), "none");
  EXPECT_EQ(input.at("morphable model fit"), "given");
  EXPECT_EQ(input.at("morphable model fit without prior"), "given");
  EXPECT_EQ(metrics.at("table").size(), 12u);
}

TEST_F(SketchEvalTest, WithoutBaselinesOnlyTheNetworkIsMeasured) {
  const Json all = Metrics(), alone = Metrics({.baselines = false});
  EXPECT_EQ(alone.at("table").size(), 1u);
  EXPECT_TRUE(alone.at("ridge_mm").is_null());
  EXPECT_EQ(alone.at("mean_vertex_error_mm"), all.at("mean_vertex_error_mm"));
}

TEST_F(SketchEvalTest, HasTheErrorOfEachFaceAndRegion) {
  const Json metrics = Metrics();
  const auto errors = metrics.at("face_errors_mm").get<std::vector<double>>();
  EXPECT_NEAR(Mean(errors), metrics.at("mean_vertex_error_mm").get<double>(), 1e-9);
  EXPECT_EQ(metrics.at("faces").get<std::vector<int>>(), OpenSketchRunData(*folder_ / "run").split.test);
  EXPECT_EQ(metrics.at("groups").size(), errors.size());
  for (const char* region : {"eyes", "mouth", "nose", "elsewhere"})
    EXPECT_GT(metrics.at("regions_mm").at(region).get<double>(), 0) << region;
}

TEST_F(SketchEvalTest, AugmentedSketchesAreOthersAndTheSameEachTime) {
  Json plain = Metrics(), strong = Metrics({.strength = 1.5}), again = Metrics({.strength = 1.5});
  EXPECT_EQ(strong.at("augmentation_strength"), 1.5);
  EXPECT_NE(strong.at("mean_vertex_error_mm"), plain.at("mean_vertex_error_mm"));
  EXPECT_NE(strong.at("ridge_mm"), plain.at("ridge_mm"));
  EXPECT_EQ(strong.at("mean_face_baseline_mm"), plain.at("mean_face_baseline_mm"));
  strong.erase("seconds"), again.erase("seconds");
  EXPECT_EQ(strong, again);
}

TEST_F(SketchEvalTest, StyledSketchesAreOthersAndTheSameEachTime) {
  const SketchEvalOptions styled{.styled = true, .baselines = false};
  const reports::Evaluation evaluation = Evaluate("run", styled);
  const Json plain = Metrics({.baselines = false}), again = Metrics(styled);
  EXPECT_EQ(plain.at("styled"), false);
  EXPECT_EQ(evaluation.metrics.at("styled"), true);
  EXPECT_EQ(evaluation.manifest.config.at("styled"), true);
  EXPECT_NE(evaluation.metrics.at("face_errors_mm"), plain.at("face_errors_mm"));
  EXPECT_EQ(evaluation.metrics.at("face_errors_mm"), again.at("face_errors_mm"));
}

TEST_F(SketchEvalTest, FindsATrainingFaceByItsNearestNeighbour) {
  const Json metrics = Metrics({.split = "train"});
  EXPECT_EQ(metrics.at("nearest_neighbour_mm"), 0.0);
}

TEST_F(SketchEvalTest, ManifestProvesThatNothingWasFittedOnValidationOrTestPersons) {
  const Manifest manifest = ReadManifest(*folder_ / "run", "run");
  const Json &split = manifest.details.at("split"), &fitted = manifest.details.at("bilinear");
  EXPECT_EQ(fitted.at("faces_checksum"), split.at("train").at("faces_checksum"));
  for (const Json& person : fitted.at("persons"))
    for (const char* side : {"validation", "test"})
      for (const Json& held_out : split.at(side).at("persons")) EXPECT_NE(person, held_out);
}

TEST_F(SketchEvalTest, RefusesAnUnknownSideAndOptionsThatExcludeEachOther) {
  testing::ExpectError([&] { Evaluate("run", {.split = "tset"}); }, "unknown subset");
  testing::ExpectError([&] { Evaluate("run", {.faces = "faces"}); }, "give both 'faces' and 'sketches'");
  testing::ExpectError([&] { Evaluate("run", {.faces = "faces", .sketches = "sketches", .fit = true}); },
                       "faces excludes fit");
}

}  // namespace
}  // namespace daumier::sketch
