#include "systems/sketch/train/stroke_prefixes.h"

#include "eval/metrics.h"
#include "systems/sketch/train/evaluation.h"
#include "tests/support/expect_error.h"
#include "tests/support/parser_run_folder.h"
#include "tests/systems/sketch/train/run_fixture.h"

namespace daumier::sketch {
namespace {

/// Two persons: a drawing of three strokes, each measured, and one of eight, of which 1, 2, 3, 4, 6 and 8 are.
std::vector<PrefixErrors> TwoDrawings() {
  return {{.face = 5,
           .person = 1,
           .num_strokes = {1, 2, 3},
           .fitted_mm = {6, 4, 5.5},
           .network_mm = {7, 7, 7},
           .refused = {true, false, false},
           .mean_face_mm = 6},
          {.face = 9,
           .person = 2,
           .num_strokes = {1, 2, 3, 4, 6, 8},
           .fitted_mm = {9, 8, 7, 6, 5, 4},
           .network_mm = {9, 9, 9, 9, 9, 9},
           .refused = {false, false, false, false, false, false},
           .mean_face_mm = 8}};
}

TEST(PrefixErrors, ADrawingStaysAsItIsBeyondItsLastStroke) {
  const PrefixErrors errors = TwoDrawings()[1];
  EXPECT_EQ(errors.at(1), 0U);
  EXPECT_EQ(errors.at(5), 3U) << "4 strokes are the most that were measured of 5";
  EXPECT_EQ(errors.at(8), 5U);
  EXPECT_EQ(errors.at(100), 5U);
  EXPECT_FALSE(errors.has_every_stroke());
  EXPECT_TRUE(TwoDrawings()[0].has_every_stroke());
}

TEST(ReportPrefixes, HasTheMeansWorkedOutByHand) {
  const PrefixReport report = ReportPrefixes(TwoDrawings(), 7);
  const Json& metrics = report.metrics;
  EXPECT_EQ(metrics.at("num_faces"), 2);
  EXPECT_EQ(metrics.at("num_persons"), 2);
  EXPECT_EQ(metrics.at("mean_face_mm"), 7.0);
  const Json& by_number = metrics.at("by_number");
  ASSERT_EQ(by_number.size(), std::size(kPrefixes) + 1);
  EXPECT_EQ(by_number[0].at("strokes"), 1);
  EXPECT_EQ(by_number[0].at("mm"), 7.5);
  EXPECT_EQ(by_number[0].at("network_mm"), 8.0);
  EXPECT_EQ(by_number[0].at("worse_than_mean_face"), 0.5);
  EXPECT_EQ(by_number[0].at("refused"), 0.5);
  EXPECT_EQ(by_number[3].at("mm"), (5.5 + 6) / 2);
  EXPECT_EQ(by_number.back().at("strokes"), "all");
  EXPECT_EQ(by_number.back().at("mm"), (5.5 + 4) / 2);
  EXPECT_EQ(by_number.back().at("worse_than_mean_face"), 0.0);
  EXPECT_EQ(report.table.rows.size(), by_number.size());
}

TEST(ReportPrefixes, TheCostOfAStrokeIsOfDrawingsWithEachPrefix) {
  const Json added = ReportPrefixes(TwoDrawings(), 7).metrics.at("added_stroke");
  EXPECT_EQ(added.at("num_faces"), 1);
  EXPECT_EQ(added.at("num"), 2) << "-2 and 1.5 mm";
  EXPECT_EQ(added.at("mean_mm"), -0.25);
  EXPECT_EQ(added.at("max_mm"), 1.5);
  EXPECT_EQ(added.at("above_1_mm"), 0.5);
  const std::vector<PrefixErrors> other = {TwoDrawings()[1]};
  EXPECT_TRUE(ReportPrefixes(other, 7).metrics.at("added_stroke").is_null());
  testing::ExpectError([] { ReportPrefixes({}, 7); }, "need a face");
}

TEST(ReportPrefixes, DrawsAChart) {
  const PrefixReport report = ReportPrefixes(TwoDrawings(), 7);
  EXPECT_EQ(report.chart.file, "strokes.svg");
  EXPECT_NE(report.chart.svg.find("network and fit"), std::string::npos);
  EXPECT_NE(report.chart.svg.find("mean face"), std::string::npos);
}

class StrokePrefixesTest : public SketchRunFixture {};

TEST_F(StrokePrefixesTest, AnEvaluationHasErrorsByStrokes) {
  testing::WriteParserRun(*folder_ / "parser");
  const SketchEvalOptions options{.parser = (*folder_ / "parser").string(), .baselines = false, .strokes = 3};
  FolderCache databases;
  const reports::Evaluation evaluation = EvaluateSketchRun(*folder_ / "run", options, databases);
  const Json& strokes = evaluation.metrics.at("strokes");
  EXPECT_EQ(strokes.at("num_faces"), 3);
  EXPECT_EQ(strokes.at("by_number").size(), std::size(kPrefixes) + 1);
  EXPECT_EQ(strokes.at("added_stroke").at("num_faces"), 1);
  ASSERT_EQ(evaluation.report.charts.size(), 1U);
  reports::WriteEvaluation(*folder_ / "strokes report", evaluation);
  EXPECT_TRUE(std::filesystem::exists(*folder_ / "strokes report" / "strokes.svg"));
  const reports::Evaluation again = EvaluateSketchRun(*folder_ / "run", options, databases);
  EXPECT_EQ(again.metrics.at("strokes"), strokes);
}

TEST_F(StrokePrefixesTest, MeasuresEvenlySpacedFacesAndTheMeanFace) {
  testing::WriteParserRun(*folder_ / "parser");
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const SketchTestSet test(data, {}, {});
  const auto errors = MeasurePrefixes(test, 2, (*folder_ / "parser").string());
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors[0].face, test.faces()[0]);
  EXPECT_EQ(errors[1].face, test.faces()[test.faces().size() / 2]);
  EXPECT_TRUE(errors[0].has_every_stroke());
  EXPECT_FALSE(errors[1].has_every_stroke());
  const Eigen::RowVectorXf mean = eval::MeanFace([&](int face) { return data.faces.vertices(face); }, data.split.train);
  EXPECT_NEAR(errors[1].mean_face_mm,
              eval::MeanVertexError({mean.data(), size_t(mean.size())}, data.faces.vertices(errors[1].face),
                                    test.region(), faces::MillimetresPerCm(data.faces.face_template())),
              1e-9);
}

}  // namespace
}  // namespace daumier::sketch
