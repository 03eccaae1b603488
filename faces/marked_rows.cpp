#include "faces/marked_rows.h"

#include "core/error.h"
#include "faces/text_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

namespace daumier::faces {
namespace {

using TextRow = TextTable::Row;

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return lower;
}

bool IsAbsentCell(const std::string& cell) {
  static const std::set<std::string> kAbsent = {"",         "-",         "--",     "nan", "-nan",
                                                "nan(ind)", "-nan(ind)", "na",     "n/a", "null",
                                                "none",     "missing",   "absent", "?",   "*"};
  return kAbsent.count(LowerCase(cell)) > 0;
}

std::optional<double> NumberIn(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double number = 0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || stop != cell.data() + cell.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

bool IsText(const std::string& cell) {
  return !IsAbsentCell(cell) && !NumberIn(cell);
}

/// Which columns are what.
struct PointColumns {
  std::vector<int> coordinates;
  std::optional<int> label;
  bool is_numbered = false;  ///< The labels are numbers of the points.
};

/// The words of a column's name without those of units and the like: "Pos X (mm)" -> "x".
std::string CoreOfName(const std::string& name) {
  static const std::set<std::string> kNoise = {"mm",       "cm",    "m",          "px",    "pixel", "pixels", "pos",
                                               "position", "coord", "coordinate", "world", "3d",    "2d"};
  std::string core, word;
  const auto finish = [&] {
    if (!word.empty() && kNoise.count(word) == 0) core += core.empty() ? word : "_" + word;
    word.clear();
  };
  for (const char c : LowerCase(name)) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '#') {
      word += c;
    } else {
      finish();
    }
  }
  finish();
  return core;
}

/// The columns that a header names; nothing where it names no coordinates.
std::optional<PointColumns> ColumnsOfHeader(const std::vector<std::string>& names) {
  static const std::set<std::string> kVertex = {"vertex",   "vertex_index", "vertex_id",
                                                "vertexid", "vertexindex",  "vid"};
  static const std::set<std::string> kName = {"label", "name"};
  static const std::set<std::string> kNumber = {
      "id", "index", "idx", "nr", "no", "number",      "landmark",       "landmarks",
      "lm", "point", "#",   "i",  "n",  "landmark_id", "landmark_index", "point_id"};
  std::array<std::optional<int>, 3> axes;
  std::optional<int> vertex, name, number;
  for (int c = 0; c < static_cast<int>(names.size()); ++c) {
    const std::string core = CoreOfName(names[c]);
    if (core.size() == 1 && core[0] >= 'x' && core[0] <= 'z' && !axes[core[0] - 'x']) axes[core[0] - 'x'] = c;
    if (kVertex.count(core) && !vertex) vertex = c;
    if (kName.count(core) && !name) name = c;
    if (kNumber.count(core) && !number) number = c;
  }
  PointColumns columns;
  columns.label = name ? name : number;
  if (axes[0] && axes[1]) {
    for (const auto& axis : axes) {
      if (axis) columns.coordinates.push_back(*axis);
    }
  } else if (vertex) {
    columns.coordinates = {*vertex};
  } else if (number && names.size() == 1) {
    columns = {{*number}, std::nullopt};
  } else {
    return std::nullopt;
  }
  return columns;
}

/// Whether a column counts its rows: integers that ascend by one from 0 or 1, or with gaps within 0 .. 68.
bool Counts(const std::vector<TextRow>& rows, size_t column) {
  constexpr double kMostLandmarks = 68;
  constexpr size_t kFewestWithGaps = 6;
  std::optional<double> first, last;
  bool is_dense = true;
  for (const TextRow& row : rows) {
    const auto number = column < row.cells.size() ? NumberIn(row.cells[column]) : std::nullopt;
    if (!number || *number < 0 || *number != std::floor(*number) || (last && *number <= *last)) return false;
    is_dense = is_dense && (last ? *number == *last + 1 : *number <= 1);
    if (!first) first = number;
    last = number;
  }
  return rows.size() > 1 && (is_dense || (rows.size() >= kFewestWithGaps && *last <= kMostLandmarks));
}

/// Whether a column in front of x y z can be numbers of the points in any order.
bool AreDistinctIntegers(const std::vector<TextRow>& rows, size_t column) {
  std::set<double> numbers;
  for (const TextRow& row : rows) {
    const auto number = NumberIn(row.cells[column]);
    if (!number || *number < 0 || *number != std::floor(*number)) return false;
    numbers.insert(*number);
  }
  return numbers.size() == rows.size();
}

/// Rows of the most frequent number of cells.
std::vector<TextRow> UsualRows(const std::vector<TextRow>& rows) {
  std::map<size_t, size_t> num_rows;
  for (const TextRow& row : rows) ++num_rows[row.cells.size()];
  size_t usual = 0;
  for (const auto& [size, count] : num_rows) {
    if (usual == 0 || count >= num_rows[usual]) usual = size;
  }
  std::vector<TextRow> result;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(result),
               [&](const TextRow& row) { return row.cells.size() == usual; });
  return result;
}

/// The columns of rows without a header; nothing where the numbers are no points.
std::optional<PointColumns> ColumnsOfRows(const std::vector<TextRow>& rows) {
  const std::vector<TextRow> usual = UsualRows(rows);
  PointColumns columns;
  std::vector<int> numeric;
  for (int c = 0; c < static_cast<int>(usual.front().cells.size()); ++c) {
    const auto in_column = [&](auto is_so) {
      return std::count_if(usual.begin(), usual.end(), [&](const TextRow& row) { return is_so(row.cells[size_t(c)]); });
    };
    const auto num_texts = in_column(IsText), num_absent = in_column(IsAbsentCell);
    const auto num_numbers = static_cast<std::ptrdiff_t>(usual.size()) - num_texts - num_absent;
    if (num_texts > num_numbers && !columns.label) columns.label = c;
    if (num_numbers > 0 && num_numbers >= num_texts) numeric.push_back(c);
  }
  const bool is_full = numeric.size() == 4 && AreDistinctIntegers(usual, size_t(numeric[0]));
  if (is_full || (numeric.size() > 1 && Counts(rows, size_t(numeric[0])))) {
    if (!columns.label) columns.label = numeric[0];
    columns.is_numbered = columns.label == numeric[0];
    numeric.erase(numeric.begin());
  }
  if (numeric.empty() || numeric.size() > 3) return std::nullopt;
  columns.coordinates = numeric;
  return columns;
}

/// @throws Error if a cell is a number beyond the range of numbers, or infinite: no name of a point.
void CheckFinite(const std::vector<TextRow>& rows, const std::string& name) {
  for (const TextRow& row : rows) {
    for (const std::string& cell : row.cells) {
      const std::string_view digits = std::string_view(cell).substr(cell.starts_with('+'));
      double number = 0;
      const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
      const bool is_whole = !digits.empty() && stop == digits.data() + digits.size();
      DAUMIER_CHECK(!is_whole || (error == std::errc() && !std::isinf(number)) || NumberIn(cell),
                    "{}: line {}: '{}' is not a finite number", name, row.line, cell);
    }
  }
}

bool HasNumber(const TextRow& row) {
  return std::any_of(row.cells.begin(), row.cells.end(), [](const std::string& cell) { return NumberIn(cell); });
}
bool HasText(const TextRow& row) {
  return std::any_of(row.cells.begin(), row.cells.end(), IsText);
}

/// Removes a first row that is the number of points, alone or with that of coordinates. @throws Error if another
/// number of rows follows.
void RemoveCount(std::vector<TextRow>& rows, const std::string& name) {
  if (rows.size() < 3 || Counts(rows, 0)) return;
  const auto num_points = double(rows.size() - 1);
  const size_t width = rows.front().cells.size(), next = rows[1].cells.size();
  const auto count = NumberIn(rows.front().cells.front());
  if (!count || width > 2) return;
  if (width == 1 && next > 1 && next <= 5) {
    DAUMIER_CHECK(*count == num_points,
                  "{}: line {}: states {} points, but {} rows follow. The file is cut or was edited", name,
                  rows.front().line, rows.front().cells.front(), rows.size() - 1);
    rows.erase(rows.begin());
  } else if (*count == num_points && width == 2 && NumberIn(rows.front().cells[1]) == double(next)) {
    rows.erase(rows.begin());
  } else if (*count == num_points && width == 1 && next == 1 && (num_points == 68 || num_points == 51)) {
    rows.erase(rows.begin());  // Of vertices.
  }
}

/// All numbers, in order. @throws Error naming the first cell that is none.
MarkedPoints AllNumbers(const std::vector<TextRow>& rows, const std::string& name) {
  MarkedPoints marked{.dimension = 1};
  for (const TextRow& row : rows) {
    for (const std::string& cell : row.cells) {
      if (const auto number = NumberIn(cell)) {
        marked.points.emplace_back(geometry::Vector3(*number, 0, 0));
      } else {
        DAUMIER_CHECK(IsAbsentCell(cell), "{}: line {}: '{}' is not a number", name, row.line, cell);
        marked.points.emplace_back();
      }
    }
  }
  return marked;
}

MarkedPoints PointsIn(const std::vector<TextRow>& rows, const PointColumns& columns, const std::string& name) {
  MarkedPoints marked{.dimension = static_cast<int>(columns.coordinates.size())};
  for (const TextRow& row : rows) {
    geometry::Vector3 place = geometry::Vector3::Zero();
    bool is_there = true, has_number = false;
    for (int axis = 0; axis < marked.dimension; ++axis) {
      const size_t column = size_t(columns.coordinates[size_t(axis)]);
      DAUMIER_CHECK(column < row.cells.size() || !has_number,
                    "{}: line {}: {} cells, expected {} or more: a coordinate is missing", name, row.line,
                    row.cells.size(), column + 1);
      const std::string cell = column < row.cells.size() ? row.cells[column] : std::string();
      const auto number = NumberIn(cell);
      DAUMIER_CHECK(number || IsAbsentCell(cell), "{}: line {}: '{}' is not a number", name, row.line, cell);
      is_there = is_there && number;
      has_number = has_number || number;
      if (number) place[axis] = *number;
    }
    marked.points.push_back(is_there ? std::optional(place) : std::nullopt);
    if (columns.label)
      marked.labels.push_back(size_t(*columns.label) < row.cells.size() ? row.cells[size_t(*columns.label)] : "");
  }
  return marked;
}

/// The value of `key = value`, `key: value` or `key=value` in a remark.
std::optional<std::string> RemarkOf(const TextTable& table, std::string_view key) {
  for (const std::string& remark : table.remarks) {
    const std::string lower = LowerCase(remark);
    if (!lower.starts_with(key)) continue;
    const size_t sign = lower.find_first_not_of(" \t", key.size());
    if (sign == std::string::npos || (lower[sign] != '=' && lower[sign] != ':')) continue;
    const size_t begin = lower.find_first_not_of(" \t", sign + 1);
    return begin == std::string::npos ? std::string() : lower.substr(begin);
  }
  return std::nullopt;
}

/// PointColumns of Slicer's .fcsv, in a comment.
std::optional<PointColumns> ColumnsOfRemark(const TextTable& table) {
  const auto names = RemarkOf(table, "columns");
  if (!names) return std::nullopt;
  std::vector<std::string> cells;
  for (size_t begin = 0; begin <= names->size();) {
    const size_t end = std::min(names->find(',', begin), names->size());
    cells.push_back(names->substr(begin, end - begin));
    begin = end + 1;
  }
  return ColumnsOfHeader(cells);
}

std::optional<PatientFrame> FrameOfRemark(const TextTable& table) {
  const auto frame = RemarkOf(table, "coordinatesystem");
  if (!frame) return std::nullopt;
  if (*frame == "lps" || *frame == "1") return PatientFrame::kLps;
  if (*frame == "ras" || *frame == "0") return PatientFrame::kRas;
  return std::nullopt;
}

}  // namespace

MarkedPoints ParseMarkedRows(std::string_view text, const std::filesystem::path& path) {
  const std::string name = path.string();
  TextTable table = ReadTextTable(text, name);
  std::vector<TextRow>& rows = table.rows;
  DAUMIER_CHECK(!rows.empty(), "{}: holds no point", name);
  CheckFinite(rows, name);
  std::optional<PointColumns> columns = ColumnsOfRemark(table);
  const auto frame = FrameOfRemark(table);
  // Slicer 4.11 and later write no names of columns.
  if (!columns && frame && table.is_delimited)
    columns = PointColumns{{1, 2, 3}, rows.front().cells.size() > 11 ? 11 : 0};
  if (rows.size() > 1 && !HasNumber(rows[0]) && HasText(rows[0]) && HasNumber(rows[1])) {
    if (!columns) columns = ColumnsOfHeader(rows[0].cells);
    rows.erase(rows.begin());
  }
  RemoveCount(rows, name);
  if (!columns) {
    const bool is_one_row = rows.size() == 1 && rows[0].cells.size() > 4;
    columns = is_one_row ? std::nullopt : ColumnsOfRows(rows);
    const size_t width = UsualRows(rows).front().cells.size();
    const auto is_ragged = [&](const TextRow& row) {
      if (table.is_delimited || row.cells.size() == width) return false;
      const bool is_absent = row.cells.size() == 1 && IsAbsentCell(row.cells[0]);
      return !is_absent && !(columns && columns->is_numbered && row.cells.size() == 1);
    };
    const auto ragged = std::find_if(rows.begin(), rows.end(), is_ragged);
    if (!columns || ragged != rows.end()) {
      DAUMIER_CHECK(ragged == rows.end() || std::none_of(rows.begin(), rows.end(), HasText) || !columns ||
                        !columns->label || columns->is_numbered,
                    "{}: line {}: {} cells, the other rows have {}", name, ragged->line, ragged->cells.size(), width);
      return AllNumbers(rows, name);
    }
  }
  MarkedPoints marked = PointsIn(rows, *columns, name);
  marked.frame = frame;
  for (const std::string_view key : {"n_points", "numberofpoints", "num_points"}) {
    const auto stated = RemarkOf(table, key);
    DAUMIER_CHECK(!stated || NumberIn(*stated) == double(marked.points.size()),
                  "{}: states {}: {}, but {} points follow. The file is cut or was edited", name, key,
                  stated.value_or(""), marked.points.size());
  }
  return marked;
}

}  // namespace daumier::faces
