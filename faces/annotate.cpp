#include "faces/annotate.h"

#include "core/error.h"
#include "faces/face_holes.h"
#include "faces/source_mesh.h"
#include "geometry/path.h"
#include "geometry/topology.h"
#include "geometry/triangulate.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace daumier::faces {

namespace {

using geometry::PolygonMesh;

/// The polygons that the crop keeps: those that are reached from its seed; all if there is no crop.
geometry::VertexMap Crop(const SourceMesh& mesh, const AnnotationFile& file, int num_vertices) {
  if (!file.crop_seed) {
    std::vector<int> all(num_vertices);
    std::iota(all.begin(), all.end(), 0);
    return geometry::MapKept(all, num_vertices);
  }
  std::map<std::string, std::vector<int>> traced;
  std::vector<std::vector<int>> loops;
  for (const WaypointLoop& cut : file.cuts) {
    const std::string what = "cut " + cut.name;
    if (cut.mirror_of.empty()) {
      traced[cut.name] = mesh.Trace(cut.waypoints, geometry::PathEnds::kClosed, what);
    } else {
      DAUMIER_CHECK(traced.count(cut.mirror_of), "annotation: {} mirrors '{}', which does not precede it", what,
                    cut.mirror_of);
      traced[cut.name] = mesh.Mirrored(traced[cut.mirror_of], what);
    }
    loops.push_back(traced[cut.name]);
  }
  return geometry::MapKept(mesh.Flood(*file.crop_seed, loops, "crop"), num_vertices);
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

std::vector<int> KeptMirror(const std::vector<int>& mirror, const geometry::VertexMap& map) {
  std::vector<int> kept;
  for (const int vertex : map.old_from_new)
    kept.push_back(Kept(map, mirror[vertex], fmt::format("the mirror image of vertex {}", vertex)));
  return kept;
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
    std::vector<int> path;
    try {
      path = geometry::TracePath(face.neutral, neighbours, waypoints,
                                 rule.curve.closed ? geometry::PathEnds::kClosed : geometry::PathEnds::kOpen);
    } catch (const Error& error) {
      throw Error(fmt::format("annotation of {}, {}: {}", face.source, what, error.what()));
    }
    add(rule.curve, path);
    if (!rule.mirror) continue;
    DAUMIER_CHECK(
        !face.annotation.mirror.empty(),
        "annotation of {}, {}: the mesh is not its own mirror image; specify both sides instead of mirroring one",
        face.source, what);
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
      mesh.CheckVertex(rule.range->first, what);
      mesh.CheckVertex(rule.range->second, what);
      region.resize(rule.range->second - rule.range->first + 1);
      std::iota(region.begin(), region.end(), rule.range->first);
    } else if (!rule.mirror_of.empty()) {
      DAUMIER_CHECK(regions.count(rule.mirror_of), "annotation: {} mirrors '{}', which does not precede it", what,
                    rule.mirror_of);
      region = mesh.Mirrored(regions[rule.mirror_of], what);
    } else if (!rule.vertices.empty()) {
      for (const int vertex : rule.vertices) mesh.CheckVertex(vertex, what);
      region = rule.vertices;
    } else {
      region = mesh.Flood(rule.seed, {mesh.Trace(rule.loop, geometry::PathEnds::kClosed, what)}, what);
    }
  }
  for (auto& [name, region] : regions) {
    region = geometry::SelectVertices(region, map);
    std::sort(region.begin(), region.end());
    region.erase(std::unique(region.begin(), region.end()), region.end());
    DAUMIER_CHECK(!region.empty(), "annotation: the crop leaves nothing of region {}", name);
  }
  return regions;
}

std::vector<int> Union(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

/// The regions of an Annotation out of those that were drawn; those around holes are computed where they were not.
std::map<std::string, std::vector<int>> NameRegions(const FaceTemplate& face, const FaceHoles& holes,
                                                    std::map<std::string, std::vector<int>> drawn) {
  const auto neighbours = geometry::VertexNeighbours(face.triangles, face.num_vertices());
  if (drawn.count("ear_left") && drawn.count("ear_right"))
    drawn.emplace("ears", Union(drawn["ear_left"], drawn["ear_right"]));
  drawn.erase("ear_left");
  drawn.erase("ear_right");
  if (!holes.eye_left.empty() && !holes.eye_right.empty())
    drawn.emplace("eyes", Union(geometry::VerticesWithin(neighbours, holes.eye_left, 2),
                                geometry::VerticesWithin(neighbours, holes.eye_right, 2)));
  if (!holes.mouth.empty()) drawn.emplace("mouth", geometry::VerticesWithin(neighbours, holes.mouth, 2));
  std::vector<int> border;
  for (const auto& loop : holes.others) border.insert(border.end(), loop.begin(), loop.end());
  if (!border.empty()) drawn.emplace("neck_border", geometry::VerticesWithin(neighbours, border, 0));
  return drawn;
}

void CheckComplete(const FaceHoles& holes, const std::map<std::string, std::vector<int>>& drawn,
                   const std::string& source) {
  const bool has_parts = !holes.mouth.empty() && !holes.eye_left.empty() && !holes.eye_right.empty();
  DAUMIER_CHECK(has_parts && holes.others.size() == 1,
                "annotation of {}: the crop leaves {} holes{}, expected 4: neck, mouth and two eyes", source,
                holes.others.size() + !holes.mouth.empty() + !holes.eye_left.empty() + !holes.eye_right.empty(),
                has_parts ? "" : " and none at the landmarks of an eye or the mouth");
  for (const char* name : {"face", "nose", "ear_left", "ear_right"}) {
    DAUMIER_CHECK(drawn.count(name), "annotation of {}: region '{}' is missing", source, name);
  }
}

/// Finds wrong units, wrong axes and landmarks of another order before they become wrong errors in millimetres.
void CheckFrame(const FaceTemplate& face) {
  const auto at = [&](int landmark) { return face.neutral.row(face.annotation.landmarks[landmark]); };
  const double height = face.neutral(face.annotation.hairline_vertex, 1) - at(8).y();
  constexpr double kLeast = 5, kMost = 60;
  DAUMIER_CHECK(height > 0 && at(30).z() > std::min(at(0).z(), at(16).z()) && at(16).x() > at(0).x(),
                "annotation of {}: the face has to be upright (y up) and look to +z, with its own left at +x: the "
                "hairline above landmark 8, landmark 30 before 0 and 16, and 16 to the left of 0; turn the meshes or "
                "correct the landmarks",
                face.source);
  DAUMIER_CHECK(height >= kLeast && height <= kMost,
                "annotation of {}: the mean face measures {:.4g} cm from chin to hairline; set the length of a unit by "
                "'cm_per_unit' so that it is between {} and {}",
                face.source, height, kLeast, kMost);
}

}  // namespace

AnnotatedTemplate Annotate(const PolygonMesh& mesh, const AnnotationFile& file, const std::string& source,
                           Completeness completeness) {
  const SourceMesh source_mesh(mesh, source);
  AnnotatedTemplate result;
  result.vertices = Crop(source_mesh, file, static_cast<int>(mesh.vertices.rows()));
  const geometry::VertexMap& map = result.vertices;

  FaceTemplate& face = result.face_template;
  face.source = source;
  face.neutral = geometry::SelectPoints(mesh.vertices, map);
  Annotation& annotation = face.annotation;
  const PolygonMesh kept = geometry::Submesh(mesh, map);
  geometry::TriangleMesh surface;
  if (completeness == Completeness::kComplete) {
    DAUMIER_CHECK(source_mesh.mirror().has_value(), "annotation of {}: the mesh is not its own mirror image", source);
    annotation.mirror = KeptMirror(*source_mesh.mirror(), map);
    surface = geometry::TriangulateMesh(kept, annotation.mirror);
  } else {
    try {
      if (source_mesh.mirror()) annotation.mirror = KeptMirror(*source_mesh.mirror(), map);
      surface = geometry::TriangulateMesh(kept, annotation.mirror);
    } catch (const Error&) {  // Its vertices are symmetric, but not its crop or its polygons.
      annotation.mirror.clear();
      surface = geometry::TriangulateMesh(kept);
    }
  }
  face.triangles = std::move(surface.triangles);
  face.uv = std::move(surface.uv);
  face.uv_triangles = std::move(surface.uv_triangles);
  geometry::CheckManifold(face.triangles, face.num_vertices());

  for (int i = 0; i < 68; ++i) annotation.landmarks[i] = Kept(map, file.landmarks[i], fmt::format("landmark {}", i));
  annotation.hairline_vertex = Kept(map, file.hairline, "hairline");
  if (completeness == Completeness::kLandmarks) CheckFrame(face);
  annotation.curves = TraceCurves(face, file, map);

  const FaceHoles holes = FindHoles(face);
  std::map<std::string, std::vector<int>> drawn = FillRegions(source_mesh, file, map);
  if (completeness == Completeness::kComplete) CheckComplete(holes, drawn, source);
  annotation.regions = NameRegions(face, holes, std::move(drawn));
  if (annotation.regions.count("face") == 0) {
    annotation.regions["face"].resize(face.num_vertices());
    std::iota(annotation.regions["face"].begin(), annotation.regions["face"].end(), 0);
  }
  CloseHoles(holes, face);
  return result;
}

}  // namespace daumier::faces
