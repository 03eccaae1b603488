#include "faces/import/vertex_stack.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/import/mesh_folder.h"
#include "faces/import/npy.h"
#include "geometry/polygon_collector.h"

#include <fmt/ranges.h>

#include <memory>

namespace daumier::faces {

GivenFaces LoadVertexStack(const std::filesystem::path& folder, const AnnotationFile& annotation,
                           const std::string& licence) {
  const std::string file = (folder / "faces.npy").string();
  const auto stack = std::make_shared<const NumberArray>(ParseNpy(ReadFile(file), file));
  GivenFiles files;
  files.source = "vertex_stack";
  files.mesh = ReadMesh(folder / "template.obj");
  files.expressions = {"neutral"};
  const int64_t num_vertices = files.mesh.vertices.rows();
  DAUMIER_CHECK(stack->shape().size() == 3 && stack->shape()[1] == num_vertices && stack->shape()[2] == 3,
                "{}: has shape ({}) (expected (N, {}, 3), the vertices of template.obj). Write it by numpy.save", file,
                fmt::join(stack->shape(), ", "), num_vertices);
  for (int64_t i = 0; i < stack->shape()[0]; ++i) files.names.push_back(fmt::format("{}", i));
  files.groups = files.names;
  files.face = [stack, num_vertices, file](int identity, int) {
    geometry::Points points(num_vertices, 3);
    for (int64_t k = 0; k < 3 * num_vertices; ++k) points(k / 3, k % 3) = (*stack)[identity * 3 * num_vertices + k];
    geometry::CheckFinite(points, file);
    return points;
  };
  files.provenance = {{"name", "stack of faces"}, {"version", ""}, {"checksum", ""}, {"licence", licence}};
  return ImportGivenFaces(files, annotation);
}

}  // namespace daumier::faces
