#pragma once
#include "faces/face_model.h"
#include "fitting/projected_curves.h"
#include "render/weighted_strokes.h"
#include "systems/sketch/pen_line.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string>
#include <vector>

/// The lines of follow-up sketching [Han et al. 2017, section 3.2]: feature curves of a face on the canvas, of which a
/// person erases a part and draws it again. All lengths are pixels of the canvas.
namespace daumier::sketch {

/// Points of a curve that are erased, first..last, both included.
struct CurveGap {
  size_t first = 0, last = 0;
};

struct SessionCurve {
  std::string name, kind;  ///< Of the faces::FeatureCurve.
  bool closed = false;     ///< The last point is the first one again.
  CanvasPoints points;     ///< One a point of the curve: where the face is to have it.
  std::optional<CurveGap> gap = {};
  int drawn = 0;                    ///< The number of the stroke that it was last redrawn by; 0: never.
  std::vector<double> widths = {};  ///< Of PenLine: of the strokes that redrew it.
};

/// A sketch of follow-up mode.
struct SessionLines {
  std::vector<SessionCurve> curves;
  std::vector<PenLine> wrinkles;  ///< All other lines.
  int num_drawn = 0;              ///< Strokes that redrew curves.
};

/// The feature curves of a face, none erased. points: 2K, of fitting::Project. @throws Error if a size differs.
SessionLines LinesOf(const faces::FaceTemplate& face_template, const std::vector<std::string>& names,
                     const fitting::CurveOffsets& offsets, std::span<const float> points);

/// The curve whose ends are those of this one: lower_eye_left of upper_eye_left; empty if there is none.
std::string PartnerOf(const std::string& name);

/// Farthest from a line that an eraser still meets it, and that the ends of a stroke may be from the ends of a gap.
inline constexpr double kEraserReach = 5, kSnapReach = 48;

/// @throws Error if the stroke is shorter than a pixel or not finite.
void CheckStroke(const CanvasPoints& stroke);

/// Removes what the eraser's path comes nearest to, within kEraserReach: a wrinkle, one of the segments of a feature
/// curve, or of the silhouette, which has no segments, all points within reach. Where the curve has a gap already,
/// everything between the two parts goes too. The point at which a closed curve begins goes only with all others.
/// Returns whether anything was removed.
bool Erase(SessionLines& lines, const CanvasPoints& path);

/// Adds a stroke. If a gap's open ends lie within kSnapReach of its ends, it fills the nearest such gap, in either
/// direction: its ends are moved to the open ends, what is between follows in proportion to arc length, and the points
/// of the gap are laid on it by arc length. A partner of the curve is mapped by the similarity that takes the curve's old
/// ends to its new ones, and moved where the curve has crossed it, so that lips that were closed stay closed in a smile. A closed curve that is erased whole is filled by the stroke as a loop, which begins where it fits it best. A stroke
/// that closes around two lids or lips redraws both (HalvesOfLoop). Else it is a wrinkle. Returns the index of the curve that was filled last, or nothing for a wrinkle.
/// widths: of PenLine; the redrawn points have those of the stroke where it is laid on, all others keep their own.
/// @throws Error as CheckStroke.
std::optional<size_t> Draw(SessionLines& lines, const CanvasPoints& stroke, const std::vector<double>& widths = {});

/// Near which points the ends of a stroke that fills a gap have to be.
struct GapEnds {
  Eigen::Vector2d first, last;
};
/// Those of a curve's gap; nothing without a gap, and of a closed curve that is erased whole.
std::optional<GapEnds> EndsOfGap(const SessionCurve& curve);

/// Gives curves the widths that those of the same name have in `from`.
void KeepWidths(SessionLines& lines, const SessionLines& from);

/// What is on the canvas: curves without their gaps, and wrinkles.
std::vector<render::WeightedStroke> WeightedStrokesOf(const SessionLines& lines);
/// The same as a network reads it.
std::vector<render::Stroke> StrokesOf(const SessionLines& lines);

}  // namespace daumier::sketch
