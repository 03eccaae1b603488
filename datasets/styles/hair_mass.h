#pragma once
#include "datasets/styles/drawing_context.h"
#include "datasets/styles/head_ring.h"

namespace daumier::datasets {

/// Hair as an area between an outer border and the hairline, both from its right end to its left end.
struct HairMass {
  Polyline outer, inner;

  Polyline polygon() const { return Joined(outer, Reversed(inner)); }
};

enum class HairLength { kShort, kLong };
enum class Hairline { kRound, kFringe, kMiddleParting, kSideParting, kPeak, kSwept, kSpiky };

struct HairPlan {
  HairLength length = HairLength::kShort;
  Hairline hairline = Hairline::kRound;
  double thickness = 0.12;  ///< Above the crown, shares of the head's radius.
  double side = 0.05;       ///< At the sides.
  double ears = 90;         ///< Degrees from the top at which short hair ends.
  double fall = 1;          ///< How far long hair hangs down below the eyes, eye spans.
  double spikes = 0;        ///< Height of spikes on the outer border, shares of the radius; 0: none.
};

/// A plan for short or long hair with random sizes.
HairPlan DrawHairPlan(HairLength length, Hairline hairline, Rng& rng);
Hairline DrawHairline(Rng& rng);

/// The mass of a plan on a head, with irregular borders. In a profile the hair reaches from the forehead to the nape.
HairMass MakeHairMass(const FaceShape& shape, const HairPlan& plan, Rng& rng);

}  // namespace daumier::datasets
