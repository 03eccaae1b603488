#include "eval/report.h"

#include "core/files.h"
#include "core/random.h"
#include "eval/report_page.h"
#include "render/draw.h"
#include "render/heat_map.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace daumier::eval {
namespace {

using testing::ExpectError;
namespace fs = std::filesystem;

/// A report on faces that are the synthetic one and its wider likeness.
ReportData SyntheticReport() {
  const faces::FaceTemplate face = testing::SyntheticFace();
  ReportData data;
  data.title = "Sketch to face: synthetic, test split";
  data.summary = "Two faces of one person.";
  data.surface = {face.triangles, face.closing_triangles, face.num_eye_closing_triangles};
  data.mean_face = face.neutral;
  geometry::Points wider = face.neutral;
  wider.col(0) *= 1.05;
  const Eigen::VectorXd error_mm = 10.0 * (wider - face.neutral).rowwise().norm();
  render::Image sketch(256, 256, 1);
  render::FillRectangle(sketch, 60, 60, 6, 136, {20, 20, 20});
  data.samples = {{"median: 1.50 mm", sketch, face.neutral, wider, error_mm},
                  {"worst: 3.00 mm", {}, wider, face.neutral, error_mm}};
  data.samples[1].error_mm.head(200).setConstant(std::numeric_limits<double>::quiet_NaN());
  data.mean_error_mm = error_mm;
  Rng rng(7);
  for (int i = 0; i < 200; ++i) data.face_errors_mm.push_back(2.0 * std::exp(0.35 * rng.Normal()));
  data.tables = {{"Errors", {"method", "mm"}, {{"network", "2.12"}, {"mean face", "4.75"}}}};
  data.facts = {{"seed", "7"}, {"split", "random (12 training faces)"}};
  return data;
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// Expects that each tag is closed in the order in which tags were opened, that attributes stand in quotes, and that
/// all is in one element.
void ExpectWellFormed(const std::string& xml) {
  std::vector<std::string> open;
  int num_roots = 0;
  for (size_t begin = xml.find('<'); begin != std::string::npos; begin = xml.find('<', begin + 1)) {
    const size_t end = xml.find('>', begin);
    ASSERT_NE(end, std::string::npos) << "a tag has no end";
    const std::string tag = xml.substr(begin + 1, end - begin - 1);
    ASSERT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
    ASSERT_EQ(Count(tag, "="), Count(tag, "=\"")) << tag;
    if (tag.front() == '/') {
      ASSERT_FALSE(open.empty()) << tag;
      ASSERT_EQ(tag.substr(1), open.back());
      open.pop_back();
    } else {
      num_roots += open.empty() ? 1 : 0;
      if (tag.back() != '/') open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(num_roots, 1);
}

TEST(Report, WritesFourFilesIntoTheFolder) {
  const testing::TempDir folder;
  WriteReport(folder.path(), SyntheticReport());
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.path())) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"errors.svg", "index.html", "mean_error.png", "sheet.png"}));
  EXPECT_EQ(ReadFile(folder / "errors.svg"), ErrorCurveSvg(SyntheticReport().face_errors_mm));
  const render::Image mean_error = render::ReadImage(folder / "mean_error.png");
  EXPECT_GT(mean_error.width, 2 * mean_error.height * 4 / 5) << "front and side stand side by side";
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

TEST(ReportPage, EscapesAllText) {
  ReportData data = SyntheticReport();
  const std::string evil = R"(<script a="1" b='2'>&)";
  data.title = data.summary = evil;
  data.tables = {{evil, {evil, evil}, {{evil, evil}}}};
  data.facts = {{evil, evil}};
  const std::string page = ReportPage(data);
  EXPECT_EQ(Count(page, "<script"), 0);
  EXPECT_EQ(Count(page, "&lt;script a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;"), 3 + 5 + 2);
}

TEST(ReportPage, HoldsTablesFactsAndPicturesAndNeedsNothingFromElsewhere) {
  const std::string page = ReportPage(SyntheticReport());
  EXPECT_NE(page.find("<tr><th>method</th><th>mm</th></tr>"), std::string::npos);
  EXPECT_NE(page.find("<tr><td>mean face</td><td>4.75</td></tr>"), std::string::npos);
  EXPECT_NE(page.find("<dt>seed</dt><dd>7</dd>"), std::string::npos);
  for (const char* name : {"sheet.png", "mean_error.png", "errors.svg"})
    EXPECT_EQ(Count(page, fmt::format("<img src=\"{}\"", name)), 1) << name;
  EXPECT_EQ(Count(page, "://"), 0);
  EXPECT_EQ(Count(page, "<link") + Count(page, "@import") + Count(page, "url("), 0);
}

TEST(ErrorHistogram, CountsByHand) {
  // The largest error over 5 bins asks for 0.92 at least, so bins are 1 mm wide.
  const ErrorHistogram histogram = MakeErrorHistogram({0.0, 0.99, 1.0, 2.5, 2.6, 4.6}, 5);
  EXPECT_EQ(histogram.bin_width, 1.0);
  EXPECT_EQ(histogram.counts, (std::vector<int>{2, 1, 2, 0, 1}));
}

TEST(ErrorHistogram, AnErrorOnABorderIsInTheUpperBin) {
  const ErrorHistogram histogram = MakeErrorHistogram({0.1, 0.2, 0.3, 0.6, 0.7}, 7);
  EXPECT_DOUBLE_EQ(histogram.bin_width, 0.1);
  EXPECT_EQ(histogram.counts, (std::vector<int>{0, 1, 1, 1, 0, 0, 1, 1}));
}

TEST(ErrorHistogram, HoldsEachFaceOnceInAboutTheBinsAskedFor) {
  Rng rng(3);
  for (const double scale : {1e-3, 0.7, 13.0, 4e4}) {
    std::vector<double> errors;
    for (int i = 0; i < 500; ++i) errors.push_back(scale * rng.Uniform());
    const ErrorHistogram histogram = MakeErrorHistogram(errors);
    EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0), 500);
    EXPECT_LE(histogram.counts.size(), 25u);
    EXPECT_GE(histogram.counts.size(), 24u / 3);
    EXPECT_GT(histogram.counts.back(), 0);
  }
}

TEST(ErrorHistogram, RefusesWhatIsNoError) {
  EXPECT_THROW(MakeErrorHistogram({}), Error);
  EXPECT_THROW(MakeErrorHistogram({1.0, -0.1}), Error);
  EXPECT_THROW(MakeErrorHistogram({std::numeric_limits<double>::quiet_NaN()}), Error);
  EXPECT_THROW(MakeErrorHistogram({std::numeric_limits<double>::infinity()}), Error);
}

TEST(ErrorCurveSvg, IsWellFormedAndHasABarForEachBinWithFaces) {
  const std::vector<double> errors = SyntheticReport().face_errors_mm;
  const std::string svg = ErrorCurveSvg(errors);
  ExpectWellFormed(svg);
  const ErrorHistogram histogram = MakeErrorHistogram(errors);
  const auto num_empty = std::count(histogram.counts.begin(), histogram.counts.end(), 0);
  EXPECT_EQ(Count(svg, "class=\"bar\""), int(histogram.counts.size() - size_t(num_empty)));
  EXPECT_EQ(Count(svg, "class=\"line\""), 1);
  for (const char* label : {"mean vertex error (mm)", ">faces<", "share of faces (%)", ">100<"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
}

TEST(ErrorCurveSvg, OneFaceAndFacesWithoutErrorHaveACurve) {
  ExpectWellFormed(ErrorCurveSvg({2.5}));
  const std::string svg = ErrorCurveSvg({0.0, 0.0, 0.0});
  ExpectWellFormed(svg);
  EXPECT_EQ(Count(svg, "nan"), 0);
  EXPECT_EQ(Count(svg, "inf"), 0);
}

TEST(ErrorCurveSvg, StaysSmallWithManyFaces) {
  Rng rng(5);
  std::vector<double> errors;
  for (int i = 0; i < 50000; ++i) errors.push_back(3.0 + rng.Uniform());
  EXPECT_LT(ErrorCurveSvg(errors).size(), 40000u);
}

}  // namespace
}  // namespace daumier::eval
