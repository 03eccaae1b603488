#include "systems/sketch/train/measurement.h"

#include "systems/sketch/train/fits.h"
#include "systems/sketch/train/parser_export.h"
#include "tests/support/parser_run_folder.h"
#include "tests/systems/sketch/train/run_fixture.h"

namespace daumier::sketch {
namespace {

using SketchMeasurementTest = SketchRunFixture;

TEST_F(SketchMeasurementTest, RefinedAndFittedRowsAreThoseOfTheNetworksFaces) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const SketchTestSet test(data, {.strength = 1}, {});
  testing::WriteParserRun(*folder_ / "parser");
  const SketchMeasurement measured = MeasureSketchRun(
      test,
      {.strength = 1, .parser = (*folder_ / "parser").string(), .baselines = false, .refine = true, .deform = true});
  ASSERT_EQ(measured.table.rows.size(), 3u);
  StoredCoefficients stored(data.run.network);
  stored.Append(test.reader().Forward(data.run.network, test.faces()));
  const SketchPredictions predicted = stored.Decode(0, stored.size());
  const eval::FaceRows refined = RefinedRow(data, test.reader()).Refine(test.faces(), predicted);
  const eval::FaceRows fitted =
      FittedRow(data, test.reader(), std::make_shared<const DrawingParser>(OpenParserOfRun(*folder_ / "parser")))
          .Fit(test.faces(), predicted.faces);
  const auto row = [&](const eval::FaceRows& rows) {
    return test.Measure("rows", [&](const FaceBlock&) { return rows; }).of_faces;
  };
  const std::vector<double> plain = row(predicted.faces), after = row(refined), fits = row(fitted);
  for (size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(measured.table.rows[0].face_errors[i], plain[i], 1e-4);
    EXPECT_NEAR(measured.table.rows[1].face_errors[i], after[i], 1e-3);
    EXPECT_NEAR(measured.table.rows[2].face_errors[i], fits[i], 1e-3);
  }
  EXPECT_EQ(measured.table.rows[1].name, "network, refined");
  EXPECT_EQ(measured.table.rows[2].name, "network, fitted");
  EXPECT_NE(measured.table.rows[2].face_errors, measured.table.rows[1].face_errors);
  EXPECT_EQ(measured.table.result, 0u);
}

TEST_F(SketchMeasurementTest, KeptPredictionsAreThoseThatTheErrorsAreOf) {
  const SketchRunData data = OpenSketchRunData(*folder_ / "run");
  const SketchTestSet test(data, {.strength = 1}, {});
  const SketchMeasurement measured = MeasureSketchRun(test, {.strength = 1, .baselines = false});
  for (size_t i = 0; i < test.faces().size(); ++i)
    EXPECT_NEAR(measured.predictions.at(test.faces()[i]).mean_error_mm(), measured.table.rows[0].face_errors[i], 1e-3);
}

}  // namespace
}  // namespace daumier::sketch
