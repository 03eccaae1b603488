#include "systems/deform/labelled_faces.h"

#include "core/csv.h"
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "eval/mesh_score.h"
#include "faces/controls/smooth_warps.h"
#include "fitting/mesh_code.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace daumier::deform {
namespace {

constexpr double kUnlabelled = std::numeric_limits<double>::quiet_NaN();
/// Of the fit of a code to each of many faces.
constexpr int kPointsOfLabelledFace = 500;

void CheckTopology(const OpenedModel& opened, const faces::FaceDatabase& database) {
  const int num_vertices = opened.model->face_template().num_vertices();
  DAUMIER_CHECK(database.num_vertices() == num_vertices,
                "{}: faces of {} vertices, but the model has {}: name faces of the model's topology",
                database.directory().string(), database.num_vertices(), num_vertices);
}

/// Whether these are the faces that the model was trained on.
bool AreOwnFaces(const OpenedModel& opened, const faces::FaceDatabase& database) {
  return !opened.training_faces.empty() && std::filesystem::equivalent(opened.faces, database.directory());
}

Eigen::MatrixXd CodesOf(const OpenedModel& opened, const faces::FaceDatabase& database, const std::vector<int>& indices,
                        const Task& task) {
  if (AreOwnFaces(opened, database)) {
    std::vector<Eigen::Index> rows;
    const std::vector<int>& trained = opened.training_faces;
    for (const int index : indices) {
      const auto found = std::lower_bound(trained.begin(), trained.end(), index);
      if (found == trained.end() || *found != index) break;
      rows.push_back(found - trained.begin());
    }
    if (rows.size() == indices.size()) return opened.training_codes(rows, Eigen::all);
  }
  return fitting::CodesOfMeshes(
      *opened.model, int(indices.size()), [&](int i) { return database.points(indices[size_t(i)]); },
      {.num_points = kPointsOfLabelledFace}, task);
}

bool IsRegular(const faces::FaceId& id) {
  return id.level == 0 && id.expression == 0;
}

/// At most kMostRegular: their mean is the mean face.
std::vector<geometry::Points> RegularFaces(const faces::FaceDatabase& database) {
  constexpr int kMostRegular = 200;
  std::vector<int> indices;
  for (int face = 0; face < database.num_grid_faces(); ++face)
    if (IsRegular(database.id(face))) indices.push_back(face);
  std::vector<geometry::Points> regular;
  for (const int index : EvenlySpaced(indices, kMostRegular)) regular.push_back(database.points(index));
  return regular;
}

/// Without blanks at its end, as files that people type have them.
std::string TrimmedCell(std::string cell) {
  while (cell.ends_with(' ')) cell.pop_back();
  return cell;
}

}  // namespace

ControlLabels::ControlLabels(const faces::FaceDatabase& database)
    : controls_(database.face_template(), faces::SmoothWarps(database.face_template())),
      fit_(controls_, database.face_template(), RegularFaces(database)) {
  for (const faces::FaceControls::Entry& entry : controls_.entries()) names_.push_back(entry.control.name);
}

Eigen::VectorXd ControlLabels::Of(const geometry::Points& face) const {
  const Eigen::VectorXd values = fit_.ValuesOf(face);
  Eigen::VectorXd labels(std::ssize(names_));
  for (size_t k = 0; k < names_.size(); ++k) {
    const faces::FaceControls::Entry& entry = controls_.entries()[k];
    labels[Eigen::Index(k)] = values.segment(entry.first_value, entry.num_values()).mean();
  }
  return labels;
}

LabelledDatabase LabelledFaces(const OpenedModel& opened, const faces::FaceDatabase& database, int most,
                               const Task& task) {
  CheckTopology(opened, database);
  std::vector<int> all = opened.training_faces;
  if (!AreOwnFaces(opened, database)) {
    all.resize(size_t(database.num_grid_faces()));
    std::iota(all.begin(), all.end(), 0);
  }
  const std::vector<int> chosen = EvenlySpaced(all, most);
  std::optional<ControlLabels> controls;
  if (database.num_persons() >= faces::ControlFit::kFewestFaces) controls.emplace(database);
  LabelledDatabase result;
  fitting::LabelledCodes& labelled = result.faces;
  if (controls) labelled.names = controls->names();
  const Eigen::Index num_controls = std::ssize(labelled.names), num_expressions = database.num_expressions() - 1;
  labelled.names.insert(labelled.names.end(), database.expression_names().begin() + 1,
                        database.expression_names().end());
  const bool has_levels = database.num_levels() > 1;
  if (has_levels) labelled.names.emplace_back(kCaricatureLabel);
  labelled.labels = Eigen::MatrixXd::Constant(std::ssize(chosen), std::ssize(labelled.names), kUnlabelled);
  for (size_t i = 0; i < chosen.size(); ++i) {
    const faces::FaceId id = database.id(chosen[i]);
    auto row = labelled.labels.row(Eigen::Index(i));
    if (id.expression == 0) {
      if (controls) row.head(num_controls) = controls->Of(database.points(chosen[i])).transpose();
      row.segment(num_controls, num_expressions).setZero();
    } else {
      row[num_controls + id.expression - 1] = 1;
    }
    if (has_levels) row[row.size() - 1] = id.level > 0 ? 1 : 0;
  }
  labelled.codes = CodesOf(opened, database, chosen, task);
  int num_regular = 0;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(labelled.codes.cols());
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (!IsRegular(database.id(chosen[i]))) continue;
    sum += labelled.codes.row(Eigen::Index(i)).transpose();
    ++num_regular;
  }
  if (num_regular > 0) result.regular_mean = sum / num_regular;
  return result;
}

fitting::LabelledCodes LabelledByFile(const OpenedModel& opened, const faces::FaceDatabase& database,
                                      const std::filesystem::path& file, const Task& task) {
  CheckTopology(opened, database);
  std::vector<CsvRow> rows = ParseCsv(ReadFile(file), file.string());
  for (CsvRow& row : rows) std::ranges::transform(row.cells, row.cells.begin(), TrimmedCell);
  fitting::LabelledCodes labelled;
  DAUMIER_CHECK(!rows.empty(), "{} is empty (expected a header name,LABEL,...)", file.string());
  const std::vector<std::string>& header = rows.front().cells;
  DAUMIER_CHECK(header.size() >= 2, "{}:1: a header of {} columns, expected name,LABEL,...", file.string(),
                header.size());
  labelled.names.assign(header.begin() + 1, header.end());
  std::vector<int> indices;
  std::vector<double> values;
  for (size_t r = 1; r < rows.size(); ++r) {
    const std::vector<std::string>& cells = rows[r].cells;
    if (cells.size() == 1 && cells[0].empty()) continue;
    DAUMIER_CHECK(cells.size() == header.size(), "{}:{}: {} columns, expected {}", file.string(), rows[r].line,
                  cells.size(), header.size());
    const std::optional<int> face = eval::FaceNamed(database, cells[0]);
    DAUMIER_CHECK(face.has_value(),
                  "{}:{}: {} has no face '{}' (expected face-00000 to face-{:05}, or a person's name)", file.string(),
                  rows[r].line, database.directory().string(), cells[0], database.num_faces() - 1);
    indices.push_back(*face);
    for (size_t c = 1; c < cells.size(); ++c)
      values.push_back(cells[c].empty() ? kUnlabelled : CsvNumber(rows[r], c, file.string()));
  }
  DAUMIER_CHECK(!indices.empty(), "{} has no faces below its header", file.string());
  labelled.labels = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), std::ssize(indices), std::ssize(labelled.names));
  labelled.codes = CodesOf(opened, database, indices, task);
  return labelled;
}

}  // namespace daumier::deform
