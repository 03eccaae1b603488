#include "geometry/obj.h"

#include "core/error.h"
#include "core/files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace daumier::geometry {
namespace {

/// Walks over the lines of a text; messages name the current one.
class LineReader {
 public:
  LineReader(std::string_view text, std::string_view name)
      : name_(name), next_(text.data()), end_(text.data() + text.size()) {}

  /// Moves to the next line; false after the last.
  bool Next() {
    if (next_ == end_) return false;
    ++number_;
    position_ = next_;
    const void* newline = std::memchr(next_, '\n', end_ - next_);
    is_cut_ = newline == nullptr;
    line_end_ = is_cut_ ? end_ : static_cast<const char*>(newline);
    next_ = is_cut_ ? end_ : line_end_ + 1;
    if (line_end_ > position_ && line_end_[-1] == '\r') --line_end_;
    return true;
  }

  /// Whether the line is `keyword` followed by a blank; moves behind it.
  bool Accept(char keyword) {
    if (line_end_ - position_ < 2 || position_[0] != keyword || (position_[1] != ' ' && position_[1] != '\t'))
      return false;
    position_ += 2;
    Check(!is_cut_, "the last line has no line end: the file is cut");
    return true;
  }

  bool AtEnd() {
    while (position_ != line_end_ && (*position_ == ' ' || *position_ == '\t')) ++position_;
    return position_ == line_end_ || *position_ == '#';
  }

  bool Skip(char c) {
    if (position_ == line_end_ || *position_ != c) return false;
    ++position_;
    return true;
  }

  template <class Number>
  Number Read(const char* what) {
    if (position_ != line_end_ && *position_ == '+') ++position_;
    Number value{};
    const auto [end, error] = std::from_chars(position_, line_end_, value);
    Check(error == std::errc(), what);
    position_ = end;
    return value;
  }

  void Check(bool condition, const char* cause) const { DAUMIER_CHECK(condition, "{}:{}: {}", name_, number_, cause); }

  std::string_view name() const { return name_; }

 private:
  std::string_view name_;
  const char* next_;
  const char* end_;
  const char* position_ = nullptr;
  const char* line_end_ = nullptr;
  int number_ = 0;
  bool is_cut_ = false;
};

/// The three coordinates behind a `v`. What may follow (a weight or a colour) is passed over.
void ReadVertex(LineReader& line, double* out) {
  for (int k = 0; k < 3; ++k) {
    line.Check(!line.AtEnd(), "a vertex needs three coordinates");
    out[k] = line.Read<double>("a coordinate is not a number");
    line.Check(std::isfinite(out[k]), "a coordinate is not finite");
  }
}

/// 0-based vertex of the corner that comes next: v, v/vt, v//vn or v/vt/vn, told by `form` (0, 1, 2, 3).
int ReadCorner(LineReader& line, int num_vertices, int& form) {
  const int index = line.Read<int>("a corner is not a vertex number");
  form = 0;
  if (line.Skip('/')) {
    if (line.Skip('/')) {
      form = 2;
      line.Read<int>("a corner is not of the form v//vn");
    } else {
      form = 1;
      line.Read<int>("a corner is not of the form v/vt");
      if (line.Skip('/')) {
        form = 3;
        line.Read<int>("a corner is not of the form v/vt/vn");
      }
    }
  }
  const int vertex = index > 0 ? index - 1 : num_vertices + index;
  line.Check(index != 0 && vertex >= 0, "a corner is not a vertex number");
  return vertex;
}

void ReadPolygon(LineReader& line, int num_vertices, PolygonMesh& mesh) {
  const size_t first = mesh.corners.size();
  int first_form = -1;
  while (!line.AtEnd()) {
    int form = 0;
    const int vertex = ReadCorner(line, num_vertices, form);
    line.Check(first_form == -1 || form == first_form, "corners of different forms in one polygon");
    line.Check(std::find(mesh.corners.begin() + first, mesh.corners.end(), vertex) == mesh.corners.end(),
               "a vertex comes twice in one polygon");
    first_form = form;
    mesh.corners.push_back(vertex);
  }
  line.Check(mesh.corners.size() - first >= 3, "a polygon needs three corners");
  mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
}

}  // namespace

PolygonMesh ParseObj(std::string_view text, std::string_view name) {
  LineReader line(text, name);
  std::vector<double> coordinates;
  coordinates.reserve(text.size() / 32);
  PolygonMesh mesh;
  mesh.corners.reserve(text.size() / 32);
  while (line.Next()) {
    if (line.Accept('v')) {
      coordinates.resize(coordinates.size() + 3);
      ReadVertex(line, coordinates.data() + coordinates.size() - 3);
    } else if (line.Accept('f')) {
      ReadPolygon(line, static_cast<int>(coordinates.size() / 3), mesh);
    }
  }
  const int num_vertices = static_cast<int>(coordinates.size() / 3);
  DAUMIER_CHECK(num_vertices > 0, "{}: no vertex; is this an OBJ file?", name);
  DAUMIER_CHECK(mesh.num_polygons() > 0, "{}: {} vertices but no polygon: the file is cut", name, num_vertices);
  const int highest = *std::max_element(mesh.corners.begin(), mesh.corners.end());
  DAUMIER_CHECK(highest < num_vertices, "{}: a polygon uses vertex {} of {}: the file is cut", name, highest + 1,
                num_vertices);
  mesh.vertices = Eigen::Map<const Points>(coordinates.data(), num_vertices, 3);
  return mesh;
}

PolygonMesh ReadObj(const std::filesystem::path& path) {
  return ParseObj(ReadFile(path), path.string());
}

Points ParseObjVertices(std::string_view text, std::string_view name, int expected_count) {
  LineReader line(text, name);
  Points points(expected_count, 3);
  int count = 0;
  while (line.Next()) {
    if (!line.Accept('v')) continue;
    if (count < expected_count) ReadVertex(line, points.row(count).data());
    ++count;
  }
  DAUMIER_CHECK(count == expected_count, "{}: {} vertices, expected {}", name, count, expected_count);
  return points;
}

void WriteObj(const std::filesystem::path& path, const TriangleMesh& mesh) {
  std::string text;
  for (const auto& p : mesh.vertices.rowwise()) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles.rowwise()) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  WriteFileAtomically(path, text);
}

}  // namespace daumier::geometry
