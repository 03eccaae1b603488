#pragma once
#include "datasets/styles/drawing_context.h"
#include "datasets/styles/head_lines.h"

namespace daumier::datasets {

/// The hair of a drawing, chosen before its head is drawn.
struct HairChoice {
  enum class Kind { kNone, kShort, kLong, kSwept, kSpiky, kStrokes, kCurls, kTails, kBun, kFew } kind;
  bool hides_ears;
  HeadBorder border;  ///< How the head below it is drawn.
};
HairChoice ChooseHair(const DrawingContext& drawing);

/// Draws the hair over what is there: lines inside its mass are removed.
void DrawHair(const DrawingContext& drawing, const HairChoice& choice);

}  // namespace daumier::datasets
