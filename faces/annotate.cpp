#include "faces/annotate.h"

#include "core/error.h"
#include "geometry/path.h"
#include "geometry/topology.h"
#include "geometry/triangulate.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_map>

namespace daumier::faces {

namespace {

using geometry::PolygonMesh;

constexpr double kMirrorTolerance = 0.05;  // cm; both sources are symmetric to well below it

uint64_t EdgeKey(int a, int b) {
  return (static_cast<uint64_t>(std::min(a, b)) << 32) | static_cast<uint32_t>(std::max(a, b));
}

std::vector<int> Trace(const geometry::Points& points, const geometry::Adjacency& neighbours,
                       const std::vector<int>& waypoints, bool closed, const std::string& what) {
  try {
    return geometry::TracePath(points, neighbours, waypoints, closed);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", what, error.what()));
  }
}

/// A source mesh with what is asked of it again and again.
class SourceMesh {
 public:
  SourceMesh(const PolygonMesh& mesh, std::string source)
      : mesh_(mesh), source_(std::move(source)), mirror_(geometry::FindMirror(mesh.vertices, kMirrorTolerance)) {
    std::vector<std::pair<int, int>> pairs;
    for (int polygon = 0; polygon < mesh.num_polygons(); ++polygon) {
      const int begin = mesh.offsets[polygon], end = mesh.offsets[polygon + 1];
      for (int corner = begin; corner < end; ++corner) {
        const int a = mesh.corners[corner], b = mesh.corners[corner + 1 < end ? corner + 1 : begin];
        polygons_of_edge_[EdgeKey(a, b)].push_back(polygon);
        pairs.emplace_back(a, b);
        pairs.emplace_back(b, a);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    neighbours_.offsets.assign(mesh.vertices.rows() + 1, 0);
    for (const auto& [vertex, neighbour] : pairs) {
      ++neighbours_.offsets[vertex + 1];
      neighbours_.values.push_back(neighbour);
    }
    std::partial_sum(neighbours_.offsets.begin(), neighbours_.offsets.end(), neighbours_.offsets.begin());
  }

  const std::vector<int>& mirror() const { return mirror_; }

  std::vector<int> Trace(const std::vector<int>& waypoints, bool closed, const std::string& what) const {
    for (const int vertex : waypoints) CheckVertex(vertex, what);
    return faces::Trace(mesh_.vertices, neighbours_, waypoints, closed,
                        fmt::format("annotation of {}, {}", source_, what));
  }

  std::vector<int> Mirrored(std::vector<int> vertices) const {
    for (int& vertex : vertices) vertex = mirror_[vertex];
    return vertices;
  }

  void CheckVertex(int vertex, const std::string& what) const {
    DAUMIER_CHECK(vertex >= 0 && vertex < mesh_.vertices.rows(), "annotation of {}, {}: vertex {} is outside [0, {})",
                  source_, what, vertex, mesh_.vertices.rows());
  }

  /// The vertices of the polygons that are reached from those at `seed` without crossing one of the closed loops,
  /// ascending.
  std::vector<int> Flood(int seed, const std::vector<std::vector<int>>& loops, const std::string& what) const {
    CheckVertex(seed, what);
    std::set<uint64_t> walls;
    for (const auto& loop : loops) {
      for (size_t i = 0; i < loop.size(); ++i) walls.insert(EdgeKey(loop[i], loop[(i + 1) % loop.size()]));
    }
    std::vector<char> reached(mesh_.num_polygons(), 0);
    std::vector<int> open;
    for (int polygon = 0; polygon < mesh_.num_polygons(); ++polygon) {
      const auto corners = Corners(polygon);
      if (std::find(corners.begin(), corners.end(), seed) == corners.end()) continue;
      reached[polygon] = 1;
      open.push_back(polygon);
    }
    DAUMIER_CHECK(!open.empty(), "annotation of {}, {}: seed {} is a corner of no polygon", source_, what, seed);
    std::set<int> vertices;
    while (!open.empty()) {
      const auto corners = Corners(open.back());
      open.pop_back();
      for (size_t k = 0; k < corners.size(); ++k) {
        vertices.insert(corners[k]);
        const uint64_t edge = EdgeKey(corners[k], corners[(k + 1) % corners.size()]);
        if (walls.count(edge)) continue;
        for (const int next : polygons_of_edge_.at(edge)) {
          if (reached[next]) continue;
          reached[next] = 1;
          open.push_back(next);
        }
      }
    }
    return {vertices.begin(), vertices.end()};
  }

 private:
  std::span<const int> Corners(int polygon) const {
    return std::span(mesh_.corners)
        .subspan(mesh_.offsets[polygon], mesh_.offsets[polygon + 1] - mesh_.offsets[polygon]);
  }

  const PolygonMesh& mesh_;
  std::string source_;
  std::vector<int> mirror_;
  std::unordered_map<uint64_t, std::vector<int>> polygons_of_edge_;
  geometry::Adjacency neighbours_;
};

/// The polygons that the crop keeps: those that are reached from its seed.
geometry::VertexMap Crop(const SourceMesh& mesh, const AnnotationFile& file, int num_vertices) {
  std::map<std::string, std::vector<int>> traced;
  std::vector<std::vector<int>> loops;
  for (const WaypointLoop& cut : file.cuts) {
    const std::string what = "cut " + cut.name;
    if (cut.mirror_of.empty()) {
      traced[cut.name] = mesh.Trace(cut.waypoints, true, what);
    } else {
      DAUMIER_CHECK(traced.count(cut.mirror_of), "annotation: {} mirrors '{}', which does not stand before it", what,
                    cut.mirror_of);
      traced[cut.name] = mesh.Mirrored(traced[cut.mirror_of]);
    }
    loops.push_back(traced[cut.name]);
  }
  return geometry::MapKept(mesh.Flood(file.crop_seed, loops, "crop"), num_vertices);
}

std::string SwapSides(std::string name) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    const size_t at = name.find(from);
    if (at == std::string::npos) return false;
    name.replace(at, from.size(), to);
    return true;
  };
  if (!replace("left", "right")) replace("right", "left");
  return name;
}

int Kept(const geometry::VertexMap& map, int vertex, const std::string& what) {
  DAUMIER_CHECK(vertex >= 0 && vertex < static_cast<int>(map.new_from_old.size()) && map.new_from_old[vertex] >= 0,
                "annotation: {} is vertex {}, which the crop removes", what, vertex);
  return map.new_from_old[vertex];
}

/// Curves may also run along the diagonals of the triangulation, so they are traced on the cropped face.
std::vector<FeatureCurve> TraceCurves(const FaceTemplate& face, const AnnotationFile& file,
                                      const geometry::VertexMap& map) {
  const auto neighbours = geometry::VertexNeighbours(face.triangles, face.num_vertices());
  std::vector<FeatureCurve> curves;
  std::set<std::string> names;
  const auto add = [&](FeatureCurve curve, std::vector<int> path) {
    DAUMIER_CHECK(names.insert(curve.name).second, "annotation: two curves have the name '{}'", curve.name);
    for (size_t i = 0; i + (curve.closed ? 0 : 1) < path.size(); ++i) {
      const auto around = neighbours[path[i]];
      DAUMIER_CHECK(std::binary_search(around.begin(), around.end(), path[(i + 1) % path.size()]),
                    "annotation: curve {} leaves the edges of the mesh where it is mirrored", curve.name);
    }
    curve.vertices = std::move(path);
    curves.push_back(std::move(curve));
  };
  for (const CurveRule& rule : file.curves) {
    const std::string what = "curve " + rule.curve.name;
    std::vector<int> waypoints;
    for (const int vertex : rule.curve.vertices) waypoints.push_back(Kept(map, vertex, what));
    std::vector<int> path = Trace(face.neutral, neighbours, waypoints, rule.curve.closed,
                                  fmt::format("annotation of {}, {}", face.source, what));
    add(rule.curve, path);
    if (!rule.mirror) continue;
    FeatureCurve other = rule.curve;
    other.name = SwapSides(other.name);
    for (int& vertex : path) vertex = face.annotation.mirror[vertex];
    add(other, path);
  }
  return curves;
}

std::map<std::string, std::vector<int>> FillRegions(const SourceMesh& mesh, const AnnotationFile& file,
                                                    const geometry::VertexMap& map) {
  std::map<std::string, std::vector<int>> regions;  // of source vertices
  for (const RegionRule& rule : file.regions) {
    const std::string what = "region " + rule.name;
    std::vector<int>& region = regions[rule.name];
    if (rule.range) {
      region.resize(rule.range->second - rule.range->first + 1);
      std::iota(region.begin(), region.end(), rule.range->first);
      mesh.CheckVertex(region.front(), what);
      mesh.CheckVertex(region.back(), what);
    } else if (!rule.mirror_of.empty()) {
      DAUMIER_CHECK(regions.count(rule.mirror_of), "annotation: {} mirrors '{}', which does not stand before it", what,
                    rule.mirror_of);
      region = mesh.Mirrored(regions[rule.mirror_of]);
    } else {
      region = mesh.Flood(rule.seed, {mesh.Trace(rule.loop, true, what)}, what);
    }
  }
  for (auto& [name, region] : regions) {
    region = geometry::SelectVertices(region, map);
    std::sort(region.begin(), region.end());
    DAUMIER_CHECK(!region.empty(), "annotation: the crop leaves nothing of region {}", name);
  }
  return regions;
}

std::vector<int> Union(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

/// The four holes of a cropped face.
struct FaceLoops {
  std::vector<int> neck, mouth, eye_left, eye_right;
};

FaceLoops ClassifyLoops(const FaceTemplate& face) {
  const auto loops = geometry::BoundaryLoops(face.triangles, face.num_vertices());
  DAUMIER_CHECK(loops.size() == 4, "annotation: the crop leaves {} holes, expected 4: neck, mouth and two eyes",
                loops.size());
  FaceLoops result;
  const auto& landmarks = face.annotation.landmarks;
  const double mouth_y = face.neutral(landmarks[62], 1), eye_y = face.neutral(landmarks[36], 1),
               chin_y = face.neutral(landmarks[8], 1);
  for (const auto& loop : loops) {
    geometry::Vector3 centre = geometry::Vector3::Zero();
    for (const int vertex : loop) centre += face.neutral.row(vertex).transpose() / loop.size();
    std::vector<int>* hole = centre.y() < chin_y                                             ? &result.neck
                             : std::abs(centre.y() - mouth_y) < std::abs(centre.y() - eye_y) ? &result.mouth
                             : centre.x() > 0                                                ? &result.eye_left
                                                                                             : &result.eye_right;
    DAUMIER_CHECK(hole->empty(), "annotation: two holes of the cropped face are taken for the same one");
    *hole = loop;
  }
  return result;
}

/// Zips the two sides of a loop from one corner to the other, always along the shorter next diagonal. The corners are
/// the loop's vertices of least and largest x.
void CloseLoop(const geometry::Points& points, std::vector<int> loop, std::vector<Eigen::Vector3i>& triangles) {
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

void CloseHoles(const FaceLoops& loops, FaceTemplate& face) {
  std::vector<Eigen::Vector3i> triangles;
  CloseLoop(face.neutral, loops.eye_left, triangles);
  CloseLoop(face.neutral, loops.eye_right, triangles);
  face.num_eye_closing_triangles = static_cast<int>(triangles.size());
  CloseLoop(face.neutral, loops.mouth, triangles);
  face.closing_triangles.resize(triangles.size(), 3);
  for (size_t i = 0; i < triangles.size(); ++i) face.closing_triangles.row(i) = triangles[i].transpose();
}

}  // namespace

AnnotatedTemplate Annotate(const PolygonMesh& mesh, const AnnotationFile& file, const std::string& source) {
  const SourceMesh source_mesh(mesh, source);
  AnnotatedTemplate result;
  result.vertices = Crop(source_mesh, file, static_cast<int>(mesh.vertices.rows()));
  const geometry::VertexMap& map = result.vertices;

  FaceTemplate& face = result.face_template;
  face.source = source;
  face.neutral = geometry::SelectPoints(mesh.vertices, map);
  Annotation& annotation = face.annotation;
  for (const int vertex : map.old_from_new) {
    annotation.mirror.push_back(
        Kept(map, source_mesh.mirror()[vertex], fmt::format("the mirror image of vertex {}", vertex)));
  }
  face.triangles = geometry::Triangulate(geometry::Submesh(mesh, map), annotation.mirror);
  geometry::CheckManifold(face.triangles, face.num_vertices());

  for (int i = 0; i < 68; ++i) annotation.landmarks[i] = Kept(map, file.landmarks[i], fmt::format("landmark {}", i));
  annotation.hairline_vertex = Kept(map, file.hairline, "hairline");
  annotation.curves = TraceCurves(face, file, map);

  const FaceLoops loops = ClassifyLoops(face);
  std::map<std::string, std::vector<int>> drawn = FillRegions(source_mesh, file, map);
  for (const char* name : {"face", "nose", "ear_left", "ear_right"}) {
    DAUMIER_CHECK(drawn.count(name), "annotation of {}: region '{}' is missing", source, name);
  }
  const auto neighbours = geometry::VertexNeighbours(face.triangles, face.num_vertices());
  annotation.regions["face"] = drawn["face"];
  annotation.regions["nose"] = drawn["nose"];
  annotation.regions["ears"] = Union(drawn["ear_left"], drawn["ear_right"]);
  annotation.regions["eyes"] = Union(geometry::VerticesWithin(neighbours, loops.eye_left, 2),
                                     geometry::VerticesWithin(neighbours, loops.eye_right, 2));
  annotation.regions["mouth"] = geometry::VerticesWithin(neighbours, loops.mouth, 2);
  annotation.regions["neck_border"] = geometry::VerticesWithin(neighbours, loops.neck, 0);
  CloseHoles(loops, face);
  return result;
}

}  // namespace daumier::faces
