#include "systems/sketch/refinement.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace daumier::sketch {
namespace {

/// Height of the mean neutral face in the unit of faces::MillimetresPerCm.
constexpr double kFaceMillimetres = 200;

/// moves: R x 3, of the vertices of the region; no other vertex is written.
void Move(RefinementState& state, const Eigen::MatrixXd& moves) {
  const std::vector<int>& region = state.region->deformation.region();
  for (size_t place = 0; place < region.size(); ++place)
    state.vertices.row(region[place]) += moves.row(Eigen::Index(place));
}

std::vector<int> InnerOf(const RefinementRegion& region, std::vector<int> vertices) {
  std::erase_if(vertices, [&](int v) { return !region.is_inner[size_t(v)]; });
  return vertices;
}

/// The view of the annotation that a camera shows, if any.
std::optional<faces::View> DefinedView(const render::Camera& camera) {
  const double least = std::cos(Refinement::kDefinedView * std::numbers::pi / 180);
  const Eigen::RowVector3d away = camera.camera_from_world.row(2);
  if (-away.z() >= least) return faces::View::kFrontal;
  if (std::abs(away.x()) >= least) return faces::View::kSide;
  return std::nullopt;
}

}  // namespace

const Eigen::VectorXd& HandleInfluence::shares() const {
  std::call_once(
      once_, [&] { shares_ = region_->deformation.Solve(handles_, Eigen::MatrixXd::Ones(std::ssize(handles_), 1)); });
  return shares_;
}

Refinement::Refinement(const faces::FaceTemplate& face_template)
    : neutral_(face_template.neutral),
      triangles_(face_template.triangles),
      annotation_(face_template.annotation),
      neighbours_(geometry::VertexNeighbours(triangles_, face_template.num_vertices())),
      stiffness_(geometry::MakeSurfaceStiffness({neutral_, triangles_})),
      face_height_(kFaceMillimetres / faces::MillimetresPerCm(face_template)) {
  std::vector<bool> is_fixed(size_t(face_template.num_vertices()), false);
  if (const auto border = annotation_.regions.find("neck_border"); border != annotation_.regions.end())
    for (const int v : border->second) is_fixed[size_t(v)] = true;
  std::vector<int> vertices;
  for (int v = 0; v < face_template.num_vertices(); ++v)
    if (!is_fixed[size_t(v)]) vertices.push_back(v);
  whole_ = MakeRegion(std::move(vertices), kWholeReach * face_height_);
}

std::shared_ptr<const RefinementRegion> Refinement::MakeRegion(std::vector<int> vertices, double reach) const {
  std::vector<bool> is_inside(size_t(neighbours_.size()), false);
  for (const int v : vertices) is_inside[size_t(v)] = true;
  std::vector<int> border;  // Fixed vertices next to the region.
  for (int v = 0; v < neighbours_.size(); ++v)
    if (!is_inside[size_t(v)] && std::ranges::any_of(neighbours_[v], [&](int near) { return is_inside[size_t(near)]; }))
      border.push_back(v);
  std::vector<bool> is_inner = is_inside;
  const double margin = kRegionMargin * face_height_;
  for (const int v : vertices)
    is_inner[size_t(v)] = std::ranges::none_of(
        border, [&](int fixed) { return (neutral_.row(v) - neutral_.row(fixed)).norm() <= margin; });
  const bool is_whole = whole_ == nullptr;  // That region is made first.
  return std::make_shared<const RefinementRegion>(
      RefinementRegion{{stiffness_, std::move(vertices), reach}, is_whole, std::move(is_inner)});
}

VisibleSurface Refinement::SurfaceIn(const RefinementState& state, const render::Camera& camera) const {
  return {{state.vertices, triangles_}, camera};
}

RefinementState Refinement::Begin(geometry::Points vertices) const {
  DAUMIER_CHECK(vertices.rows() == neighbours_.size(), "a face of {} vertices, expected {}", vertices.rows(),
                neighbours_.size());
  DAUMIER_CHECK(vertices.allFinite(), "a face with a vertex that is not finite");
  return {std::move(vertices), whole_};
}

RefinementState Refinement::Region(const RefinementState& state, const render::Camera& camera,
                                   const CanvasPoints& stroke) const {
  RefinementState next = state;
  next.region =
      MakeRegion(EnclosedRegion(SurfaceIn(state, camera), neighbours_, stiffness_.areas, stroke), face_height_);
  std::vector<int> handles = InnerOf(*next.region, state.handles);
  return WithHandles(std::move(next), std::move(handles));
}

RefinementState Refinement::WithHandles(RefinementState state, std::vector<int> handles) {
  state.handles = std::move(handles);
  state.influence =
      state.handles.empty() ? nullptr : std::make_shared<const HandleInfluence>(state.region, state.handles);
  return state;
}

RefinementState Refinement::Brush(const RefinementState& state, const render::Camera& camera, const CanvasPoints& path,
                                  double radius) const {
  const std::vector<int> added = InnerOf(*state.region, VisibleNear(SurfaceIn(state, camera), path, radius));
  std::vector<int> handles;
  std::ranges::set_union(state.handles, added, std::back_inserter(handles));
  return WithHandles(state, std::move(handles));
}

RefinementState Refinement::Erase(const RefinementState& state, const render::Camera& camera, const CanvasPoints& path,
                                  double radius) const {
  const std::vector<int> removed = VisibleNear(SurfaceIn(state, camera), path, radius);
  std::vector<int> handles;
  std::ranges::set_difference(state.handles, removed, std::back_inserter(handles));
  return WithHandles(state, std::move(handles));
}

RefinementState Refinement::Translate(const RefinementState& state, const render::Camera& camera,
                                      const CanvasPoints& line) const {
  CheckStroke(line);
  DAUMIER_CHECK(!camera.perspective, "handles are moved in a view in perspective, expected an orthographic camera");
  const Eigen::RowVector2d move = (line.back() - line.front()).transpose() / camera.scale;
  DAUMIER_CHECK(state.influence != nullptr, "there is no handle; mark some");
  RefinementState next = state;
  Move(next, state.influence->shares() * (move * camera.camera_from_world.topRows<2>()));
  return next;
}

RefinementState Refinement::Roll(const RefinementState& state, const render::Camera& camera, int level) const {
  DAUMIER_CHECK(level != 0 && std::abs(level) <= std::ssize(kLevels),
                "a roll of level {}, expected 1 to 3, or -1 to -3", level);
  DAUMIER_CHECK(!camera.perspective, "handles are moved in a view in perspective, expected an orthographic camera");
  const double towards_viewer = std::copysign(kLevels[std::abs(level) - 1], level) * face_height_;
  RefinementState next = state;
  Move(next, state.region->deformation.Dome(state.handles) * (-towards_viewer * camera.camera_from_world.row(2)));
  return next;
}

RefinementState Refinement::PullSilhouette(const RefinementState& state, const render::Camera& camera,
                                           const CanvasPoints& line) const {
  CheckStroke(line);
  const VisibleSurface surface = SurfaceIn(state, camera);
  const double reach = kSilhouetteReach * face_height_ * camera.scale;
  std::optional<LinePull> pull =
      PullToStroke(VisibleSilhouettes({state.vertices, triangles_}, camera, surface), line, reach);
  if (const auto view = DefinedView(camera)) {
    auto defined = PullToStroke({DefinedSilhouette(annotation_, *view, surface.projected())}, line, reach);
    const double bonus = kDefinedBonus * face_height_ * camera.scale;
    if (defined && (!pull || defined->distance <= pull->distance + bonus)) pull = std::move(defined);
  }
  std::vector<int> handles, rows;
  for (size_t k = 0; pull && k < pull->vertices.size(); ++k) {
    if (!state.region->is_inner[size_t(pull->vertices[k])]) continue;
    handles.push_back(pull->vertices[k]);
    rows.push_back(int(k));
  }
  DAUMIER_CHECK(!handles.empty(),
                "no silhouette of the region is within {:.0f} pixels of the line; draw along one, or mark handles",
                reach);
  const Eigen::MatrixXd in_view =
      state.region->deformation.Solve(handles, pull->moves(rows, Eigen::all) / camera.scale);
  RefinementState next = state;
  Move(next, in_view * camera.camera_from_world.topRows<2>());
  return next;
}

}  // namespace daumier::sketch
