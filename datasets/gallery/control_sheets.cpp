#include "datasets/gallery/control_sheets.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/output_place.h"
#include "faces/controls/composition.h"
#include "render/sheet.h"
#include "reports/face_pictures.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

constexpr double kShownValues[] = {-3.0, -1.5, 0.0, 1.5, 3.0};
constexpr double kComposedValue = 2.0;
constexpr const char* kControlsFile = "controls.json";

/// A control by its row in the sheets: an anatomical one or one of the user.
struct ControlRow {
  std::string name, group, sides;
  int first_value, num_values;
};

std::vector<ControlRow> RowsOf(const faces::FaceControls& controls) {
  using Sides = faces::FaceControl::Sides;
  std::vector<ControlRow> rows;
  for (const auto& entry : controls.entries()) {
    const Sides sides = entry.control.sides;
    rows.push_back({entry.control.name, entry.control.group,
                    sides == Sides::kPaired ? "paired" : (sides == Sides::kSideways ? "sideways" : "middle"),
                    entry.first_value, entry.num_values()});
  }
  const int first_own = rows.empty() ? 0 : rows.back().first_value + rows.back().num_values;
  for (int k = first_own; k < controls.num_values(); ++k)
    rows.push_back({controls.value_names()[k], controls.group_names()[controls.value_groups()[k]], "own", k, 1});
  return rows;
}

geometry::Points At(const faces::FaceControls& controls, const faces::FaceTemplate& face_template,
                    const ControlRow& row, double value) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(controls.num_values());
  values.segment(row.first_value, row.num_values).setConstant(value);
  return controls.Apply(face_template.neutral, values);
}

render::Image SheetOf(const std::string& group, const faces::FaceControls& controls,
                      const faces::FaceTemplate& face_template, const faces::FinishedHead& head) {
  const render::Frame frame = reports::FrameOfFaces({face_template.neutral}, 1.25);
  render::SheetStyle style{.title = fmt::format("{} controls of {}", group, face_template.source)};
  for (const char* view : {"front", "side"}) {
    for (const double value : kShownValues) style.column_titles.push_back(fmt::format("{} {:+.1f}", view, value));
  }
  std::vector<render::SheetCell> cells;
  for (const ControlRow& row : RowsOf(controls)) {
    if (row.group != group) continue;
    style.row_titles.push_back(row.name);
    std::vector<render::SheetCell> sides;
    for (const double value : kShownValues) {
      const geometry::Points face = At(controls, face_template, row, value);
      cells.push_back({reports::FrontView(head, face, frame)});
      sides.push_back({reports::SideView(head, face, frame)});
    }
    cells.insert(cells.end(), sides.begin(), sides.end());
  }
  return render::MakeSheet(cells, static_cast<int>(style.column_titles.size()), style);
}

Json DescribeControls(const faces::FaceControls& controls, const faces::FaceTemplate& face_template) {
  Json described = Json::array();
  const double mm = faces::MillimetresPerCm(face_template);
  for (const ControlRow& row : RowsOf(controls)) {
    const Eigen::VectorXd moved = mm * (At(controls, face_template, row, 1.0) - face_template.neutral).rowwise().norm();
    const auto first = controls.value_names().begin() + row.first_value;
    described.push_back({{"name", row.name},
                         {"group", row.group},
                         {"sides", row.sides},
                         {"values", std::vector<std::string>(first, first + row.num_values)},
                         {"mean_mm", moved.mean()},
                         {"max_mm", moved.maxCoeff()}});
  }
  return described;
}

Json DescribeComposition(const faces::FaceControls& controls, const faces::FaceTemplate& face_template) {
  constexpr size_t kNumShown = 20;
  const auto pairs = faces::MeasureComposition(controls, face_template, kComposedValue);
  double mean = 0;
  for (const auto& pair : pairs) mean += pair.mean_mm / double(pairs.size());
  Json shown = Json::array();
  for (size_t i = 0; i < std::min(kNumShown, pairs.size()); ++i) {
    shown.push_back({{"controls", {pairs[i].first, pairs[i].second}},
                     {"mean_mm", pairs[i].mean_mm},
                     {"max_mm", pairs[i].max_mm},
                     {"share", pairs[i].share}});
  }
  return {{"value", kComposedValue}, {"pairs", pairs.size()}, {"mean_mm", mean}, {"most", shown}};
}

}  // namespace

std::vector<std::string> ControlSheetNames(const faces::FaceControls& controls) {
  std::vector<std::string> names;
  for (const std::string& group : controls.group_names()) names.push_back(group + ".jpg");
  return names;
}

void WriteControlSheets(const faces::FaceControls& controls, const faces::FaceTemplate& face_template,
                        const std::filesystem::path& folder, const Task& task) {
  Manifest manifest{.kind = kControlSheetsKind, .verb = "dataset controls"};
  manifest.sources = Json::array({face_template.provenance});
  manifest.counts = {{"controls", RowsOf(controls).size()}, {"values", controls.num_values()}};
  std::vector<std::string> files = ControlSheetNames(controls);
  files.emplace_back(kControlsFile);
  Manifest begun = manifest;
  begun.details[kUnfinishedFiles] = files;
  WriteManifest(folder, begun);

  const faces::FinishedHead head(face_template);
  const auto num_groups = int64_t(controls.group_names().size());
  for (int64_t done = 0; done < num_groups; ++done) {
    task.Report(done, num_groups, "pictures");
    task.ThrowIfCancelled("stopped after {} of {} pictures in {}; the same command makes all of them", done, num_groups,
                          folder.string());
    const std::string& group = controls.group_names()[done];
    render::WriteImage(folder / (group + ".jpg"), SheetOf(group, controls, face_template, head));
  }
  const Json described = {{"controls", DescribeControls(controls, face_template)},
                          {"composition", DescribeComposition(controls, face_template)}};
  WriteFileAtomically(folder / kControlsFile, described.dump(1) + "\n");
  for (const std::string& file : files) manifest.checksums[file] = Sha256OfFile(folder / file);
  WriteManifest(folder, manifest);
  task.Report(num_groups, num_groups, "pictures");
}

}  // namespace daumier::datasets
