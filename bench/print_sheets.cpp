// Pictures and facts of prints of heads (`daumier rig --print`):
//   print_sheets OUT FILE.stl...
// Writes to OUT (.png, .jpg) a row a file: from the front, from the head's right side and from below, each triangle shaded flat. Prints of
// each file how many closed surfaces it has, their volume, and how many edges of the file have other than one triangle a direction.
#include "core/error.h"
#include "core/files.h"
#include "geometry/closed_surface.h"
#include "geometry/stl.h"
#include "render/camera.h"
#include "render/shading.h"
#include "render/sheet.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace daumier {
namespace {

constexpr int kPixels = 380;

/// Each triangle with vertices of its own.
geometry::TriangleMesh Faceted(const geometry::TriangleMesh& mesh) {
  geometry::TriangleMesh faceted{geometry::Points(mesh.triangles.size(), 3), mesh.triangles, {}, {}};
  faceted.uv_triangles.resize(0, 3);
  for (int i = 0; i < mesh.triangles.size(); ++i) {
    faceted.vertices.row(i) = mesh.vertices.row(mesh.triangles.data()[i]);
    faceted.triangles.data()[i] = i;
  }
  return faceted;
}

int NumOpenEdges(const geometry::Triangles& triangles) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : triangles.rowwise())
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  int num_open = 0;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    num_open += count != 1 || back == edges.end() || back->second != 1 ? 1 : 0;
  }
  return num_open;
}

int Run(const std::vector<std::string>& words) {
  if (words.size() < 2) throw UsageError("print_sheets OUT FILE.stl...");
  // From the print's axes (z up, the face to -y) to the picture's (y up, towards the viewer z).
  Eigen::Matrix3d front, side, below;
  front << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  side << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  below << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  std::vector<render::SheetCell> cells;
  for (size_t i = 1; i < words.size(); ++i) {
    const geometry::TriangleMesh print = geometry::DecodeStl(ReadFile(words[i]));
    const geometry::TriangleMesh faceted = Faceted(print);
    for (const Eigen::Matrix3d& view : {front, side, below}) {
      render::RenderInput input;
      input.surface = faceted;
      input.surface.vertices = 0.1 * faceted.vertices * view.transpose();
      const render::Frame frame = render::FrameOf(input.surface.vertices);
      cells.push_back({render::RenderMesh(input, render::FrontalCamera(frame.centre, frame.half_height, kPixels))});
    }
    const Eigen::RowVector3d size = print.vertices.colwise().maxCoeff() - print.vertices.colwise().minCoeff();
    fmt::print("{}: {} triangles, {} parts, {:.1f} x {:.1f} x {:.1f} mm, {:.1f} cm3, {} edges not of two triangles\n",
               std::filesystem::path(words[i]).filename().string(), print.triangles.rows(),
               geometry::ConnectedParts(print).size(), size[0], size[1], size[2],
               geometry::EnclosedVolume(print) / 1000, NumOpenEdges(print.triangles));
  }
  render::WriteImage(words[0], render::MakeSheet(cells, 3));
  return 0;
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  try {
    return daumier::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
