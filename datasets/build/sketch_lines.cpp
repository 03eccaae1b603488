#include "datasets/build/sketch_lines.h"

#include "core/error.h"
#include "faces/wrinkle_region.h"
#include "geometry/topology.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// A wrinkle is hidden by what lies in front of it by more than this.
constexpr double kDepthToleranceMm = 1;

int KindOf(const faces::FeatureCurve& curve) {
  const auto& kinds = faces::CurveKinds();
  const auto kind = std::find(kinds.begin(), kinds.end(), curve.kind);
  DAUMIER_CHECK(kind != kinds.end(), "curve {} is of the unknown kind '{}'", curve.name, curve.kind);
  return static_cast<int>(kind - kinds.begin());
}

}  // namespace

const std::vector<std::string>& SketchKinds() {
  static const std::vector<std::string> kinds = [] {
    auto names = faces::CurveKinds();
    names.push_back("wrinkle");
    return names;
  }();
  return kinds;
}

SketchLines::SketchLines(const faces::FaceTemplate& face_template, faces::View view, const WrinkleOptions& wrinkles)
    : wrinkles_(wrinkles), triangles_(face_template.triangles) {
  for (const faces::FeatureCurve& curve : face_template.annotation.curves) {
    if (curve.view != view || curve.vertices.empty()) continue;
    kinds_.push_back(KindOf(curve));
    curve_vertices_.insert(curve_vertices_.end(), curve.vertices.begin(), curve.vertices.end());
    if (curve.closed) curve_vertices_.push_back(curve.vertices.front());
    offsets_.push_back(curve_vertices_.size());
    curve_facts_.push_back({{"name", curve.name}, {"kind", curve.kind}, {"closed", curve.closed}});
  }
  if (!wrinkles.drawn) return;
  const int num_vertices = face_template.num_vertices();
  const std::vector<int> region = faces::WrinkleRegion(face_template, view, wrinkles.clearance_mm);
  const auto neighbours = geometry::VertexNeighbours(triangles_, num_vertices);
  region_ = geometry::MapKept(geometry::VerticesWithin(neighbours, region, render::kContourRings), num_vertices);
  region_triangles_ = geometry::SelectTriangles(triangles_, region_);
  std::vector<bool> is_inside(region_.old_from_new.size());
  for (const int vertex : geometry::SelectVertices(region, region_)) is_inside[size_t(vertex)] = true;
  for (const auto& triangle : region_triangles_.rowwise()) {
    is_drawn_.push_back(std::all_of(triangle.begin(), triangle.end(), [&](int v) { return is_inside[size_t(v)]; }));
  }
  const geometry::TriangleMesh neutral{face_template.neutral, triangles_};
  feature_size_ = render::FeatureSize(neutral, geometry::ComputePrincipalCurvatures(neutral));
  depth_tolerance_ = kDepthToleranceMm / faces::MillimetresPerCm(face_template);
}

std::vector<render::Stroke> SketchLines::Draw(const geometry::Points& face, const render::Camera& camera) const {
  const geometry::Points projected = render::Project(camera, face(curve_vertices_, Eigen::all));
  std::vector<render::Stroke> strokes;
  for (size_t curve = 0; curve < kinds_.size(); ++curve) {
    render::Stroke& stroke = strokes.emplace_back(render::Stroke{kinds_[curve], {}});
    for (size_t point = offsets_[curve]; point < offsets_[curve + 1]; ++point) {
      const auto row = static_cast<Eigen::Index>(point);
      stroke.points.push_back({static_cast<float>(projected(row, 0)), static_cast<float>(projected(row, 1))});
    }
  }
  if (wrinkles_.drawn) {
    auto wrinkles = Wrinkles(face, camera);
    std::move(wrinkles.begin(), wrinkles.end(), std::back_inserter(strokes));
  }
  return strokes;
}

std::vector<render::Stroke> SketchLines::Wrinkles(const geometry::Points& face, const render::Camera& camera) const {
  const render::Visibility visibility(camera, {face, triangles_}, depth_tolerance_);
  const auto surface = render::MakeContourSurface({geometry::SelectPoints(face, region_), region_triangles_});
  const int kind = static_cast<int>(SketchKinds().size()) - 1;
  return render::SuggestiveStrokes(surface, visibility, feature_size_, wrinkles_.contours, kind, is_drawn_);
}

}  // namespace daumier::datasets
