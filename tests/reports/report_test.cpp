#include "reports/report.h"

#include "core/files.h"
#include "render/heat_map.h"
#include "tests/reports/report_fixture.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace daumier::reports {
namespace {

using testing::ExpectError;
namespace fs = std::filesystem;

TEST(Report, WritesFourFilesIntoTheFolder) {
  const testing::TempDir folder;
  WriteReport(folder.path(), SyntheticReport());
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path())) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"errors.svg", "index.html", "mean_error.png", "sheet.png"}));
  EXPECT_EQ(ReadFile(folder / "errors.svg"), ErrorCurveSvg(SyntheticReport().face_errors_mm));
  const render::Image mean_error = render::ReadImage(folder / "mean_error.png");
  EXPECT_GT(mean_error.width, 2 * mean_error.height * 4 / 5) << "front and side are side by side";
}

TEST(Report, ASheetHasARowASample) {
  const testing::TempDir folder;
  ReportData data = SyntheticReport();
  WriteReport(folder.path(), data);
  const render::Image two = render::ReadImage(folder / "sheet.png");
  data.samples.pop_back();
  WriteReport(folder.path(), data);
  const render::Image one = render::ReadImage(folder / "sheet.png");
  EXPECT_EQ(one.width, two.width) << "a row without a sketch is as wide as one with it";
  EXPECT_NEAR(two.height, 2 * one.height, 20);
  data.samples[0].sketch = {};
  WriteReport(folder.path(), data);
  EXPECT_LT(render::ReadImage(folder / "sheet.png").width, one.width - 200) << "without any there is no column of them";
}

TEST(Report, ALongTrueFaceIsInThePictures) {
  const testing::TempDir folder;
  ReportData data = SyntheticReport();
  data.samples.pop_back();
  data.samples[0].sketch = {};
  data.samples[0].truth *= 3;
  WriteReport(folder.path(), data);
  const render::Image sheet = render::ReadImage(folder / "sheet.png");
  // Above and below the face its picture shows the background alone.
  const int column = sheet.width / 8;
  int first = sheet.height, last = 0;
  for (int row = 0; row < sheet.height; ++row)
    if (const int grey = sheet.at(row, 2 * column, 1); grey > 100 && grey < 225) {
      first = std::min(first, row);
      last = std::max(last, row);
    }
  EXPECT_GT(first, 40);
  EXPECT_LT(last, sheet.height - 25);
}

TEST(Report, AFaceWithoutErrorHasTheFirstColour) {
  const testing::TempDir folder;
  ReportData data = SyntheticReport();
  data.samples.pop_back();
  data.mean_error_mm.setZero();
  WriteReport(folder.path(), data);
  const render::Image zero = render::ReadImage(folder / "mean_error.png");
  data.mean_error_mm.setConstant(data.error_range_mm = 3.0);
  WriteReport(folder.path(), data);
  const render::Image large = render::ReadImage(folder / "mean_error.png");
  // The middle of the frontal picture is on the nose. Viridis goes from dark violet to yellow.
  const int row = zero.height / 2, column = (zero.width - render::kColourBarWidth) / 4;
  EXPECT_GT(zero.at(row, column, 2), zero.at(row, column, 1) + 30);
  EXPECT_GT(large.at(row, column, 1), large.at(row, column, 2) + 60);
}

TEST(Report, ColoursEndAtTwiceTheMeanErrorRoundedUp) {
  const testing::TempDir folder;
  ReportData data = SyntheticReport();
  data.samples.pop_back();
  data.face_errors_mm = {1.0, 2.0, 3.9};  // Twice the mean is 4.6, and ticks are 1 apart.
  WriteReport(folder.path(), data);
  const std::string free = ReadFile(folder / "mean_error.png");
  data.error_range_mm = 5.0;
  WriteReport(folder.path(), data);
  EXPECT_EQ(free, ReadFile(folder / "mean_error.png"));
  data.error_range_mm = 6.0;
  WriteReport(folder.path(), data);
  EXPECT_NE(free, ReadFile(folder / "mean_error.png"));
}

TEST(Report, AllErrorsMayBeZero) {
  const testing::TempDir folder;
  ReportData data = SyntheticReport();
  data.samples.pop_back();
  data.face_errors_mm = {0.0, 0.0};
  WriteReport(folder.path(), data);
  EXPECT_TRUE(fs::exists(folder / "index.html"));
}

TEST(Report, RefusesDataThatDisagree) {
  const testing::TempDir folder;
  const auto expect_refused = [&](const std::function<void(ReportData&)>& spoil, const std::string& part) {
    ReportData data = SyntheticReport();
    spoil(data);
    ExpectError([&] { WriteReport(folder.path(), data); }, part);
  };
  expect_refused([](ReportData& data) { data.samples.clear(); }, "a sample");
  expect_refused([](ReportData& data) { data.face_errors_mm.clear(); }, "at least one face");
  expect_refused([](ReportData& data) { data.face_errors_mm[3] = -1.0; }, "no distance");
  expect_refused([](ReportData& data) { data.error_range_mm = -2.0; }, "0 or more");
  expect_refused([](ReportData& data) { data.mean_error_mm.conservativeResize(5); }, "5 mean errors");
  expect_refused([](ReportData& data) { data.samples[1].truth.conservativeResize(4, 3); }, "4 true vertices");
  expect_refused([](ReportData& data) { data.samples[1].prediction.conservativeResize(4, 3); }, "4 predicted");
  expect_refused([](ReportData& data) { data.samples[0].error_mm.conservativeResize(4); }, "4 errors");
  expect_refused([](ReportData& data) { data.samples[0].sketch = render::Image(10, 12, 1); }, "10 x 12");
  expect_refused([](ReportData& data) { data.tables[0].rows[1].pop_back(); }, "1 cells, its header 2");
  EXPECT_TRUE(fs::is_empty(folder.path())) << "nothing is written before all is checked";
}

TEST(Report, RefusesAFolderThatIsNotThere) {
  const testing::TempDir folder;
  EXPECT_THROW(WriteReport(folder / "missing", SyntheticReport()), Error);
}

}  // namespace
}  // namespace daumier::reports
