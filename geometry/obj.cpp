#include "geometry/obj.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/corner_uv.h"
#include "geometry/obj_lines.h"
#include "geometry/polygon_collector.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace daumier::geometry {
namespace {

/// The three coordinates behind a `v`. What may follow (a weight or a colour) is skipped.
void ReadVertex(ObjLines& line, double* out) {
  for (int k = 0; k < 3; ++k) {
    line.Check(!line.AtEnd(), "a vertex needs three coordinates");
    out[k] = line.ReadNumber("a coordinate is not a number");
  }
}

/// u and v behind a `vt`; v is 0 where it is absent. A third coordinate is skipped.
void ReadUv(ObjLines& line, double* out) {
  line.Check(!line.AtEnd(), "a texture coordinate needs a number");
  out[0] = line.ReadNumber("a texture coordinate is not a number");
  out[1] = line.AtEnd() ? 0.0 : line.ReadNumber("a texture coordinate is not a number");
}

/// Row of a table of `count` rows so far from OBJ's index, which counts from 1, or back from -1. -1 if there is none.
int RowOf(int index, int count) {
  return index > 0 ? index - 1 : index < 0 ? std::max(-1, count + index) : -1;
}

/// Vertex and row of UV of a corner.
struct Corner {
  int vertex;
  int uv;
};

/// The corner that comes next: v, v/vt, v//vn or v/vt/vn; vt and vn may be empty.
Corner ReadCorner(ObjLines& line, int num_vertices, int num_uv) {
  Corner corner{RowOf(line.ReadIndex("a corner is not a vertex number"), num_vertices), PolygonCollector::kNoUv};
  line.Check(corner.vertex >= 0, "a corner is not a vertex number");
  if (!line.Skip('/')) {
    line.Check(line.AtWordEnd(), "a corner is not a vertex number");
    return corner;
  }
  if (!line.AtWordEnd() && !line.Skip('/')) {
    const int index = line.ReadIndex("a corner is not of the form v/vt");
    corner.uv = RowOf(index, num_uv);
    line.Check(corner.uv >= 0 || index == 0 || num_uv == 0, "a corner is not of the form v/vt: there is no such vt");
    if (line.AtWordEnd()) return corner;
    line.Check(line.Skip('/'), "a corner is not of the form v/vt");
  }
  if (!line.AtWordEnd()) line.ReadIndex("a corner is not of the form v/vt/vn");
  line.Check(line.AtWordEnd(), "a corner is not of the form v/vt/vn");
  return corner;
}

/// Vertices and UV of the corners of one polygon; kept between polygons to spare allocations.
struct Polygon {
  std::vector<int> corners, uv_corners;
};

/// A cut text may end amid its last polygon; elsewhere one of fewer than three corners is left to the collector.
void ReadPolygon(ObjLines& line, int num_vertices, int num_uv, Polygon& polygon) {
  polygon.corners.clear();
  polygon.uv_corners.clear();
  while (!line.AtEnd()) {
    const Corner corner = ReadCorner(line, num_vertices, num_uv);
    polygon.corners.push_back(corner.vertex);
    polygon.uv_corners.push_back(corner.uv);
  }
  line.Check(polygon.corners.size() >= 3 || !line.IsOpen(), "a polygon needs three corners: the file is cut");
}

/// Whether the line is an element that is no polygon: points, a line, a curve or a surface.
bool AcceptOtherElement(ObjLines& line) {
  constexpr std::array<std::string_view, 5> kKeywords = {"p", "l", "curv", "curv2", "surf"};
  return std::any_of(kKeywords.begin(), kKeywords.end(),
                     [&](std::string_view keyword) { return line.Accept(keyword); });
}

/// `v` and `vt` lines.
std::string VertexLines(const Points& vertices, const TextureCoordinates& uv) {
  std::string text;
  for (const auto& p : vertices.rowwise()) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : uv.rowwise()) text += fmt::format("vt {} {}\n", t.x(), t.y());
  return text;
}

/// An `f` line; `uv_corners` is null without UV.
void AppendPolygon(const int* corners, const int* uv_corners, int size, std::string& text) {
  text += 'f';
  const auto out = std::back_inserter(text);
  for (int k = 0; k < size; ++k) {
    fmt::format_to(out, " {}", corners[k] + 1);
    if (uv_corners != nullptr) fmt::format_to(out, "/{}", uv_corners[k] + 1);
  }
  text += '\n';
}

}  // namespace

PolygonMesh ParseObj(std::string_view text, std::string_view name) {
  ObjLines line(text, name);
  std::vector<double> coordinates, uv_coordinates;
  coordinates.reserve(text.size() / 32);
  const auto num_vertices = [&] { return static_cast<int>(coordinates.size() / 3); };
  const auto num_uv = [&] { return static_cast<int>(uv_coordinates.size() / 2); };
  PolygonCollector collector;
  Polygon polygon;
  int highest = -1, highest_uv = -1, num_polygons = 0, num_others = 0;
  while (line.Next()) {
    if (line.Accept("v")) {
      coordinates.resize(coordinates.size() + 3);
      ReadVertex(line, coordinates.data() + coordinates.size() - 3);
    } else if (line.Accept("vt")) {
      uv_coordinates.resize(uv_coordinates.size() + 2);
      ReadUv(line, uv_coordinates.data() + uv_coordinates.size() - 2);
    } else if (line.Accept("f") || line.Accept("fo")) {
      ReadPolygon(line, num_vertices(), num_uv(), polygon);
      for (const int v : polygon.corners) highest = std::max(highest, v);
      for (const int t : polygon.uv_corners) highest_uv = std::max(highest_uv, t);
      collector.Add(polygon.corners, polygon.uv_corners);
      ++num_polygons;
    } else if (AcceptOtherElement(line)) {
      ++num_others;
    }
  }
  DAUMIER_CHECK(num_vertices() > 0, "{}: no vertex; is this an OBJ file?", name);
  DAUMIER_CHECK(highest < num_vertices(), "{}: a polygon uses vertex {} of {}: the file is cut", name, highest + 1,
                num_vertices());
  DAUMIER_CHECK(num_uv() == 0 || highest_uv < num_uv(),
                "{}: a polygon uses texture coordinate {} of {}: the file is cut", name, highest_uv + 1, num_uv());
  DAUMIER_CHECK(
      num_polygons > 0 || num_others == 0,
      "{}: no mesh of polygons (found {} vertices and {} points, lines or free-form elements, expected faces). "
      "Export it again as polygons.",
      name, num_vertices(), num_others);
  if (num_polygons == 0) RefuseCloud(name, num_vertices());
  collector.CountOtherElements(num_others);
  return std::move(collector).Finish(Eigen::Map<const Points>(coordinates.data(), num_vertices(), 3),
                                     Eigen::Map<const TextureCoordinates>(uv_coordinates.data(), num_uv(), 2), name);
}

PolygonMesh ReadObj(const std::filesystem::path& path) {
  return ParseObj(ReadFile(path), path.string());
}

Points ParseObjVertices(std::string_view text, std::string_view name, int expected_count) {
  ObjLines line(text, name);
  Points points(expected_count, 3);
  int count = 0;
  while (line.Next()) {
    if (!line.Accept("v")) continue;
    if (count < expected_count) {
      ReadVertex(line, points.row(count).data());
      line.Check(points.row(count).allFinite(), "a coordinate is not finite");
    }
    ++count;
  }
  DAUMIER_CHECK(count == expected_count, "{}: {} vertices, expected {}", name, count, expected_count);
  return points;
}

void WriteObj(const std::filesystem::path& path, const TriangleMesh& mesh) {
  CheckUv(mesh);
  std::string text = VertexLines(mesh.vertices, mesh.uv);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    AppendPolygon(mesh.triangles.row(f).data(), mesh.has_uv() ? mesh.uv_triangles.row(f).data() : nullptr, 3, text);
  }
  WriteFileAtomically(path, text);
}

void WriteObj(const std::filesystem::path& path, const PolygonMesh& mesh) {
  CheckUv(mesh);
  std::string text = VertexLines(mesh.vertices, mesh.uv);
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const int begin = mesh.offsets[p];
    AppendPolygon(mesh.corners.data() + begin, mesh.has_uv() ? mesh.uv_corners.data() + begin : nullptr,
                  mesh.offsets[p + 1] - begin, text);
  }
  WriteFileAtomically(path, text);
}

void WriteObj(const std::filesystem::path& path, const TriangleMesh& mesh, const std::vector<ObjPart>& parts,
              const std::vector<ObjMaterial>& materials) {
  CheckUv(mesh);
  Eigen::Index num_triangles = 0;
  for (const ObjPart& part : parts) num_triangles += part.num_triangles;
  DAUMIER_CHECK(num_triangles == mesh.triangles.rows(), "{}: {} triangles in parts, but {} in the mesh", path.string(),
                num_triangles, mesh.triangles.rows());
  std::string library;
  for (const ObjMaterial& material : materials) {
    const auto& [red, green, blue] = material.diffuse;
    library += fmt::format("newmtl {}\nKd {:.4g} {:.4g} {:.4g}\nKs {:.4g} {:.4g} {:.4g}\nNs {}\nillum 2\n\n",
                           material.name, red, green, blue, material.specular, material.specular, material.specular,
                           material.specular > 0 ? 250 : 10);
  }
  const std::filesystem::path library_path = std::filesystem::path(path).replace_extension(".mtl");
  std::string text = fmt::format("mtllib {}\n", library_path.filename().string());
  text += VertexLines(mesh.vertices, mesh.uv);
  text += "s 1\n";
  Eigen::Index triangle = 0;
  for (const ObjPart& part : parts) {
    text += fmt::format("g {}\nusemtl {}\n", part.group, part.material);
    for (const Eigen::Index end = triangle + part.num_triangles; triangle < end; ++triangle)
      AppendPolygon(mesh.triangles.row(triangle).data(),
                    mesh.has_uv() ? mesh.uv_triangles.row(triangle).data() : nullptr, 3, text);
  }
  WriteFileAtomically(library_path, library);
  WriteFileAtomically(path, text);
}

}  // namespace daumier::geometry
