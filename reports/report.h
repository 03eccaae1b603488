#pragma once
#include "geometry/mesh.h"
#include "render/image.h"
#include "reports/curve_chart.h"
#include "reports/face_surface.h"
#include "reports/html_page.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::reports {

/// A row of sheet.png. Which samples are shown is the caller's choice.
struct ReportSample {
  std::string title;                   ///< ASCII: "median: 2.31 mm".
  render::Image sketch;                ///< Square, grey or RGB; empty where the input is no picture.
  geometry::Points truth, prediction;  ///< V x 3, cm.
  Eigen::VectorXd error_mm;            ///< V; NaN where no error is counted (shown grey).
};

struct ReportData {
  std::string title;    ///< "Sketch to face: ict, test split".
  std::string summary;  ///< A sentence or two below the title.
  ReportSurface surface;
  std::vector<ReportSample> samples;
  geometry::Points mean_face;          ///< V x 3, cm: carries the map of the mean error.
  Eigen::VectorXd mean_error_mm;       ///< V: mean over all test faces; NaN where no error is counted.
  std::vector<double> face_errors_mm;  ///< Mean vertex error of each test face, in any order.
  std::vector<ReportTable> tables;
  std::vector<ReportChart> charts = {};  ///< Further ones.
  std::vector<ReportFact> facts;         ///< Data hash, split, seed, command, seconds.
  /// Upper end of the heat maps' colours; 0: twice the mean of face_errors_mm, rounded up.
  double error_range_mm = 0.0;
};

/// Writes into an existing folder, each file atomically: sheet.png (a row a sample: sketch | truth | prediction |
/// error, without the sketches if there are none, in one frame that holds the true faces), mean_error.png (the mean
/// error on the mean face, front and side), errors.svg (histogram and cumulative share of face_errors_mm), the charts and
/// index.html, which shows them with the tables and facts, needs nothing from elsewhere, and escapes all text that it
/// is given.
/// @throws Error if shapes disagree, there are no samples or no errors, or a file cannot be written.
void WriteReport(const std::filesystem::path& folder, const ReportData& data);

/// Number of faces in each bin [k * width, (k + 1) * width), from 0 up to the largest error.
struct ErrorHistogram {
  double bin_width = 0.0;
  std::vector<int> counts;
};
/// About `max_bins` bins of a width of 1, 2 or 5 times a power of ten. @throws Error if there are no errors or one is
/// negative or not finite.
ErrorHistogram MakeErrorHistogram(const std::vector<double>& errors_mm, int max_bins = 24);

/// errors.svg: bars for the histogram, a line for the share of faces with at most that error, both with axes and
/// labels.
std::string ErrorCurveSvg(const std::vector<double>& errors_mm);

}  // namespace daumier::reports
