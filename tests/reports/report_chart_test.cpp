#include "core/error.h"
#include "tests/reports/report_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace daumier::reports {
namespace {

TEST(ErrorHistogram, CountsByHand) {
  // The largest error over 5 bins requires a width of at least 0.92, so bins are 1 mm wide.
  const ErrorHistogram histogram = MakeErrorHistogram({0.0, 0.99, 1.0, 2.5, 2.6, 4.6}, 5);
  EXPECT_EQ(histogram.bin_width, 1.0);
  EXPECT_EQ(histogram.counts, (std::vector<int>{2, 1, 2, 0, 1}));
}

TEST(ErrorHistogram, AnErrorOnABorderIsInTheUpperBin) {
  const ErrorHistogram histogram = MakeErrorHistogram({0.1, 0.2, 0.3, 0.6, 0.7}, 7);
  EXPECT_DOUBLE_EQ(histogram.bin_width, 0.1);
  EXPECT_EQ(histogram.counts, (std::vector<int>{0, 1, 1, 1, 0, 0, 1, 1}));
}

TEST(ErrorHistogram, HoldsEachFaceOnceInAboutTheRequestedBins) {
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
}  // namespace daumier::reports
