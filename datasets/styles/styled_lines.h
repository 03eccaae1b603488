#pragma once
#include "datasets/styles/polylines.h"
#include "faces/drawing_terms.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace daumier::datasets {

/// What belongs together when a face is drawn.
enum class DrawnPart {
  kOutline,
  kEyeRight,
  kEyeLeft,
  kBrows,
  kNose,
  kMouth,
  kEars,
  kHair,
  kHat,
  kGlasses,
  kBust,
  kSkin,
  kPage
};
inline constexpr int kNumDrawnParts = 13;

/// A point of a line that is a point of the face.
struct LineAnchor {
  faces::FacePoint point;
  int index;
};

/// How a hand draws a line: kFree with all its habits, kShort without drawing it twice or in pieces, kMark as it is.
enum class LineCare { kFree, kShort, kMark };

/// A line before a hand draws it.
struct StyledLine {
  DrawnPart part;
  Polyline points;
  std::vector<faces::LineLabel> labels;  ///< Of each point.
  std::vector<LineAnchor> anchors = {};
  LineCare care = LineCare::kFree;
  double width = 1;  ///< In widths of the pen.
  bool filled = false;
};

/// The lines of a drawing while it is made, in the order in which they are added, and what they show.
struct LineSheet {
  std::vector<StyledLine> lines;
  std::optional<faces::MouthState> mouth;
  std::array<std::optional<faces::EyeState>, 2> eyes;         ///< Right, left.
  std::array<std::optional<Eigen::Vector2d>, 2> eye_centres;  ///< Of those that are drawn.

  /// A line of one label; lines of fewer than two points are left out. The result is valid until the next call.
  StyledLine& Add(DrawnPart part, faces::LineLabel label, Polyline points, std::vector<LineAnchor> anchors = {});
  /// A mark or hair: LineCare::kMark.
  StyledLine& AddMark(DrawnPart part, faces::LineLabel label, Polyline points);
  /// Removes what lies inside a polygon from the lines `begin` to `end`; anchors there are lost, and eye centres too
  /// where the eye's lines are among them.
  void CutInside(const Polyline& polygon, size_t begin, size_t end);
  /// All points moved.
  void Move(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& moved);

 private:
  StyledLine unused_{};  ///< Given back for lines that are left out.
};

DrawnPart EyePart(size_t side);

}  // namespace daumier::datasets
