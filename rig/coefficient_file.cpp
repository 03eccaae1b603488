#include "rig/coefficient_file.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/import/npy.h"
#include "faces/text_table.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace daumier::rig {
namespace {

using CoefficientRows = std::vector<std::vector<float>>;

std::optional<double> FiniteNumber(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double number = 0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || stop != cell.data() + cell.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// Rows in the order of the expressions, of which the constant one may be missing.
Eigen::MatrixXf MatrixOfRows(const CoefficientRows& rows, const std::string& name, const ExpressionMap& map) {
  const auto num_expressions = size_t(map.num_expressions());
  DAUMIER_CHECK(!rows.empty(), "{}: contains no frame (expected a row of {} coefficients a frame)", name,
                num_expressions);
  Eigen::MatrixXf matrix(std::ssize(rows), Eigen::Index(num_expressions));
  for (size_t r = 0; r < rows.size(); ++r) {
    const bool is_without_constant = map.constant && rows[r].size() + 1 == num_expressions;
    DAUMIER_CHECK(rows[r].size() == num_expressions || is_without_constant,
                  "{}: frame {} has {} coefficients, the model {} ({} .. {}). Name the columns in the first line of a "
                  "CSV, or fill the rows with zeros",
                  name, r, rows[r].size(), num_expressions, map.expressions.front(), map.expressions.back());
    auto next = rows[r].begin();
    for (int e = 0; e < map.num_expressions(); ++e)
      matrix(Eigen::Index(r), e) = is_without_constant && e == *map.constant ? 1.0f : *next++;
  }
  DAUMIER_CHECK(matrix.allFinite(), "{}: a coefficient is not finite. Remove its frame", name);
  return matrix;
}

CoefficientFrames ParseJsonFrames(std::string_view text, const std::string& name, const ExpressionMap& map) {
  CoefficientRows rows;
  try {
    rows = ParseJson(text, name).get<CoefficientRows>();
  } catch (const Json::exception&) {
    throw Error(
        fmt::format("{}: is no list of frames (expected [[c, c, ...], [c, c, ...], ...], a list of {} numbers a "
                    "frame)",
                    name, map.num_expressions()));
  }
  return {MatrixOfRows(rows, name, map)};
}

double CellAt(const faces::TextTable::Row& row, size_t column, const std::string& name) {
  const auto number = FiniteNumber(row.cells[column]);
  DAUMIER_CHECK(number, "{}: line {}: column {}: '{}' is no finite number. Correct the cell, or remove the row", name,
                row.line, column + 1, row.cells[column]);
  return *number;
}

/// What the columns of a table with a header are.
struct CoefficientColumns {
  std::optional<size_t> time;
  std::map<size_t, int> expressions = {};
};

CoefficientColumns ColumnsOfHeader(const faces::TextTable::Row& header, const std::string& name,
                                   const ExpressionMap& map) {
  CoefficientColumns columns;
  std::vector<bool> is_found(map.expressions.size(), false);
  for (size_t c = 0; c < header.cells.size(); ++c) {
    const std::string& cell = header.cells[c];
    if (cell == "time" || cell == "t" || cell == "seconds") {
      columns.time = c;
    } else if (cell != "frame" && !cell.empty()) {
      const auto found = std::ranges::find(map.expressions, cell);
      DAUMIER_CHECK(
          found != map.expressions.end(),
          "{}: line {}: '{}' is no expression of the model (expected {} .. {}, time or frame). Rename or remove "
          "the column",
          name, header.line, cell, map.expressions.front(), map.expressions.back());
      const auto e = size_t(found - map.expressions.begin());
      DAUMIER_CHECK(!is_found[e], "{}: line {}: two columns are named '{}'. Remove one of them", name, header.line,
                    cell);
      is_found[e] = true;
      columns.expressions.emplace(c, int(e));
    }
  }
  DAUMIER_CHECK(!columns.expressions.empty(), "{}: line {}: no column is an expression of the model ({} .. {})", name,
                header.line, map.expressions.front(), map.expressions.back());
  return columns;
}

/// A row of names: one of them is known, or none is a number.
bool IsHeader(const faces::TextTable::Row& row, const ExpressionMap& map) {
  return std::ranges::any_of(row.cells,
                             [&](const std::string& cell) {
                               return cell == "time" || cell == "frame" ||
                                      std::ranges::find(map.expressions, cell) != map.expressions.end();
                             }) ||
         std::ranges::none_of(row.cells, [](const std::string& cell) { return FiniteNumber(cell).has_value(); });
}

CoefficientFrames FramesBelowHeader(const faces::TextTable& table, const std::string& name, const ExpressionMap& map) {
  const CoefficientColumns columns = ColumnsOfHeader(table.rows.front(), name, map);
  DAUMIER_CHECK(table.rows.size() > 1, "{}: contains no frame below its header", name);
  CoefficientFrames frames{Eigen::MatrixXf::Zero(std::ssize(table.rows) - 1, map.num_expressions())};
  bool has_constant = false;
  for (const auto& [column, e] : columns.expressions) has_constant = has_constant || e == map.constant;
  if (map.constant && !has_constant) frames.coefficients.col(*map.constant).setOnes();
  for (size_t r = 1; r < table.rows.size(); ++r) {
    const faces::TextTable::Row& row = table.rows[r];
    DAUMIER_CHECK(row.cells.size() == table.rows.front().cells.size(),
                  "{}: line {}: {} cells, expected {} as in the header. Remove the row", name, row.line,
                  row.cells.size(), table.rows.front().cells.size());
    for (const auto& [column, e] : columns.expressions)
      frames.coefficients(Eigen::Index(r) - 1, e) = float(CellAt(row, column, name));
    if (!columns.time) continue;
    const double time = CellAt(row, *columns.time, name);
    DAUMIER_CHECK(frames.seconds.empty() || time > frames.seconds.back(),
                  "{}: line {}: the time {} is not after that of the row above. Remove the row", name, row.line, time);
    frames.seconds.push_back(time);
  }
  const auto num_missing =
      std::ssize(map.expressions) - std::ssize(columns.expressions) - (map.constant && !has_constant ? 1 : 0);
  if (num_missing > 0)
    frames.warnings.push_back(
        fmt::format("{} of {} expressions have no column and are 0", num_missing, map.num_expressions()));
  return frames;
}

}  // namespace

CoefficientFrames ParseCoefficients(std::string_view text, const std::string& name, const ExpressionMap& map) {
  const size_t begin = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (begin != std::string_view::npos && (text[begin] == '[' || text[begin] == '{'))
    return ParseJsonFrames(text.substr(begin), name, map);
  const faces::TextTable table = faces::ReadTextTable(text, name);
  DAUMIER_CHECK(!table.rows.empty(), "{}: is empty (expected a row of {} coefficients a frame)", name,
                map.num_expressions());
  if (IsHeader(table.rows.front(), map)) return FramesBelowHeader(table, name, map);
  CoefficientRows rows;
  for (const faces::TextTable::Row& row : table.rows) {
    std::vector<float>& numbers = rows.emplace_back();
    for (size_t c = 0; c < row.cells.size(); ++c) numbers.push_back(float(CellAt(row, c, name)));
  }
  return {MatrixOfRows(rows, name, map)};
}

CoefficientFrames ReadCoefficients(const std::filesystem::path& file, const ExpressionMap& map) {
  if (file.extension() != ".npy") return ParseCoefficients(ReadFile(file), file.string(), map);
  const faces::NumberArray array = faces::ParseNpy(ReadFile(file), file.string());
  const auto& shape = array.shape();
  DAUMIER_CHECK(shape.size() == 2 && shape[0] > 0, "{}: has the shape ({}), expected (frames, {})", file.string(),
                fmt::join(shape, ", "), map.num_expressions());
  const Eigen::MatrixXf values = array.Matrix(shape[0], shape[1]);
  CoefficientRows rows;
  for (Eigen::Index r = 0; r < values.rows(); ++r) {
    const Eigen::RowVectorXf row = values.row(r);
    rows.emplace_back(row.data(), row.data() + row.size());
  }
  return {MatrixOfRows(rows, file.string(), map)};
}

}  // namespace daumier::rig
