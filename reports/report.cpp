#include "reports/report.h"

#include "core/error.h"
#include "core/files.h"
#include "render/camera.h"
#include "render/draw.h"
#include "render/heat_map.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "render/ticks.h"
#include "reports/face_pictures.h"
#include "reports/report_page.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::reports {
namespace {

constexpr int kReportCell = 260;  // Pixels a side of a picture in the sheet.
constexpr int kMeanCell = 360;    // The same in the picture of the mean error.
constexpr double kPageMargin = 1.15;

/// Where the colours of the heat maps end.
double ErrorRange(const ReportData& data) {
  if (data.error_range_mm > 0.0) return data.error_range_mm;
  const double mean = std::accumulate(data.face_errors_mm.begin(), data.face_errors_mm.end(), 0.0) /
                      static_cast<double>(data.face_errors_mm.size());
  return mean > 0.0 ? render::NiceCeiling(2.0 * mean, 5) : 1.0;
}

void CheckData(const ReportData& data) {
  DAUMIER_CHECK(!data.samples.empty(), "a report needs a sample to show");
  DAUMIER_CHECK(!data.face_errors_mm.empty(), "a report needs the error of at least one face");
  DAUMIER_CHECK(std::isfinite(data.error_range_mm) && data.error_range_mm >= 0.0,
                "the colours of a report end at {} mm, expected 0 or more", data.error_range_mm);
  const Eigen::Index num_vertices = data.mean_face.rows();
  DAUMIER_CHECK(data.mean_error_mm.size() == num_vertices, "{} mean errors were given for the {} vertices of the face",
                data.mean_error_mm.size(), num_vertices);
  for (const ReportSample& sample : data.samples) {
    DAUMIER_CHECK(sample.truth.rows() == num_vertices && sample.prediction.rows() == num_vertices &&
                      sample.error_mm.size() == num_vertices,
                  "the sample '{}' has {} true vertices, {} predicted ones and {} errors, expected {} each",
                  sample.title, sample.truth.rows(), sample.prediction.rows(), sample.error_mm.size(), num_vertices);
    DAUMIER_CHECK(sample.sketch.height == sample.sketch.width, "the sketch of '{}' is {} x {}, expected a square",
                  sample.title, sample.sketch.height, sample.sketch.width);
  }
  for (const ReportTable& table : data.tables) {
    for (const auto& row : table.rows) {
      DAUMIER_CHECK(row.size() == table.header.size(), "a row of the table '{}' has {} cells, its header {}",
                    table.title, row.size(), table.header.size());
    }
  }
}

/// Draws the pictures of one report: one surface, one frame and one range of colours for all.
class ReportPainter {
 public:
  explicit ReportPainter(const ReportData& data)
      : data_(data),
        head_(HeadOf(data.surface, data.mean_face)),
        frame_(FrameOfFaces(TrueFaces(data), kPageMargin)),
        range_{0.0, ErrorRange(data)} {
    has_sketch_ = std::any_of(data.samples.begin(), data.samples.end(),
                              [](const ReportSample& sample) { return sample.sketch.height > 0; });
  }

  render::Image Sheet() const {
    std::vector<render::SheetCell> rows;
    for (const ReportSample& sample : data_.samples) rows.push_back({Row(sample)});
    return render::MakeSheet(rows, 1, {.gap = 6});
  }

  render::Image MeanError() const {
    const auto front = render::FrontalCamera(frame_.centre, frame_.half_height, kMeanCell);
    const auto side = render::SideCamera(frame_.centre, frame_.half_height, kMeanCell);
    const render::RenderInput input = InputOf(data_.mean_face);
    const Eigen::VectorXd errors = head_.Values(data_.mean_error_mm);
    return render::MakeSheet({{render::RenderHeatMap(input, errors, range_, front), "front"},
                              {render::RenderHeatMap(input, errors, range_, side), "side"},
                              {ColourBar(kMeanCell)}},
                             3);
  }

 private:
  render::RenderInput InputOf(const geometry::Points& points) const { return reports::InputOf(head_, points); }

  render::Image ColourBar(int height) const {
    render::Image bar(height, render::kColourBarWidth, 3);
    render::DrawColourBar(bar, range_, "mm");
    return bar;
  }

  /// All rows are equally wide, with or without a sketch.
  render::Image Row(const ReportSample& sample) const {
    const auto camera = render::FrontalCamera(frame_.centre, frame_.half_height, kReportCell);
    const render::RenderInput truth = InputOf(sample.truth), prediction = InputOf(sample.prediction);
    std::vector<render::SheetCell> cells;
    if (sample.sketch.height > 0) {
      cells.push_back({render::Resize(sample.sketch, kReportCell, kReportCell), "sketch"});
    } else if (has_sketch_) {
      cells.push_back({render::Image(kReportCell, kReportCell, 1)});
    }
    cells.push_back({render::RenderMesh(truth, camera), "truth"});
    cells.push_back({render::RenderMesh(prediction, camera), "prediction"});
    cells.push_back({render::RenderHeatMap(prediction, head_.Values(sample.error_mm), range_, camera), "error"});
    cells.push_back({ColourBar(kReportCell)});
    const int columns = int(cells.size());
    return render::MakeSheet(cells, columns, {.title = sample.title, .gap = 8});
  }

  static std::vector<geometry::Points> TrueFaces(const ReportData& data) {
    std::vector<geometry::Points> faces = {data.mean_face};
    for (const ReportSample& sample : data.samples) faces.push_back(sample.truth);
    return faces;
  }

  const ReportData& data_;
  const faces::FinishedHead head_;
  const render::Frame frame_;
  const render::ValueRange range_;
  bool has_sketch_ = false;
};

}  // namespace

void WriteReport(const std::filesystem::path& folder, const ReportData& data) {
  CheckData(data);
  const std::string curve = ErrorCurveSvg(data.face_errors_mm);
  const ReportPainter painter(data);
  render::WriteImage(folder / "sheet.png", painter.Sheet());
  render::WriteImage(folder / "mean_error.png", painter.MeanError());
  WriteFileAtomically(folder / "errors.svg", curve);
  for (const ReportChart& chart : data.charts) WriteFileAtomically(folder / chart.file, chart.svg);
  WriteFileAtomically(folder / "index.html", ReportPage(data));
}

}  // namespace daumier::reports
