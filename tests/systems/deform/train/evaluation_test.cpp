#include "systems/deform/train/evaluation.h"

#include "core/evenly_spaced.h"
#include "datasets/read/run_data.h"
#include "eval/metrics.h"
#include "systems/deform/metrics.h"
#include "tests/support/expect_error.h"
#include "tests/systems/deform/train/run_fixture.h"

namespace daumier::deform {
namespace {

class DeformEvalTest : public DeformRunFixture {
 protected:
  /// Few faces, few steps.
  static DeformEvalOptions Quick() { return {.max_faces = 3, .adam_faces = 2, .adam_steps = 2}; }
  static reports::Evaluation Evaluate(const char* run, const DeformEvalOptions& options = Quick()) {
    FolderCache databases;
    return EvaluateDeformRun(*folder_ / run, options, databases);
  }
};

TEST_F(DeformEvalTest, HasTheAgreedKeysAndAReport) {
  const reports::Evaluation evaluation = Evaluate("run");
  const Json& metrics = evaluation.metrics;
  for (const char* key : {"mean_vertex_error", "surface_sample_error", "mean_vertex_error_mm", "percent_of_head_height",
                          "p95_vertex_error", "normal_error_degrees", "seconds"})
    EXPECT_GT(metrics.at(key).get<double>(), 0) << key;
  EXPECT_EQ(metrics.at("num_faces"), 3);
  EXPECT_EQ(metrics.at("unit"), "model units");
  EXPECT_EQ(metrics.at("split"), "test");
  EXPECT_NEAR(metrics.at("percent_of_head_height").get<double>(),
              metrics.at("mean_vertex_error").get<double>() / 2.1 * 100, 1e-9);
  EXPECT_LE(metrics.at("interval")[0], metrics.at("mean_vertex_error"));
  EXPECT_NEAR(Mean(metrics.at("face_errors").get<std::vector<double>>()), metrics.at("mean_vertex_error").get<double>(),
              1e-9);
  EXPECT_EQ(metrics.at("groups").size(), 3u);
  std::vector<std::string> names;
  for (const Json& row : metrics.at("table")) names.push_back(row.at("name"));
  EXPECT_EQ(names,
            (std::vector<std::string>{"network", "network, first faces by Gauss-Newton", "network, first faces by Adam",
                                      "template", "mean face", "nearest training face", "linear model"}));
  reports::WriteEvaluation(*folder_ / "report", evaluation);
  EXPECT_EQ(reports::ReadMetrics(*folder_ / "report"), metrics);
  VerifyChecksums(*folder_ / "report", ReadManifest(*folder_ / "report", "report"));
}

TEST_F(DeformEvalTest, ItsMetricsAreReadBackInMm) {
  const reports::Evaluation evaluation = Evaluate("run");
  const reports::MetricTable read = ReadDeformMetrics(evaluation.metrics);
  ASSERT_EQ(read.rows.size(), evaluation.table.rows.size());
  EXPECT_NEAR(read.rows[0].error().mean, evaluation.metrics.at("mean_vertex_error_mm").get<double>(), 1e-9);
  EXPECT_EQ(reports::ValueOf(read, read.rows[0], "model_units"), evaluation.table.rows[0].error().mean);
  EXPECT_EQ(read.faces, evaluation.table.faces);
  for (size_t row = 0; row < read.rows.size(); ++row)
    EXPECT_EQ(read.rows[row].baseline, row > 2) << read.rows[row].name;
  EXPECT_EQ(read.rows[1].face_errors.size(), 2u) << "the first faces alone";
}

TEST_F(DeformEvalTest, KeepsPredictionsOfItsFaces) {
  const reports::Evaluation evaluation = Evaluate("run");
  ASSERT_EQ(evaluation.predictions->faces.size(), 3u);
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(evaluation.predictions->at(evaluation.table.faces[i]).mean_error_mm(),
                evaluation.report.face_errors_mm[i], 1e-3);
  EXPECT_EQ(evaluation.predictions->faces[0].sketch.height, 0);
}

TEST_F(DeformEvalTest, FacesAreSpreadEvenlyOverTheSide) {
  const Json metrics =
      Evaluate("run", {.split = "validation", .max_faces = 3, .adam_faces = 0, .baselines = false}).metrics;
  const faces::FaceDatabase faces(*folder_ / "faces");
  const datasets::Split split = datasets::SplitOfRun(*folder_ / "run", ReadManifest(*folder_ / "run", "run"),
                                                     LoadConfig(*folder_ / "run" / "resolved.toml"), faces);
  EXPECT_EQ(metrics.at("faces").get<std::vector<int>>(), EvenlySpaced(split.validation, 3));
  EXPECT_EQ(metrics.at("table").size(), 1u);
  EXPECT_TRUE(metrics.at("ridge").is_null());
}

TEST_F(DeformEvalTest, EqualRunsGiveEqualErrors) {
  const auto errors = [&] {
    return Evaluate("run", {.max_faces = 2, .adam_faces = 0, .baselines = false}).metrics.at("face_errors");
  };
  EXPECT_EQ(errors(), errors());
}

TEST_F(DeformEvalTest, OtherFacesAreAllMeasuredAndNamed) {
  testing::BuildSyntheticFaces(*folder_ / "two", 1);
  DeformEvalOptions options{.faces = (*folder_ / "two").string(), .max_faces = 1, .adam_faces = 0, .baselines = false};
  const reports::Evaluation evaluation = Evaluate("run", options);
  const Json& metrics = evaluation.metrics;
  EXPECT_EQ(metrics.at("num_faces"), faces::FaceDatabase(*folder_ / "two").num_faces());
  EXPECT_TRUE(metrics.at("split").is_null());
  EXPECT_EQ(metrics.at("data_hash").at("other_faces"), DataHash(*folder_ / "two"));
  EXPECT_NE(evaluation.report.title.find("on other faces"), std::string::npos);
}

TEST_F(DeformEvalTest, RefusesARunOfAnotherProduct) {
  WriteRun(*folder_ / "sketch");
  Manifest manifest = ReadManifest(*folder_ / "sketch", "run");
  manifest.details.erase("system");
  WriteManifest(*folder_ / "sketch", manifest);
  testing::ExpectError([&] { Evaluate("sketch"); }, "(expected a run of 'deform')");
}

}  // namespace
}  // namespace daumier::deform
