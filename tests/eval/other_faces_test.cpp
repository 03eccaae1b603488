#include "eval/other_faces.h"

#include "eval/metrics.h"
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
  ASSERT_EQ(metrics.at("table").size(), 4u);
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
  const double limit = metrics.at("table")[3].at("error");
  for (const Json& row : metrics.at("table")) {
    EXPECT_GE(row.at("error").get<double>(), limit);
    EXPECT_GT(row.at("curve_error_px").get<double>(), 0);
  }
  VerifyChecksums(*folder_ / "other", ReadManifest(*folder_ / "other", "report"));
}

TEST_F(OtherFacesTest, RefiningBringsTheCurvesNearer) {
  const Json table = EvaluateOnOtherFaces(*folder_ / "run", *folder_ / "nearer", Options()).at("table");
  EXPECT_LT(table[2].at("curve_error_px"), table[1].at("curve_error_px"));
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
