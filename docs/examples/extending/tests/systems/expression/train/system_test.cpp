#include "systems/expression/train/system.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "export/run_export.h"
#include "systems/expression/system.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <memory>

namespace daumier::expression {
namespace {

/// A run of the synthetic faces.
class ExpressionTrainingTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<testing::TempDir>();
    testing::BuildSyntheticFaces(*folder_ / "faces");
    Train(false);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::filesystem::path run() { return *folder_ / "run"; }
  static TrainingSummary Train(bool resume) {
    const Json config =
        ExpressionSystem().resolve_config({{"data", {{"faces", (*folder_ / "faces").string()}}}}, "test");
    FolderCache databases;
    return ExpressionTraining().train(config, {run(), resume, {}}, databases, {});
  }
  static reports::Evaluation Evaluate() {
    FolderCache databases;
    return ExpressionTraining().evaluate(run(), {{"split", "test"}}, databases, {});
  }

 private:
  static inline std::unique_ptr<testing::TempDir> folder_;
};

TEST_F(ExpressionTrainingTest, RecognisesExpressionsOfAPersonThatItHasNotSeen) {
  const reports::Evaluation evaluation = Evaluate();
  EXPECT_LT(evaluation.table.rows[0].error().mean, 0.7);          // 0.5 was measured: 8 faces, 30 epochs.
  EXPECT_DOUBLE_EQ(evaluation.table.rows[1].error().mean, 0.75);  // Always neutral, of 4 expressions.
  reports::WriteEvaluation(ReportDirectory(run()), evaluation);
  const reports::MetricTable read = ExpressionSystem().read_metrics(reports::ReadMetrics(ReportDirectory(run())));
  EXPECT_EQ(read.rows[0].error().mean, evaluation.table.rows[0].error().mean);
}

TEST_F(ExpressionTrainingTest, AFinishedRunResumesToItself) {
  const std::string before = DataHash(run());
  Train(true);
  EXPECT_EQ(DataHash(run()), before);
}

TEST_F(ExpressionTrainingTest, ThePredictorAgreesWithTheNetwork) {
  const auto predictor = ExpressionSystem().open(run(), {}, Json::object());
  const faces::FaceDatabase faces(run().parent_path() / "faces");
  const exporting::RunExport exported = ExpressionTraining().describe_export(run());
  geometry::PolygonMesh mesh;
  mesh.vertices = faces.points(2);
  const std::vector<systems::Input> inputs = {mesh};
  const Json probabilities = predictor->Predict(inputs).front().record.at("probabilities");
  const std::span<const float> vertices = faces.vertices(2);
  const torch::Tensor scores =
      exported.function.forward({torch::tensor(std::vector<float>(vertices.begin(), vertices.end())).unsqueeze(0)})[0];
  EXPECT_NEAR(probabilities.at("smile").get<double>(), scores.softmax(1)[0][2].item<double>(), 1e-5);
  EXPECT_GT(ExpressionTraining().infer_ms(run()), 0);
}

}  // namespace
}  // namespace daumier::expression
