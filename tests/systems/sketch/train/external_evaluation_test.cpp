#include "systems/sketch/train/external_evaluation.h"

#include "core/safetensors.h"
#include "eval/metrics.h"
#include "eval/nearest_neighbour.h"
#include "eval/ridge_regression.h"
#include "export/torch_runner.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/run_data.h"
#include "tests/support/expect_error.h"
#include "tests/support/parser_run_folder.h"
#include "tests/systems/sketch/train/run_fixture.h"

#include <cmath>
#include <limits>

namespace daumier::sketch {
namespace {

SketchPredictor OpenRun(const std::filesystem::path& run) {
  return {ReadSketchRunFolder(run),
          std::make_shared<exporting::TorchRunner>(exporting::NetworkOf(DescribeSketchExport(run)), torch::kCPU),
          nullptr,
          {.framing = "keep"}};
}

class ExternalEvaluationTest : public SketchRunFixture {
 protected:
  static void SetUpTestSuite() {
    SketchRunFixture::SetUpTestSuite();
    testing::WriteParserRun(*folder_ / "parser");
  }
  static std::string Parser() { return (*folder_ / "parser").string(); }
  SketchEvalOptions Options() const {
    return {.faces = (*folder_ / "faces").string(), .sketches = (*folder_ / "sketches").string(), .parser = Parser()};
  }
  static reports::Evaluation Evaluate(const SketchEvalOptions& options) {
    FolderCache databases;
    return EvaluateSketchRun(*folder_ / "run", options, databases);
  }
  static Json Table(const SketchEvalOptions& options) { return Evaluate(options).metrics.at("table"); }
};

TEST_F(ExternalEvaluationTest, OfTheOwnTopologyErrorsAreThoseOfThePredictor) {
  const Json metrics = Evaluate(Options()).metrics;
  EXPECT_TRUE(metrics.at("same_topology"));
  ASSERT_EQ(metrics.at("table").size(), 8u);
  const faces::FaceDatabase faces(*folder_ / "faces");
  const datasets::SketchDatabase sketches(*folder_ / "sketches");
  const SketchPredictor predictor = OpenRun(*folder_ / "run");
  std::vector<double> errors;
  for (int face = 0; face < faces.num_faces(); ++face) {
    errors.push_back(eval::MeanVertexError(predictor.FromStrokes({sketches.strokes(face)})[0].vertices,
                                           faces.vertices(face), faces.face_template().annotation.regions.at("face"),
                                           faces::MillimetresPerCm(faces.face_template())));
  }
  EXPECT_EQ(metrics.at("table")[1].at("name"), "network");
  EXPECT_NEAR(metrics.at("table")[1].at("error").get<double>(), Mean(errors), 1e-3);
  const double limit = metrics.at("table")[5].at("error");
  for (const Json& row : metrics.at("table")) EXPECT_GT(row.at("curve_error_px").get<double>(), 0);
  for (int row = 0; row < 3; ++row) EXPECT_GE(metrics.at("table")[size_t(row)].at("error").get<double>(), limit);
  EXPECT_EQ(metrics.at("table")[1].at("face_errors_mm").size(), errors.size());
}

TEST_F(ExternalEvaluationTest, BaselinesAreFittedOnTheTrainingFacesOfTheRun) {
  const Json table = Table(Options());
  const SketchRunData own = OpenSketchRunData(*folder_ / "run");
  const eval::SketchSamples samples{[&](int face) { return own.faces.vertices(face); },
                                    [&](int face) { return own.sketches.curve_points(face); }};
  const auto& region = own.faces.face_template().annotation.regions.at("face");
  const eval::NearestNeighbour nearest(eval::ReadRows(samples.curve_points, own.split.train));
  const eval::RidgeRegression ridge =
      eval::FitRidge(samples, own.split.train, own.split.validation, region, eval::DefaultRidgeLambdas()).model;
  std::vector<double> nearest_errors, ridge_errors;
  for (int face = 0; face < own.faces.num_faces(); ++face) {
    const auto error = [&](std::span<const float> vertices) {
      return eval::MeanVertexError(vertices, samples.vertices(face), region,
                                   faces::MillimetresPerCm(own.faces.face_template()));
    };
    const std::vector<float> points = samples.curve_points(face);
    nearest_errors.push_back(error(samples.vertices(own.split.train[size_t(nearest.Nearest(points))])));
    const eval::FaceRows predicted =
        ridge.Predict(Eigen::Map<const eval::FaceRows>(points.data(), 1, Eigen::Index(points.size())));
    ridge_errors.push_back(error({predicted.data(), size_t(predicted.size())}));
  }
  EXPECT_EQ(table[6].at("name"), "nearest neighbour");
  EXPECT_NEAR(table[6].at("error").get<double>(), Mean(nearest_errors), 1e-6);
  EXPECT_EQ(table[7].at("name"), "ridge regression");
  EXPECT_NEAR(table[7].at("error").get<double>(), Mean(ridge_errors), 1e-4);
}

TEST_F(ExternalEvaluationTest,
       BaselinesAreLeftOutWhereTheTrainingFacesAreGoneOrTheSketchesAugmentedOrTheyAreNotWanted) {
  SketchEvalOptions augmented = Options(), unwanted = Options(), moved = Options();
  augmented.strength = 1;
  unwanted.baselines = false;
  testing::BuildSyntheticFaces(*folder_ / "moved_faces");
  testing::BuildSyntheticSketches(*folder_ / "moved_faces", *folder_ / "moved_sketches");
  moved.faces = (*folder_ / "moved_faces").string();
  moved.sketches = (*folder_ / "moved_sketches").string();
  EXPECT_EQ(Table(augmented).size(), 6u);
  EXPECT_EQ(Table(unwanted).size(), 6u);
  std::filesystem::rename(*folder_ / "faces", *folder_ / "gone");
  EXPECT_EQ(Table(moved).size(), 6u);
  std::filesystem::rename(*folder_ / "gone", *folder_ / "faces");
}

TEST_F(ExternalEvaluationTest, RefiningBringsTheCurvesNearerAndFacesAreFitted) {
  const Json table = Table(Options());
  EXPECT_LT(table[2].at("curve_error_px"), table[1].at("curve_error_px"));
  EXPECT_EQ(table[3].at("name"), "network, fitted");
  EXPECT_NE(table[3].at("curve_error_px"), table[2].at("curve_error_px"));
  EXPECT_EQ(table[4].at("name"), "mean face, fitted");
  EXPECT_NE(table[4].at("curve_error_px"), table[0].at("curve_error_px"));
}

/// Rewrites the faces as registered ones: of each, every third vertex has a match, beginning with the person's number.
void MarkAsRegistered(const std::filesystem::path& directory) {
  Manifest manifest = ReadManifest(directory, "faces");
  const int num_persons = manifest.counts.at("persons"), num_vertices = manifest.counts.at("vertices");
  for (int person = 0; person < num_persons; ++person) {
    std::vector<float> distances(size_t(num_vertices), std::numeric_limits<float>::quiet_NaN());
    for (int vertex = person % 3; vertex < num_vertices; vertex += 3) distances[size_t(vertex)] = 0.01f;
    const std::string name = faces::PersonShardName(person);
    const SafetensorsFile shard(directory / name);
    SafetensorsWriter writer;
    for (const auto& [key, array] : shard.arrays())
      writer.AddBytes(key, array.dtype, array.shape, array.data, size_t(array.size()) * ItemSize(array.dtype));
    writer.Add<float>("distances", {num_vertices}, distances);
    manifest.checksums[name] = writer.Write(directory / name);
  }
  WriteManifest(directory, manifest);
}

TEST_F(ExternalEvaluationTest, OfRegisteredFacesAlsoWhereTheMeshIs) {
  testing::BuildSyntheticFaces(*folder_ / "registered", 2);
  MarkAsRegistered(*folder_ / "registered");
  testing::BuildSyntheticSketches(*folder_ / "registered", *folder_ / "registered_sketches");
  const SketchEvalOptions options{.faces = (*folder_ / "registered").string(),
                                  .sketches = (*folder_ / "registered_sketches").string(),
                                  .parser = Parser(),
                                  .baselines = false};
  const reports::Evaluation registered = Evaluate(options);
  const Json& table = registered.metrics.at("table");
  const faces::FaceDatabase faces(*folder_ / "registered");
  const datasets::SketchDatabase sketches(*folder_ / "registered_sketches");
  const SketchPredictor predictor = OpenRun(*folder_ / "run");
  double sum = 0;
  for (int face = 0; face < faces.num_faces(); ++face) {
    const std::vector<float> predicted = predictor.FromStrokes({sketches.strokes(face)})[0].vertices;
    const std::span<const float> truth = faces.vertices(face);
    double of_face = 0;
    int count = 0;
    for (const int vertex : faces.face_template().annotation.regions.at("face")) {
      if (vertex % 3 != faces.id(face).person) continue;
      const size_t x = 3 * size_t(vertex);
      of_face += std::hypot(predicted[x] - truth[x], predicted[x + 1] - truth[x + 1], predicted[x + 2] - truth[x + 2]);
      ++count;
    }
    sum += of_face / count;
  }
  const double expected = sum / faces.num_faces() * faces::MillimetresPerCm(faces.face_template());
  EXPECT_NEAR(table[1].at("matched_error").get<double>(), expected, 1e-3);
  EXPECT_LE(table[1].at("matched_error_low").get<double>(), expected);
  EXPECT_GE(table[1].at("matched_error_high").get<double>(), expected);
  EXPECT_NE(reports::TableMarkdown(reports::TextTable(registered.table)).find("mm where the mesh is"),
            std::string::npos);
  const Json own = Table(Options());
  EXPECT_FALSE(own[1].contains("matched_error"));
}

TEST_F(ExternalEvaluationTest, IsWrittenWithASheetOfFourFacesAndItsTable) {
  SketchEvalOptions options = Options();
  options.baselines = false;
  const reports::Evaluation evaluation = Evaluate(options);
  EXPECT_EQ(reports::FindRow(evaluation.table, "").name, "network");
  reports::WriteEvaluation(*folder_ / "other", evaluation);
  VerifyChecksums(*folder_ / "other", ReadManifest(*folder_ / "other", "report"));
  for (const char* file : {"metrics.json", "table.md", "sheet.png", "index.html"})
    EXPECT_TRUE(std::filesystem::exists(*folder_ / "other" / file)) << file;
}

TEST_F(ExternalEvaluationTest, RefusesSketchesOfOtherFaces) {
  testing::BuildSyntheticFaces(*folder_ / "others", 2);
  SketchEvalOptions options = Options();
  options.faces = (*folder_ / "others").string();
  testing::ExpectError([&] { Evaluate(options).metrics; }, "sketches of other faces");
}

}  // namespace
}  // namespace daumier::sketch
