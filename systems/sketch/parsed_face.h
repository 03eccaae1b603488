#pragma once
#include "render/strokes.h"
#include "systems/sketch/drawing_parser.h"

#include <array>
#include <string>
#include <vector>

/// What of a parsed drawing predicts a face.
namespace daumier::sketch {

/// The lines that show the face (datasets::ShowsFace), which a network reads; all lines if none does.
std::vector<render::Stroke> LinesOfFace(const ParsedDrawing& drawing);

/// @throws Error if the drawing shows a profile, which no face is predicted from.
void RefuseProfile(const ParsedDrawing& drawing);

/// What a person should hear of a parsed drawing: that it hardly shows a face (ParsedDrawing::confidence below
/// kLeastConfidence), or lies on its side or upside down, so that it was turned.
std::vector<std::string> ParseWarnings(const ParsedDrawing& drawing);

inline constexpr double kLeastConfidence = 0.62;

/// Whether a line of this label can show the point: lids and iris points of eyes, the silhouette the contour.
bool CanShow(faces::LineLabel label, faces::FacePoint point);

/// Of each point how far the drawing itself shows it, 0..1: 1 if a line that can show it passes within
/// kSupportTolerance, the promise of styled drawings (datasets::StyledDrawing), and beyond exp(-x^2 / 2), x the further
/// distance in kSupportReach; pixels of the canvas of drawing.frame. Elsewhere a parser extrapolates.
std::array<double, faces::kNumFacePoints> SupportOf(const ParsedDrawing& drawing);

inline constexpr double kSupportTolerance = 4, kSupportReach = 4;

/// Parts of the face that lines of the drawing show: "outline", "right eye", "left eye", "brows", "nose", "mouth", "ears", in this
/// order. A part is shown if a third of its points are supported (SupportOf) by one half or more; ears, which have no points, by a line of them.
std::vector<std::string> DrawnParts(const ParsedDrawing& drawing);

}  // namespace daumier::sketch
