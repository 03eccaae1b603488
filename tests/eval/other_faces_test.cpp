#include "eval/other_faces.h"

#include "eval/baselines.h"
#include "eval/metrics.h"
#include "eval/sketch_run_data.h"
#include "fitting/sketch_predictor.h"
#include "tests/eval/sketch_run_fixture.h"
#include "tests/support/expect_error.h"

namespace daumier::eval {
namespace {

class OtherFacesTest : public SketchRunFixture {
 protected:
  OtherFacesOptions Options() const {
    return {.faces = (*folder_ / "faces").string(), .sketches = (*folder_ / "sketches").string()};
  }
};

TEST_F(OtherFacesTest, OfTheOwnTopologyErrorsAreThoseOfThePredictor) {
  const Json metrics = EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "other", Options());
  EXPECT_TRUE(metrics.at("same_topology"));
  ASSERT_EQ(metrics.at("table").size(), 8u);
  const faces::FaceDatabase faces(*folder_ / "faces");
  const datasets::SketchDatabase sketches(*folder_ / "sketches");
  fitting::SketchPredictor predictor(*folder_ / "run");
  std::vector<double> errors;
  for (int face = 0; face < faces.num_faces(); ++face) {
    errors.push_back(MeanVertexError(predictor.Predict({sketches.strokes(face)})[0].vertices, faces.vertices(face),
                                     faces.face_template().annotation.regions.at("face"),
                                     faces::MillimetresPerCm(faces.face_template())));
  }
  EXPECT_EQ(metrics.at("table")[1].at("name"), "network");
  EXPECT_NEAR(metrics.at("table")[1].at("error").get<double>(), Mean(errors), 1e-3);
  const double limit = metrics.at("table")[5].at("error");
  for (const Json& row : metrics.at("table")) EXPECT_GT(row.at("curve_error_px").get<double>(), 0);
  for (int row = 0; row < 3; ++row) EXPECT_GE(metrics.at("table")[size_t(row)].at("error").get<double>(), limit);
  VerifyChecksums(*folder_ / "other", ReadManifest(*folder_ / "other", "report"));
}

TEST_F(OtherFacesTest, BaselinesAreFittedOnTheTrainingFacesOfTheRun) {
  const Json table = EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "other", Options()).at("table");
  const SketchRunData own = OpenSketchRunData(*folder_ / "run");
  const SketchSamples samples{[&](int face) { return own.faces.vertices(face); },
                              [&](int face) { return own.sketches.curve_points(face); }};
  const auto& region = own.faces.face_template().annotation.regions.at("face");
  const NearestNeighbour nearest(samples, own.split.train);
  const RidgeRegression ridge =
      FitRidge(samples, own.split.train, own.split.validation, region, DefaultRidgeLambdas()).model;
  std::vector<double> nearest_errors, ridge_errors;
  for (int face = 0; face < own.faces.num_faces(); ++face) {
    const auto error = [&](std::span<const float> vertices) {
      return MeanVertexError(vertices, samples.vertices(face), region,
                             faces::MillimetresPerCm(own.faces.face_template()));
    };
    const std::vector<float> points = samples.curve_points(face);
    nearest_errors.push_back(error(samples.vertices(nearest.Nearest(points))));
    const FaceRows answer = ridge.Predict(Eigen::Map<const FaceRows>(points.data(), 1, Eigen::Index(points.size())));
    ridge_errors.push_back(error({answer.data(), size_t(answer.size())}));
  }
  EXPECT_EQ(table[6].at("name"), "nearest neighbour");
  EXPECT_NEAR(table[6].at("error").get<double>(), Mean(nearest_errors), 1e-6);
  EXPECT_EQ(table[7].at("name"), "ridge regression");
  EXPECT_NEAR(table[7].at("error").get<double>(), Mean(ridge_errors), 1e-4);
}

TEST_F(OtherFacesTest, BaselinesAreLeftOutWhereTheTrainingFacesAreGoneOrTheSketchesAugmentedOrTheyAreNotWanted) {
  OtherFacesOptions augmented = Options(), unwanted = Options(), moved = Options();
  augmented.strength = 1;
  unwanted.baselines = false;
  testing::BuildSyntheticFaces(*folder_ / "moved_faces");
  testing::BuildSyntheticSketches(*folder_ / "moved_faces", *folder_ / "moved_sketches");
  moved.faces = (*folder_ / "moved_faces").string();
  moved.sketches = (*folder_ / "moved_sketches").string();
  EXPECT_EQ(EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "other", augmented).at("table").size(), 6u);
  EXPECT_EQ(EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "other", unwanted).at("table").size(), 6u);
  std::filesystem::rename(*folder_ / "faces", *folder_ / "gone");
  EXPECT_EQ(EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "other", moved).at("table").size(), 6u);
  std::filesystem::rename(*folder_ / "gone", *folder_ / "faces");
}

TEST_F(OtherFacesTest, RefiningAndDeformingBringTheCurvesNearer) {
  const Json table = EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "nearer", Options()).at("table");
  EXPECT_LT(table[2].at("curve_error_px"), table[1].at("curve_error_px"));
  EXPECT_LT(table[3].at("curve_error_px"), table[2].at("curve_error_px"));
  EXPECT_EQ(table[4].at("name"), "mean face, deformed");
  EXPECT_LT(table[4].at("curve_error_px"), table[0].at("curve_error_px"));
}

TEST_F(OtherFacesTest, RefusesSketchesOfOtherFaces) {
  testing::BuildSyntheticFaces(*folder_ / "others", 2);
  OtherFacesOptions options = Options();
  options.faces = (*folder_ / "others").string();
  testing::ExpectError([&] { EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "none", options); },
                       "sketches of other faces");
  EXPECT_FALSE(std::filesystem::exists(*folder_ / "none"));
}

}  // namespace
}  // namespace daumier::eval
