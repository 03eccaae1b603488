#include "systems/portrait/alignment_tables.h"

#include "core/error.h"
#include "core/statistics.h"

#include <fmt/core.h>

#include <cmath>
#include <functional>

namespace daumier::portrait {
namespace {

/// Totals as printed [Pan et al. 2024, tables 1 and 2]: eyes, nose, brow, mouth, contour, total, colours; of unnamed
/// units, sums over landmarks.
struct PrintedErrors {
  AlignmentMethod method;
  const char* total;
};
constexpr std::array<PrintedErrors, 4> kPrintedTotals = {{{AlignmentMethod::kCoarse, "127.96"},
                                                          {AlignmentMethod::kAdjustExp, "143.38"},
                                                          {AlignmentMethod::kAdjustIdExp, "110.70"},
                                                          {AlignmentMethod::kFine, "37.44"}}};

std::string PrintedTotal(AlignmentMethod method) {
  for (const PrintedErrors& printed : kPrintedTotals) {
    if (printed.method == method) return printed.total;
  }
  return "-";
}

/// Eyes, nose, brows, mouth, jaw: the columns of the paper.
constexpr std::array<int, 5> kColumnsOfParts = {3, 2, 1, 4, 0};

/// The mean over portraits of the mean over landmarks begin .. end - 1, of a share of the interocular distance or pixels.
double MeanOfLandmarks(const AlignmentRow& row, std::array<double, 68> AlignmentErrors::*errors, int begin, int end,
                       bool as_share) {
  double sum = 0;
  for (const AlignmentErrors& of_portrait : row.errors) {
    for (int k = begin; k < end; ++k)
      sum += (of_portrait.*errors)[size_t(k)] / (as_share ? of_portrait.interocular_px : 1);
  }
  return sum / double(row.errors.size()) / (end - begin);
}

double MeanNumber(const AlignmentRow& row, const std::function<double(const AlignmentErrors&)>& number) {
  double sum = 0;
  for (const AlignmentErrors& errors : row.errors) sum += number(errors);
  return sum / double(row.errors.size());
}

std::string Number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string PxAndShare(const AlignmentRow& row, std::array<double, 68> AlignmentErrors::*errors, int begin, int end) {
  return fmt::format("{:.2f} ({:.1f} %)", MeanOfLandmarks(row, errors, begin, end, false),
                     100 * MeanOfLandmarks(row, errors, begin, end, true));
}

}  // namespace

reports::ReportTable LandmarkTable(const std::vector<AlignmentRow>& rows) {
  reports::ReportTable table{
      "Landmarks", {"row", "eyes", "nose", "brows", "mouth", "contour", "all", "held out", "total, paper"}, {}};
  for (const AlignmentRow& row : rows) {
    std::vector<std::string> cells = {NameOf(row.method)};
    for (const int p : kColumnsOfParts)
      cells.push_back(
          PxAndShare(row, &AlignmentErrors::used_px, kLandmarkParts[size_t(p)].begin, kLandmarkParts[size_t(p)].end));
    cells.push_back(PxAndShare(row, &AlignmentErrors::used_px, 0, 68));
    cells.push_back(PxAndShare(row, &AlignmentErrors::alternate_px, 0, 68));
    cells.push_back(PrintedTotal(row.method));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

reports::ReportTable LeftOutTable(const std::vector<AlignmentRow>& rows) {
  reports::ReportTable table{"Landmarks left out", {"row"}, {}};
  for (const int p : kColumnsOfParts) table.header.push_back("no " + std::string(kLandmarkParts[size_t(p)].name));
  table.header.push_back("mean of landmarks");
  for (const int p : kColumnsOfParts)
    table.header.push_back("every other, " + std::string(kLandmarkParts[size_t(p)].name));
  for (const AlignmentRow& row : rows) {
    std::vector<std::string> cells = {NameOf(row.method)};
    const auto add = [&](std::array<double, 68> AlignmentErrors::*errors, int begin, int end) {
      cells.push_back(fmt::format("{:.1f} %", 100 * MeanOfLandmarks(row, errors, begin, end, true)));
    };
    for (const int p : kColumnsOfParts)
      add(&AlignmentErrors::left_out_px, kLandmarkParts[size_t(p)].begin, kLandmarkParts[size_t(p)].end);
    add(&AlignmentErrors::left_out_px, 0, 68);
    for (const int p : kColumnsOfParts)
      add(&AlignmentErrors::alternate_px, kLandmarkParts[size_t(p)].begin, kLandmarkParts[size_t(p)].end);
    table.rows.push_back(std::move(cells));
  }
  return table;
}

reports::ReportTable ShapeTable(const std::vector<AlignmentRow>& rows, const std::vector<int>& persons) {
  reports::ReportTable table{
      "Shape", {"row", "3-D, mm", "colours", "flips", "portraits without flips", "intersections", "ms"}, {}};
  for (const AlignmentRow& row : rows) {
    std::vector<double> mm;
    int without_flips = 0;
    for (const AlignmentErrors& errors : row.errors) {
      if (std::isfinite(errors.error_mm)) mm.push_back(errors.error_mm);
      without_flips += errors.flips == 0;
    }
    std::string shape = "-";
    if (mm.size() == persons.size()) {
      const Interval interval = PersonBootstrap(mm, persons, 1);
      shape = fmt::format("{:.2f} ({:.2f} to {:.2f})", Mean(mm), interval.low, interval.high);
    }
    double colours = 0;
    int num_coloured = 0;
    for (const AlignmentErrors& errors : row.errors) {
      if (!std::isfinite(errors.colours)) continue;
      colours += errors.colours;
      ++num_coloured;
    }
    table.rows.push_back({NameOf(row.method), shape, num_coloured > 0 ? Number(colours / num_coloured, 3) : "-",
                          Number(MeanNumber(row, [](const auto& e) { return double(e.flips); }), 1),
                          fmt::format("{} of {}", without_flips, row.errors.size()),
                          Number(MeanNumber(row, [](const auto& e) { return double(e.intersections); }), 1),
                          Number(MeanNumber(row, [](const auto& e) { return e.ms; }), 1)});
  }
  return table;
}

Json AlignmentJson(const std::vector<AlignmentRow>& rows) {
  Json json = Json::array();
  for (const AlignmentRow& row : rows) {
    Json entry = {{"name", NameOf(row.method)}, {"num_portraits", row.errors.size()}};
    for (const LandmarkPart& part : kLandmarkParts) {
      const std::string name(part.name);
      entry[name + "_px"] = MeanOfLandmarks(row, &AlignmentErrors::used_px, part.begin, part.end, false);
      entry[name] = MeanOfLandmarks(row, &AlignmentErrors::used_px, part.begin, part.end, true);
      entry[name + "_held_out"] = MeanOfLandmarks(row, &AlignmentErrors::alternate_px, part.begin, part.end, true);
      entry[name + "_left_out"] = MeanOfLandmarks(row, &AlignmentErrors::left_out_px, part.begin, part.end, true);
    }
    entry["landmark_error"] = MeanOfLandmarks(row, &AlignmentErrors::used_px, 0, 68, true);
    entry["held_out"] = MeanOfLandmarks(row, &AlignmentErrors::alternate_px, 0, 68, true);
    entry["left_out"] = MeanOfLandmarks(row, &AlignmentErrors::left_out_px, 0, 68, true);
    const auto number = [&](const char* key, double value) {
      entry[key] = std::isfinite(value) ? Json(value) : Json();
    };
    number("error_mm", MeanNumber(row, [](const auto& e) { return e.error_mm; }));
    number("colours", MeanNumber(row, [](const auto& e) { return e.colours; }));
    number("flips", MeanNumber(row, [](const auto& e) { return double(e.flips); }));
    number("intersections", MeanNumber(row, [](const auto& e) { return double(e.intersections); }));
    number("ms", MeanNumber(row, [](const auto& e) { return e.ms; }));
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace daumier::portrait
