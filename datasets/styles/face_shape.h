#pragma once
#include "datasets/read/sketch_database.h"
#include "datasets/styles/polylines.h"
#include "faces/drawing_terms.h"

#include <array>
#include <functional>
#include <vector>

namespace daumier::datasets {

// Lines of a face on the sheet from which drawings are made. Each has the same number of points for every face, so that
// its marked places have fixed indices. A line that is not seen is empty.

/// From the outer corner to the inner one; top and bottom are the points kMiddle.
struct EyeShape {
  static constexpr int kPoints = 13, kMiddle = 6;
  Polyline upper, lower;
  bool is_closed = false;

  bool is_seen() const { return !upper.empty(); }
};

/// The two edges from the outer end to the inner one; they meet at both ends.
struct BrowShape {
  static constexpr int kPoints = 11;
  Polyline upper, lower;

  bool is_seen() const { return !upper.empty(); }
};

struct NoseShape {
  static constexpr int kBridgePoints = 12, kWingPoints = 9, kBasePoints = 17, kBaseMiddle = 8;
  std::array<Polyline, 2> bridges;  ///< Right and left side, from the brow down.
  std::array<Polyline, 2> wings;    ///< From above down to the nostril.
  Polyline base;                    ///< From the right nostril to the left one; the nose's bottom is kBaseMiddle.
  Polyline contour;                 ///< Of a turned face: the nose's border against the cheek behind it.
};

/// From the right corner to the left one; `middle` is the index of the middle of the lip. Of a profile from the corner
/// to the middle.
struct MouthShape {
  static constexpr int kPoints = 17;
  Polyline top, inner_top, inner_bottom, bottom;
  int middle = 8;
  bool is_open = false;
};

struct EarShape {
  Polyline outer, inner;
};

struct FaceShape {
  static constexpr int kOutlinePoints = 49, kSkullPoints = 41;
  faces::DrawnView view = faces::DrawnView::kFront;
  /// The border of the face without hair: from the right ear down and round the chin to the left ear. Of a profile from
  /// the forehead down the face to the neck.
  Polyline outline;
  int chin = 24;  ///< Index on the outline.
  /// The border of the skull, from the end of the outline over the crown to its beginning.
  Polyline skull;
  std::array<EyeShape, 2> eyes;    ///< Right, left.
  std::array<BrowShape, 2> brows;  ///< Right, left.
  std::array<EarShape, 2> ears;    ///< Right, left.
  NoseShape nose;
  MouthShape mouth;
  std::vector<Polyline> wrinkles;
  Eigen::Vector2d hairline = Eigen::Vector2d::Zero();
  Eigen::Vector2d eyes_middle = Eigen::Vector2d::Zero();
  double unit = 50;  ///< About the distance of the outer corners of the eyes, in every view, pixels.

  /// The polygon of outline and skull.
  Polyline head() const;
  /// Where the mouth is not seen, where it usually is.
  Eigen::Vector2d mouth_middle() const;
};

/// Calls `change` on every line of the shape and its points.
void ForEachLine(FaceShape& shape, const std::function<void(Polyline&)>& change);
/// Every point of the shape moved.
void MovePoints(FaceShape& shape, const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& moved);

/// The shape of a stored sketch. Where a template has no curve of the frontal view, its landmarks are the line.
/// @throws Error if the database has no facts (version 1), or a profile lacks a curve.
FaceShape ShapeOf(const SketchDatabase& sketches, int face, int view = 0);

/// The turn, degrees, up to which a face counts as seen from the front, and from which as a profile.
inline constexpr double kGreatestFrontalYaw = 15, kLeastProfileYaw = 65;
/// Gaps, mm, up to which lips and lids count as closed, as tools that score drawings have them.
inline constexpr double kClosedLipsMm = 1.5, kClosedLidsMm = 1.0;

}  // namespace daumier::datasets
