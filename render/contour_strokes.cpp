#include "render/contour_strokes.h"

#include "core/error.h"

#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

/// Passes of a (1/4, 1/2, 1/4) mean over a line's points: contours of a triangle mesh zigzag from edge to edge.
constexpr int kSmoothingPasses = 3;

/// Depth tolerance of a line drawing in feature sizes: about a millimetre on a head.
constexpr double kDepthToleranceInFeatures = 0.5;

/// A visible piece of a chain: projected points and the greatest strength among them.
struct VisiblePiece {
  std::vector<Eigen::RowVector3d> points;
  double strength = 0;
};

double LengthInPixels(const VisiblePiece& piece) {
  double length = 0;
  for (size_t i = 1; i < piece.points.size(); ++i) length += (piece.points[i] - piece.points[i - 1]).head<2>().norm();
  return length;
}

/// A step between two points is visible if its middle is.
std::vector<VisiblePiece> VisiblePieces(const ContourChain& chain, const Visibility& visibility) {
  const geometry::Points projected = Project(visibility.camera(), chain.points);
  std::vector<VisiblePiece> pieces;
  bool goes_on = false;
  for (Eigen::Index i = 1; i < projected.rows(); ++i) {
    if (!visibility.Sees(0.5 * (projected.row(i - 1) + projected.row(i)))) {
      goes_on = false;
      continue;
    }
    if (!goes_on) pieces.push_back({{projected.row(i - 1)}, chain.strength[i - 1]});
    pieces.back().points.push_back(projected.row(i));
    pieces.back().strength = std::max(pieces.back().strength, chain.strength[i]);
    goes_on = true;
  }
  return pieces;
}

Stroke SmoothStroke(std::vector<Eigen::RowVector3d> points, int kind) {
  const bool closed = points.size() > 3 && points.front() == points.back();
  const size_t last = points.size() - 1;
  for (int pass = 0; pass < kSmoothingPasses; ++pass) {
    const auto before = points;
    for (size_t i = 1; i < last; ++i) points[i] = 0.25 * before[i - 1] + 0.5 * before[i] + 0.25 * before[i + 1];
    if (closed) points[0] = points[last] = 0.25 * before[last - 1] + 0.5 * before[0] + 0.25 * before[1];
  }
  Stroke stroke{kind, {}};
  for (const auto& point : points)
    stroke.points.push_back({static_cast<float>(point.x()), static_cast<float>(point.y())});
  return stroke;
}

std::vector<Stroke> StrokesOf(const std::vector<ContourSegment>& segments, const Visibility& visibility,
                              double min_strength, double min_length, int kind) {
  std::vector<Stroke> strokes;
  for (const ContourChain& chain : ChainContours(segments)) {
    for (VisiblePiece& piece : VisiblePieces(chain, visibility)) {
      if (piece.strength < min_strength || LengthInPixels(piece) < min_length) continue;
      strokes.push_back(SmoothStroke(std::move(piece.points), kind));
    }
  }
  return strokes;
}

}  // namespace

ContourSurface MakeContourSurface(geometry::TriangleMesh mesh) {
  geometry::SurfaceCurvature curvature = geometry::ComputeSurfaceCurvature(mesh);
  return {std::move(mesh), std::move(curvature.principal), std::move(curvature.derivatives)};
}

std::vector<Stroke> SuggestiveStrokes(const ContourSurface& surface, const Visibility& visibility, double feature_size,
                                      const ContourOptions& options, int kind, const std::vector<bool>& is_drawn) {
  DAUMIER_CHECK(is_drawn.empty() || is_drawn.size() == size_t(surface.mesh.triangles.rows()),
                "{} marks for {} triangles", is_drawn.size(), surface.mesh.triangles.rows());
  DAUMIER_CHECK(options.high >= options.low, "the upper threshold of contours, {}, is below the lower one, {}",
                options.high, options.low);
  const double unit = 1 / (feature_size * feature_size);
  const ViewCurvature view = ComputeViewCurvature(surface.mesh, surface.curvatures, surface.derivatives,
                                                  visibility.camera(), options.low * unit);
  const double max_n_dot_v = std::cos(options.min_angle * std::numbers::pi / 180);
  std::vector<ContourSegment> segments = SuggestiveContours(surface.mesh, view, max_n_dot_v);
  if (!is_drawn.empty()) {
    std::erase_if(segments, [&](const ContourSegment& segment) { return !is_drawn[size_t(segment.triangle)]; });
  }
  return StrokesOf(segments, visibility, (options.high - options.low) * unit, options.min_length, kind);
}

std::vector<Stroke> OccludingStrokes(const ContourSurface& surface, const Visibility& visibility,
                                     const ContourOptions& options, int kind) {
  const ViewCurvature view =
      ComputeViewCurvature(surface.mesh, surface.curvatures, surface.derivatives, visibility.camera(), 0);
  return StrokesOf(OccludingContours(surface.mesh, view), visibility, 0, options.min_length, kind);
}

const std::vector<std::string>& ContourKinds() {
  static const std::vector<std::string> kinds = {"occluding", "suggestive", "border"};
  return kinds;
}

std::vector<Stroke> DrawContours(const geometry::TriangleMesh& mesh, const Camera& camera,
                                 const ContourOptions& options) {
  const ContourSurface surface = MakeContourSurface(mesh);
  const double feature_size = FeatureSize(mesh, surface.curvatures);
  const Visibility visibility(camera, mesh, kDepthToleranceInFeatures * feature_size);
  std::vector<Stroke> strokes = OccludingStrokes(surface, visibility, options, 0);
  const std::vector<Stroke> suggestive = SuggestiveStrokes(surface, visibility, feature_size, options, 1);
  strokes.insert(strokes.end(), suggestive.begin(), suggestive.end());
  const std::vector<Stroke> borders = StrokesOf(Borders(mesh), visibility, 0, options.min_length, 2);
  strokes.insert(strokes.end(), borders.begin(), borders.end());
  return strokes;
}

}  // namespace daumier::render
