#pragma once
#include "studio/hand_drawing.h"

#include <cmath>
#include <numbers>

/// Drawings as a pen gives them in, for tests of collections.
namespace daumier::testing {

/// A line and an ellipse of a head's form on the sheet.
inline studio::HandDrawing PenDrawing(const std::string& person, const std::string& face) {
  studio::HandDrawing drawing{.person = person, .face = face, .width = 2.5, .seconds = 12.5, .strokes = {}};
  drawing.strokes.push_back({{{{200, 250}}, {{220.25, 260}}}, {10, 26.5}, {0.5, 0.75}});
  studio::PenStroke ellipse;
  for (int i = 0; i <= 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    ellipse.points.push_back({256 + 120 * std::cos(angle), 256 + 170 * std::sin(angle)});
    ellipse.times_ms.push_back(1000 + 16 * i);
    ellipse.pressures.push_back(1);
  }
  drawing.strokes.push_back(std::move(ellipse));
  return drawing;
}

/// What the page sends: {face, width, seconds, strokes}.
inline Json DrawingBody(int face) {
  const Json record = studio::HandDrawingToJson(PenDrawing("", ""));
  return {{"face", face}, {"width", 2.5}, {"seconds", 12.5}, {"strokes", record.at("strokes")}};
}

}  // namespace daumier::testing
