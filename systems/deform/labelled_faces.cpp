#include "systems/deform/labelled_faces.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "eval/mesh_score.h"
#include "fitting/mesh_code.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <vector>

namespace daumier::deform {
namespace {

constexpr double kUnlabelled = std::numeric_limits<double>::quiet_NaN();
/// Of the fit of a code to each of many faces.
constexpr int kPointsOfLabelledFace = 500;

void CheckTopology(const fitting::CodeModel& model, const faces::FaceDatabase& database) {
  DAUMIER_CHECK(database.num_vertices() == model.face_template().num_vertices(),
                "{}: faces of {} vertices, but the model has {}: name faces of the model's topology",
                database.directory().string(), database.num_vertices(), model.face_template().num_vertices());
}

Eigen::MatrixXd CodesOf(const fitting::CodeModel& model, const faces::FaceDatabase& database,
                        const std::vector<int>& indices, const Task& task) {
  Eigen::MatrixXd codes(std::ssize(indices), model.num_numbers());
  for (size_t i = 0; i < indices.size(); ++i) {
    task.ThrowIfCancelled("the codes of labelled faces were stopped after {} faces", i);
    codes.row(Eigen::Index(i)) =
        fitting::CodeOfMesh(model, database.points(indices[i]), {.num_points = kPointsOfLabelledFace}).code.transpose();
    task.Report(int64_t(i) + 1, std::ssize(indices), "faces");
  }
  return codes;
}

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    while (!cell.empty() && (cell.back() == '\r' || cell.back() == ' ')) cell.pop_back();
    cells.push_back(cell);
  }
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

}  // namespace

fitting::LabelledCodes LabelledFaces(const fitting::CodeModel& model, const faces::FaceDatabase& database, int most,
                                     const Task& task) {
  CheckTopology(model, database);
  std::vector<int> all(size_t(database.num_grid_faces()));
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> chosen = EvenlySpaced(all, most);
  fitting::LabelledCodes labelled;
  labelled.names = database.control_names();
  const Eigen::Index num_controls = std::ssize(labelled.names);
  for (int e = 1; e < database.num_expressions(); ++e) labelled.names.push_back(database.expression_names()[size_t(e)]);
  const bool has_levels = database.num_levels() > 1;
  if (has_levels) labelled.names.emplace_back(kCaricatureLabel);
  labelled.labels = Eigen::MatrixXd::Constant(std::ssize(chosen), std::ssize(labelled.names), kUnlabelled);
  for (size_t i = 0; i < chosen.size(); ++i) {
    const faces::FaceId id = database.id(chosen[i]);
    auto row = labelled.labels.row(Eigen::Index(i));
    if (num_controls > 0) {
      const std::span<const float> values = database.control_values(id.person, id.level);
      for (Eigen::Index c = 0; c < num_controls; ++c) row[c] = values.empty() ? 0.0 : double(values[size_t(c)]);
    }
    if (id.expression == 0) {
      row.segment(num_controls, database.num_expressions() - 1).setZero();
    } else {
      row[num_controls + id.expression - 1] = 1;
    }
    if (has_levels) row[row.size() - 1] = id.level > 0 ? 1 : 0;
  }
  labelled.codes = CodesOf(model, database, chosen, task);
  return labelled;
}

fitting::LabelledCodes LabelledByFile(const fitting::CodeModel& model, const faces::FaceDatabase& database,
                                      const std::filesystem::path& file, const Task& task) {
  CheckTopology(model, database);
  std::istringstream lines(ReadFile(file));
  std::string line;
  fitting::LabelledCodes labelled;
  DAUMIER_CHECK(std::getline(lines, line), "{} is empty (expected a header name,LABEL,...)", file.string());
  const std::vector<std::string> header = Cells(line);
  DAUMIER_CHECK(header.size() >= 2, "{}:1: a header of {} columns, expected name,LABEL,...", file.string(),
                header.size());
  labelled.names.assign(header.begin() + 1, header.end());
  std::vector<int> indices;
  std::vector<double> values;
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> cells = Cells(line);
    if (cells.empty() || (cells.size() == 1 && cells[0].empty())) continue;
    DAUMIER_CHECK(cells.size() == header.size(), "{}:{}: {} columns, expected {}", file.string(), number, cells.size(),
                  header.size());
    const std::optional<int> face = eval::FaceNamed(database, cells[0]);
    DAUMIER_CHECK(face.has_value(),
                  "{}:{}: {} has no face '{}' (expected face-00000 to face-{:05}, or a person's name)", file.string(),
                  number, database.directory().string(), cells[0], database.num_faces() - 1);
    indices.push_back(*face);
    for (size_t c = 1; c < cells.size(); ++c) {
      double value = kUnlabelled;
      if (!cells[c].empty()) {
        const auto [end, error] = std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), value);
        DAUMIER_CHECK(error == std::errc() && end == cells[c].data() + cells[c].size(), "{}:{}: '{}' is no number",
                      file.string(), number, cells[c]);
      }
      values.push_back(value);
    }
  }
  DAUMIER_CHECK(!indices.empty(), "{} has no faces below its header", file.string());
  labelled.labels = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), std::ssize(indices), std::ssize(labelled.names));
  labelled.codes = CodesOf(model, database, indices, task);
  return labelled;
}

}  // namespace daumier::deform
