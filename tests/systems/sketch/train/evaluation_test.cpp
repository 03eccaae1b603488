#include "systems/sketch/train/evaluation.h"

#include "eval/metrics.h"
#include "systems/sketch/train/run_data.h"
#include "tests/systems/sketch/train/run_fixture.h"
#include "tests/support/expect_error.h"

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

using SketchEvalTest = SketchRunFixture;

TEST_F(SketchEvalTest, WritesTheKeysThatAreAgreedOnAndAReport) {
  const fs::path out = *folder_ / "report";
  const Json metrics = EvaluateSketchRun(*folder_ / "run", out);
  EXPECT_EQ(Json::parse(ReadFile(out / "metrics.json")), metrics);
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
  for (const char* file : {"sheet.png", "mean_error.png", "errors.svg", "index.html", "table.md"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  VerifyChecksums(out, ReadManifest(out, "report"));
}

TEST_F(SketchEvalTest, MeasuresBaselinesAsWorkedOutByHand) {
  const Json metrics = EvaluateSketchRun(*folder_ / "run", *folder_ / "validation", {.split = "validation"});
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const auto vertices = [&](int face) { return data.faces.vertices(face); };
  const Eigen::VectorXf mean = eval::MeanFace(vertices, data.split.train);
  std::vector<double> errors;
  for (const int face : data.split.validation) {
    errors.push_back(eval::MeanVertexError({mean.data(), size_t(mean.size())}, data.faces.vertices(face),
                                     data.faces.face_template().annotation.regions.at("face"),
                                     faces::MillimetresPerCm(data.faces.face_template())));
  }
  EXPECT_NEAR(metrics.at("mean_face_baseline_mm").get<double>(), eval::Mean(errors), 1e-9);
  EXPECT_LT(metrics.at("model_limit_mm").get<double>(), metrics.at("mean_face_baseline_mm").get<double>());
}

TEST_F(SketchEvalTest, ShapeInputStandsInEveryRowOfTheTable) {
  const Json metrics = EvaluateSketchRun(*folder_ / "run", *folder_ / "shape");
  std::map<std::string, int> rows;
  for (const Json& row : metrics.at("table")) ++rows[row.at("shape_input").get<std::string>()];
  EXPECT_EQ(rows, (std::map<std::string, int>{{"none", 5}, {"given", 1}, {"predicted", 1}, {"recovered", 1}}));
  const Json& px = metrics.at("shape_error_px");
  EXPECT_LT(px.at("given"), px.at("predicted")) << "an untrained network predicts badly";
  EXPECT_GT(px.at("given"), 0.0);
}

TEST_F(SketchEvalTest, ANetworkThatReadsShapeIsMeasuredWithGivenAndRecoveredNumbers) {
  WriteRun(*folder_ / "shape run", {.trunk = "shape", .hidden = 16, .branch = 16});
  const Json given = EvaluateSketchRun(*folder_ / "shape run", *folder_ / "given");
  EXPECT_EQ(given.at("shape_input"), "given");
  EXPECT_EQ(given.at("table").size(), 6u) << "nothing can be recovered";
  const Json recovered =
      EvaluateSketchRun(*folder_ / "shape run", *folder_ / "recovered", {.recover_with = (*folder_ / "run").string()});
  EXPECT_EQ(recovered.at("shape_input"), "recovered");
  EXPECT_EQ(recovered.at("table").size(), 9u);
  EXPECT_EQ(recovered.at("table")[0].at("shape_input"), "given");
  EXPECT_EQ(recovered.at("table")[0].at("error"), given.at("mean_vertex_error_mm"));
  EXPECT_EQ(recovered.at("table")[1].at("error"), recovered.at("mean_vertex_error_mm"));
  EXPECT_NE(recovered.at("mean_vertex_error_mm"), given.at("mean_vertex_error_mm"));
  testing::ExpectError(
      [&] {
        EvaluateSketchRun(*folder_ / "run", *folder_ / "none", {.recover_with = (*folder_ / "shape run").string()});
      },
      "reads shape-level numbers itself");
}

TEST_F(SketchEvalTest, FitsAndRefinesWhereItIsAskedTo) {
  const Json metrics = EvaluateSketchRun(*folder_ / "run", *folder_ / "fits", {.fit = true, .deform = true});
  std::map<std::string, std::string> input;
  for (const Json& row : metrics.at("table")) input[row.at("name")] = row.at("shape_input");
  EXPECT_EQ(input.at("network, refined"), "none");
  EXPECT_EQ(input.at("network, deformed"), "none");
  EXPECT_EQ(input.at("morphable model fit"), "given");
  EXPECT_EQ(input.at("morphable model fit without prior"), "given");
  EXPECT_EQ(metrics.at("table").size(), 12u);
}

TEST_F(SketchEvalTest, WithoutBaselinesTheNetworkAloneIsMeasured) {
  const Json all = EvaluateSketchRun(*folder_ / "run", *folder_ / "all"),
             alone = EvaluateSketchRun(*folder_ / "run", *folder_ / "alone", {.baselines = false});
  EXPECT_EQ(alone.at("table").size(), 1u);
  EXPECT_TRUE(alone.at("ridge_mm").is_null());
  EXPECT_EQ(alone.at("mean_vertex_error_mm"), all.at("mean_vertex_error_mm"));
}

TEST_F(SketchEvalTest, TellsTheErrorOfEachFaceAndRegion) {
  const Json metrics = EvaluateSketchRun(*folder_ / "run", *folder_ / "each");
  const auto errors = metrics.at("face_errors_mm").get<std::vector<double>>();
  EXPECT_NEAR(eval::Mean(errors), metrics.at("mean_vertex_error_mm").get<double>(), 1e-9);
  EXPECT_EQ(metrics.at("faces").get<std::vector<int>>(), OpenSketchRunData(*folder_ / "run").split.test);
  EXPECT_EQ(metrics.at("groups").size(), errors.size());
  for (const char* region : {"eyes", "mouth", "nose", "elsewhere"})
    EXPECT_GT(metrics.at("regions_mm").at(region).get<double>(), 0) << region;
}

TEST_F(SketchEvalTest, AugmentedSketchesAreOthersAndTheSameEachTime) {
  Json plain = EvaluateSketchRun(*folder_ / "run", *folder_ / "plain");
  Json strong = EvaluateSketchRun(*folder_ / "run", *folder_ / "strong", {.split = "test", .strength = 1.5});
  Json again = EvaluateSketchRun(*folder_ / "run", *folder_ / "again", {.split = "test", .strength = 1.5});
  EXPECT_EQ(strong.at("augmentation_strength"), 1.5);
  EXPECT_NE(strong.at("mean_vertex_error_mm"), plain.at("mean_vertex_error_mm"));
  EXPECT_NE(strong.at("ridge_mm"), plain.at("ridge_mm"));
  EXPECT_EQ(strong.at("mean_face_baseline_mm"), plain.at("mean_face_baseline_mm"));
  strong.erase("seconds"), again.erase("seconds");
  EXPECT_EQ(strong, again);
}

TEST_F(SketchEvalTest, FindsATrainingFaceByItsNearestNeighbour) {
  const Json metrics = EvaluateSketchRun(*folder_ / "run", *folder_ / "train", {.split = "train"});
  EXPECT_EQ(metrics.at("nearest_neighbour_mm"), 0.0);
}

TEST_F(SketchEvalTest, OfEqualRunsIsEqualButForItsSeconds) {
  Json first = EvaluateSketchRun(*folder_ / "run", *folder_ / "a");
  Json second = EvaluateSketchRun(*folder_ / "run", *folder_ / "b");
  first.erase("seconds");
  second.erase("seconds");
  EXPECT_EQ(first, second);
  EXPECT_EQ(Sha256OfFile(*folder_ / "a" / "sheet.png"), Sha256OfFile(*folder_ / "b" / "sheet.png"));
}

TEST_F(SketchEvalTest, ManifestProvesThatNothingWasFittedOnValidationOrTestPersons) {
  const Manifest manifest = ReadManifest(*folder_ / "run", "run");
  const Json &split = manifest.details.at("split"), &fitted = manifest.details.at("bilinear");
  EXPECT_EQ(fitted.at("faces_checksum"), split.at("train").at("faces_checksum"));
  for (const Json& person : fitted.at("persons"))
    for (const char* side : {"validation", "test"})
      for (const Json& held_out : split.at(side).at("persons")) EXPECT_NE(person, held_out);
}

TEST_F(SketchEvalTest, RefusesAnUnknownSideAndLeavesNothing) {
  testing::ExpectError([&] { EvaluateSketchRun(*folder_ / "run", *folder_ / "none", {.split = "tset"}); },
                       "no side of a split");
  EXPECT_FALSE(fs::exists(*folder_ / "none"));
}

}  // namespace
}  // namespace daumier::sketch
