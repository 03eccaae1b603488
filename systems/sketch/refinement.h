#pragma once
#include "faces/face_model.h"
#include "geometry/region_deformation.h"
#include "geometry/topology.h"
#include "systems/sketch/silhouette_pull.h"
#include "systems/sketch/view_selection.h"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace daumier::sketch {

/// A region of interest: what may move.
struct RefinementRegion {
  geometry::RegionDeformation deformation;  ///< Factorised.
  bool is_whole;                            ///< All of the mesh but the vertices of the neck border.
  std::vector<bool>
      is_inner;  ///< V: in the region, farther than kRegionMargin from what is fixed: handles may be there.
};

/// How far the vertices of a region move if all its handles move by 1, found when it is first needed: an undone
/// translation, and each further one, is then a product. May be used from several threads.
class HandleInfluence {
 public:
  HandleInfluence(std::shared_ptr<const RefinementRegion> region, std::vector<int> handles)
      : region_(std::move(region)), handles_(std::move(handles)) {}

  /// R. @throws Error as RegionDeformation::Solve.
  const Eigen::VectorXd& shares() const;

 private:
  std::shared_ptr<const RefinementRegion> region_;
  std::vector<int> handles_;
  mutable std::once_flag once_;
  mutable Eigen::VectorXd shares_;
};

/// A face that is being refined. Immutable; undo is to take an earlier one.
struct RefinementState {
  geometry::Points vertices;  ///< V x 3, cm.
  std::shared_ptr<const RefinementRegion> region;
  std::vector<int> handles = {};                          ///< Ascending.
  std::shared_ptr<const HandleInfluence> influence = {};  ///< Of these handles; null without any.
};

/// Operations of the gesture-based refinement mode [Han et al. 2017, sections 3.3 and 5.2] on a face, each from one state
/// to the next. Cameras are orthographic; strokes, paths and radii are in their pixels (ViewCamera for those of a sheet).
/// Vertices outside of the region keep equal bytes. Displacements are those of RegionDeformation on the mean neutral
/// face, whatever the face. May be used from several threads. Equal calls give equal bytes.
class Refinement {
 public:
  /// Shares of the height of the mean neutral face from chin to hairline, 200 mm: bulges of 2, 4 and 8 mm; the least
  /// distance of handles from fixed vertices, 8 mm, so that no cliff arises between them; the reach of handles in the
  /// whole mesh, 20 mm; and how far a line may be from the silhouette that it pulls, 40 mm.
  static constexpr double kLevels[] = {0.01, 0.02, 0.04};
  static constexpr double kRegionMargin = 0.04;
  static constexpr double kWholeReach = 0.1, kSilhouetteReach = 0.2;
  /// Degrees from the exact front or side view up to which the annotation defines a silhouette, and by which share of
  /// the height (2 mm) a computed one must be nearer to the line to be taken instead.
  static constexpr double kDefinedView = 10, kDefinedBonus = 0.01;

  /// Factorises the whole mesh. @throws Error as MakeSurfaceStiffness.
  explicit Refinement(const faces::FaceTemplate& face_template);

  /// The face as it is, without handles. The region is the whole mesh but the vertices of the neck's border; the
  /// influence of handles fades over kWholeReach, so that no part of the head needs to be held.
  /// @throws Error if the face has other vertices or one that is not finite.
  RefinementState Begin(geometry::Points vertices) const;

  /// The region that a closed stroke encloses (EnclosedRegion), in which the influence of handles reaches to its border.
  /// Handles outside of it are removed. @throws Error as EnclosedRegion.
  RefinementState Region(const RefinementState& state, const render::Camera& camera, const CanvasPoints& stroke) const;

  /// Adds the VisibleNear vertices that lie inside of the region to the handles, or removes those from them. Where there
  /// are none, handles stay. @throws Error as VisibleNear.
  RefinementState Brush(const RefinementState& state, const render::Camera& camera, const CanvasPoints& path,
                        double radius) const;
  RefinementState Erase(const RefinementState& state, const render::Camera& camera, const CanvasPoints& path,
                        double radius) const;

  /// Moves the handles in the plane of the view by the vector from the first point of a line to its last one.
  /// @throws Error as CheckStroke, or if there is no handle.
  RefinementState Translate(const RefinementState& state, const render::Camera& camera, const CanvasPoints& line) const;

  /// Moves the handles along the view's depth by a dome (RegionDeformation::Dome) that is kLevels[|level| - 1] high:
  /// level 1 to 3 bulges towards the viewer, -1 to -3 depresses. @throws Error on another level, or if there is no handle.
  RefinementState Roll(const RefinementState& state, const render::Camera& camera, int level) const;

  /// Moves the silhouette that PullToStroke finds to a line, in the plane of the view; depth is kept. Silhouettes are
  /// those of the visible surface, and in a front or side view the DefinedSilhouette: the front of a face has no
  /// occluding contour at the chin. Handles stay as they are and are not held.
  /// @throws Error as CheckStroke, or if no silhouette of the region is near the line.
  RefinementState PullSilhouette(const RefinementState& state, const render::Camera& camera,
                                 const CanvasPoints& line) const;

 private:
  VisibleSurface SurfaceIn(const RefinementState& state, const render::Camera& camera) const;
  static RefinementState WithHandles(RefinementState state, std::vector<int> handles);
  std::shared_ptr<const RefinementRegion> MakeRegion(std::vector<int> vertices, double reach) const;

  geometry::Points neutral_;
  geometry::Triangles triangles_;
  faces::Annotation annotation_;
  geometry::Adjacency neighbours_;
  geometry::SurfaceStiffness stiffness_;
  double face_height_ = 0;  ///< cm
  std::shared_ptr<const RefinementRegion> whole_;
};

}  // namespace daumier::sketch
