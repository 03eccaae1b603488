#include "faces/marked_forms.h"

#include "core/error.h"
#include "core/json.h"
#include "geometry/ply_rows.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <vector>

namespace daumier::faces {
namespace {

constexpr std::string_view kOpening = "[(", kClosing = "])", kWhite = " \t\r\n,;";

/// Without `array(` and the like in front, and without `, dtype=float32)` behind.
std::string_view WithoutCall(std::string_view text) {
  for (const std::string_view head : {"np.array(", "numpy.array(", "torch.tensor(", "array(", "tensor("}) {
    if (!text.starts_with(head)) continue;
    text.remove_prefix(head.size());
    const size_t last = text.find_last_of(']');
    return last == std::string_view::npos ? std::string_view() : text.substr(0, last + 1);
  }
  return text;
}

bool IsOf(std::string_view set, char c) {
  return set.find(c) != std::string_view::npos;
}

/// Text of the innermost brackets; nothing where brackets do not match or text other than numbers is there.
std::optional<std::vector<std::string>> InnermostRows(std::string_view text) {
  std::vector<std::string> rows;
  std::string open;  // Brackets that are open.
  std::string row;
  bool is_innermost = false;
  for (const char c : text) {
    if (IsOf(kOpening, c)) {
      open += c;
      row.clear();
      is_innermost = true;
    } else if (IsOf(kClosing, c)) {
      if (open.empty() || kOpening.find(open.back()) != kClosing.find(c)) return std::nullopt;
      open.pop_back();
      if (is_innermost) rows.push_back(row);
      is_innermost = false;
    } else if (open.empty() || !is_innermost) {
      if (!IsOf(kWhite, c)) return std::nullopt;
    } else {
      row += IsOf(kWhite, c) ? ' ' : c;
    }
  }
  if (!open.empty()) return std::nullopt;
  return rows;
}

/// Lines with their ends; LF, CR LF or CR.
std::vector<std::string_view> LinesOfTps(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    size_t end = std::min(text.find_first_of("\r\n"), text.size());
    end += text.substr(end).starts_with("\r\n") ? 2 : end < text.size();
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

/// The number behind LM= or LM3=; nothing for another line.
std::optional<size_t> CountOfTps(std::string_view line, const std::string& where) {
  std::string compact;
  for (const char c : line) {
    if (!std::isspace(static_cast<unsigned char>(c))) compact += char(std::toupper(static_cast<unsigned char>(c)));
  }
  const size_t begin = compact.starts_with("LM=") ? 3 : compact.starts_with("LM3=") ? 4 : 0;
  if (begin == 0) return std::nullopt;
  size_t count = 0;
  const auto [stop, error] = std::from_chars(compact.data() + begin, compact.data() + compact.size(), count);
  DAUMIER_CHECK(error == std::errc() && stop == compact.data() + compact.size(),
                "{}: '{}' is no number of landmarks (expected LM=68 or LM3=68)", where, compact);
  return count;
}

bool IsBlank(std::string_view line) {
  return line.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

}  // namespace

std::optional<std::string> RowsOfPrintedArray(std::string_view text) {
  const std::string_view array = WithoutCall(text);
  if (array.empty() || !IsOf(kOpening, array[0])) return std::nullopt;
  if (array.size() == text.size() && Json::accept(text)) return std::nullopt;
  const auto rows = InnermostRows(array);
  if (!rows) return std::nullopt;
  std::string result;
  for (const std::string& row : *rows) result += row + "\n";
  if (rows->size() > 1) return result;
  // One list: a number a row.
  for (char& c : result) c = c == ' ' ? '\n' : c;
  return result;
}

std::optional<std::string> RowsOfTps(std::string_view text, const std::string& name) {
  std::string rows;
  std::optional<size_t> stated;
  size_t num_rows = 0, number = 0;
  bool is_past = false;  // Behind the points.
  for (const std::string_view line : LinesOfTps(text)) {
    ++number;
    const std::string where = fmt::format("{}: line {}", name, number);
    const auto count = CountOfTps(line, where);
    if (!stated && !count && !IsBlank(line)) return std::nullopt;
    DAUMIER_CHECK(!stated || !count, "{}: a second specimen begins (expected one). Write a file for each mesh", where);
    const bool is_point = stated && !is_past && !count && !IsBlank(line) && line.find('=') == std::string_view::npos;
    if (count) stated = count;
    is_past = is_past || line.find('=') != std::string_view::npos;
    if (count) is_past = false;
    num_rows += is_point;
    rows += is_point ? std::string(line) : line.ends_with('\n') || line.ends_with('\r') ? "\n" : "";
  }
  if (!stated) return std::nullopt;
  DAUMIER_CHECK(num_rows == *stated, "{}: states {} landmarks, but {} rows follow. The file is cut or was edited", name,
                *stated, num_rows);
  return rows;
}

MarkedPoints ParseMarkedPly(std::string_view bytes, const std::filesystem::path& path) {
  constexpr uint64_t kMostPoints = 1000;
  const std::string name = path.string();
  const geometry::PlyHeader header = geometry::ParsePlyHeader(bytes, name);
  geometry::PlyRows rows(bytes.substr(header.num_bytes), header.format, name);
  MarkedPoints marked;
  for (const geometry::PlyElement& element : header.elements) {
    rows.Begin(element);
    if (element.name != "vertex") {
      for (uint64_t row = 0; row < element.count; ++row) {
        rows.NextRow();
        for (const auto& property : element.properties) rows.Skip(property);
      }
      continue;
    }
    DAUMIER_CHECK(element.count <= kMostPoints,
                  "{}: has {} vertices: a mesh, not its landmarks (expected a cloud of 68 points)", name,
                  element.count);
    const std::array axes = {element.Find("x"), element.Find("y"), element.Find("z")};
    DAUMIER_CHECK(axes[0] && axes[1] && axes[2], "{}: vertices without x, y and z", name);
    for (uint64_t row = 0; row < element.count; ++row) {
      rows.NextRow();
      geometry::Vector3 place = geometry::Vector3::Zero();
      for (size_t p = 0; p < element.properties.size(); ++p) {
        const auto axis = std::find(axes.begin(), axes.end(), std::optional(p)) - axes.begin();
        if (axis < 3 && !element.properties[p].count_type) {
          place[axis] = rows.Read(element.properties[p]);
        } else {
          rows.Skip(element.properties[p]);
        }
      }
      marked.points.push_back(place.allFinite() ? std::optional(place) : std::nullopt);
    }
    break;
  }
  return marked;
}

}  // namespace daumier::faces
