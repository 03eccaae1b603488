#include "faces/face_holes.h"

#include "geometry/topology.h"

#include <algorithm>

namespace daumier::faces {

namespace {

geometry::Vector3 Centre(const geometry::Points& points, const std::vector<int>& vertices) {
  return points(vertices, Eigen::all).colwise().mean().transpose();
}

double Radius(const geometry::Points& points, const std::vector<int>& vertices, const geometry::Vector3& centre) {
  return (points(vertices, Eigen::all).rowwise() - centre.transpose()).rowwise().norm().maxCoeff();
}

/// Takes the hole of the landmarks first .. last out of `loops`.
std::vector<int> TakeHole(const FaceTemplate& face, int first, int last, std::vector<std::vector<int>>& loops) {
  const auto& landmarks = face.annotation.landmarks;
  const std::vector<int> part(landmarks.begin() + first, landmarks.begin() + last + 1);
  const geometry::Vector3 centre = Centre(face.neutral, part);
  const double radius = Radius(face.neutral, part, centre);
  const auto distance = [&](const std::vector<int>& loop) { return (Centre(face.neutral, loop) - centre).norm(); };
  const auto nearest = std::min_element(loops.begin(), loops.end(),
                                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (nearest == loops.end() || distance(*nearest) > 0.5 * radius ||
      Radius(face.neutral, *nearest, centre) > 2 * radius)
    return {};
  std::vector<int> hole = *nearest;
  loops.erase(nearest);
  return hole;
}

/// The corners of a loop are its vertices of least and largest x.
void CloseLoop(const geometry::Points& points, std::vector<int> loop, std::vector<Eigen::Vector3i>& triangles) {
  if (loop.empty()) return;
  const auto by_x = [&](int a, int b) { return points(a, 0) < points(b, 0); };
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), by_x), loop.end());
  const auto far = std::max_element(loop.begin(), loop.end(), by_x);
  const std::vector<int> forward(loop.begin(), far + 1);
  std::vector<int> backward(far, loop.end());
  backward.push_back(loop.front());
  std::reverse(backward.begin(), backward.end());

  size_t i = 0, j = 0;
  const auto distance = [&](int a, int b) { return (points.row(a) - points.row(b)).norm(); };
  while (i + 1 < forward.size() || j + 1 < backward.size()) {
    const bool advance_forward =
        j + 1 == backward.size() ||
        (i + 1 < forward.size() && distance(forward[i + 1], backward[j]) <= distance(forward[i], backward[j + 1]));
    // Boundary loops walk with the surface on their left; a triangle on the other side runs against them.
    const Eigen::Vector3i triangle = advance_forward ? Eigen::Vector3i(forward[i + 1], forward[i], backward[j])
                                                     : Eigen::Vector3i(backward[j], backward[j + 1], forward[i]);
    advance_forward ? ++i : ++j;
    // Both sides share their two corners, where the strip has no width.
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[0] != triangle[2])
      triangles.push_back(triangle);
  }
}

}  // namespace

FaceHoles FindHoles(const FaceTemplate& face) {
  FaceHoles holes;
  holes.others = geometry::BoundaryLoops(face.triangles, face.num_vertices());
  holes.eye_right = TakeHole(face, 36, 41, holes.others);
  holes.eye_left = TakeHole(face, 42, 47, holes.others);
  holes.mouth = TakeHole(face, 48, 67, holes.others);
  return holes;
}

void CloseHoles(const FaceHoles& holes, FaceTemplate& face) {
  std::vector<Eigen::Vector3i> triangles;
  CloseLoop(face.neutral, holes.eye_left, triangles);
  CloseLoop(face.neutral, holes.eye_right, triangles);
  face.num_eye_closing_triangles = static_cast<int>(triangles.size());
  CloseLoop(face.neutral, holes.mouth, triangles);
  face.closing_triangles.resize(triangles.size(), 3);
  for (size_t i = 0; i < triangles.size(); ++i) face.closing_triangles.row(i) = triangles[i].transpose();
}

}  // namespace daumier::faces
