#pragma once
#include "datasets/styles/polylines.h"

#include <string>
#include <vector>

namespace daumier::datasets {

/// A letter, a digit or a sign of one stroke, on a sheet of 10 x 10.
struct Glyph {
  std::string name;
  Polyline points;
};

/// None is a line, a ring, a level arrow or a roll.
const std::vector<Glyph>& Glyphs();

/// A glyph as a hand writes it: points shifted, round or with corners, slanted, of another height.
Polyline DrawGlyph(Rng& rng);

}  // namespace daumier::datasets
