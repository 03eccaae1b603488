#include "faces/hole_closure.h"

namespace daumier::faces {

int HoleClosure::LoopVertexOf(int own_vertex) const {
  return own_vertex == apex() ? loop.front() : loop[size_t((own_vertex - first_vertex) % size())];
}

std::vector<Eigen::Vector3i> HoleClosure::Triangles() const {
  std::vector<Eigen::Vector3i> triangles;
  triangles.reserve(size_t((2 * num_rings + 1) * size()));
  // A loop walks with the surface on its left; triangles on the other side run against it.
  for (int ring = 0; ring < num_rings; ++ring) {
    for (int i = 0; i < size(); ++i) {
      const int next = (i + 1) % size();
      triangles.emplace_back(vertex(ring - 1, next), vertex(ring - 1, i), vertex(ring, i));
      triangles.emplace_back(vertex(ring, i), vertex(ring, next), vertex(ring - 1, next));
    }
  }
  for (int i = 0; i < size(); ++i)
    triangles.emplace_back(vertex(num_rings - 1, (i + 1) % size()), vertex(num_rings - 1, i), apex());
  return triangles;
}

geometry::Points LoopPoints(const geometry::Points& vertices, const std::vector<int>& loop) {
  return vertices(loop, Eigen::all);
}

}  // namespace daumier::faces
