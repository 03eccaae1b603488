#pragma once
#include "core/json.h"
#include "render/strokes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::studio {

/// A stroke of a pen as it was drawn.
struct PenStroke {
  std::vector<std::array<double, 2>> points;  ///< Pixels of the sheet, x right, y down.
  std::vector<double> times_ms;               ///< Of each point, since the sheet was shown; never falls.
  std::vector<double> pressures;              ///< Of each point, 0 to 1; 1 of devices without.
};

/// What a person drew on a sheet while a face was shown.
struct HandDrawing {
  static constexpr int kVersion = 1;
  static constexpr double kSheet = 512;  ///< Pixels a side of the sheet.
  static constexpr size_t kMostStrokes = 2000, kMostPoints = 200'000;

  std::string person;  ///< Who drew it.
  std::string face;    ///< ShownFaces::id of the face that was shown.
  double width = 0;    ///< Of the pen, pixels of the sheet.
  double seconds = 0;  ///< From the sheet's appearance until it was given in.
  std::vector<PenStroke> strokes;
};

/// {format_version, person, face, sheet, width, seconds, strokes: [{points, times_ms, pressures}, ...]}.
Json HandDrawingToJson(const HandDrawing& drawing);
/// Undoes HandDrawingToJson. @throws Error naming `where` and the cause: another version, a missing entry, lists of other lengths than
/// the points, a number that is not finite, times that fall, a point farther than one sheet from the sheet, too many strokes or points,
/// or lines without height.
HandDrawing HandDrawingFromJson(const Json& json, const std::string& where);

/// The drawing on the canvas of sketches, all strokes of `kind`: one scale and a shift bring the middle of its bounding box to that of
/// `exact` (the curves of the face as a sketch shows them) and its height to theirs. Nobody sees the size of a face on a blank sheet.
std::vector<render::Stroke> OnCanvas(const HandDrawing& drawing, const std::vector<render::Stroke>& exact, int kind);

/// Writes the strokes as an SVG of the sheet's size, for people and other programs. @throws Error as WriteFileAtomically.
void WriteSvg(const std::filesystem::path& file, const HandDrawing& drawing);

}  // namespace daumier::studio
