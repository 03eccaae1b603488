#include "reports/predictions.h"

#include "tests/reports/report_fixture.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

namespace daumier::reports {
namespace {

/// Faces 2 and 5: the samples of the synthetic report.
Predictions TwoFaces() {
  const ReportData report = SyntheticReport();
  Predictions predictions{report.surface, {}};
  for (const ReportSample& sample : report.samples)
    predictions.faces.push_back({predictions.faces.empty() ? 2 : 5, report.samples[0].sketch, sample.truth,
                                 sample.prediction, sample.error_mm});
  return predictions;
}

TEST(Predictions, ReadingUndoesWriting) {
  const testing::TempDir folder;
  const Predictions written = TwoFaces();
  WritePredictions(folder / "predictions.safetensors", written);
  const Predictions read = ReadPredictions(folder / "predictions.safetensors");
  EXPECT_EQ(read.surface.triangles, written.surface.triangles);
  EXPECT_EQ(read.surface.closing_triangles, written.surface.closing_triangles);
  EXPECT_EQ(read.surface.num_eye_closing_triangles, written.surface.num_eye_closing_triangles);
  ASSERT_EQ(read.faces.size(), 2u);
  for (const int face : {2, 5}) {
    EXPECT_EQ(read.at(face).sketch, written.at(face).sketch);
    EXPECT_LT((read.at(face).truth - written.at(face).truth).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT((read.at(face).prediction - written.at(face).prediction).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_NEAR(read.at(face).mean_error_mm(), written.at(face).mean_error_mm(), 1e-5);
  }
  EXPECT_EQ(read.at(5).error_mm.array().isNaN().count(), 200) << "where no error is counted";
  testing::ExpectError([&] { read.at(3); }, "no prediction of face 3");
}

TEST(Predictions, OfInputsThatAreNoPicturesHaveNoSketches) {
  const testing::TempDir folder;
  Predictions written = TwoFaces();
  written.faces[1].sketch = {};
  WritePredictions(folder / "predictions.safetensors", written);
  EXPECT_EQ(ReadPredictions(folder / "predictions.safetensors").faces[0].sketch.height, 0);
}

TEST(Predictions, RefusesWhatDoesNotFitAndDamagedFiles) {
  const testing::TempDir folder;
  Predictions predictions = TwoFaces();
  predictions.faces[1].error_mm.conservativeResize(3);
  testing::ExpectError([&] { WritePredictions(folder / "p", predictions); }, "face 5 has");
  testing::ExpectError([&] { WritePredictions(folder / "p", {}); }, "no predicted face");
  testing::ExpectError([&] { ReadPredictions(folder / "absent"); }, "absent");
  WritePredictions(folder / "p", TwoFaces());
  std::filesystem::resize_file(folder / "p", 1000);
  testing::ExpectError([&] { ReadPredictions(folder / "p"); }, "not the predictions of a report");
}

/// Errors fall with the index.
MetricTable Table(int num_faces) {
  MetricTable table{.columns = {{.key = "error", .title = "mm", .unit = "mm"}}};
  std::vector<double> errors;
  for (int face = 0; face < num_faces; ++face) {
    table.faces.push_back(face);
    table.groups.push_back(face);
    errors.push_back(num_faces - face);
  }
  table.rows = {MakeRow(table, "network", {{"error", errors}}, 1)};
  return table;
}

TEST(KeptFaces, AreEvenlySpreadAndThoseThatTheReportShows) {
  const std::vector<int> few = KeptFaces(Table(5));
  EXPECT_EQ(few, (std::vector<int>{0, 1, 2, 3, 4}));
  const std::vector<int> kept = KeptFaces(Table(161));
  for (int i = 0; i < 16; ++i) EXPECT_EQ(std::count(kept.begin(), kept.end(), i * 161 / 16), 1) << i;
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 8), 1) << "where the worst 5 % begin";
  EXPECT_LE(kept.size(), 20u);
}

TEST(ChosenSamples, AreTitledByErrorAndFace) {
  MetricTable table = Table(2);
  Predictions predictions = TwoFaces();
  table.faces = {2, 5};
  predictions.faces[0].error_mm.setConstant(4);
  predictions.faces[1].error_mm.setConstant(1.5);
  const auto samples = ChosenSamples(table, predictions, [](int face) { return fmt::format("face {}", face); });
  ASSERT_EQ(samples.size(), 4u);
  EXPECT_EQ(samples[0].title, "median: 1.50 mm; face 5");
  EXPECT_EQ(samples[2].title, "worst: 4.00 mm; face 2");
  EXPECT_EQ(samples[3].truth, predictions.faces[0].truth);
}

}  // namespace
}  // namespace daumier::reports
