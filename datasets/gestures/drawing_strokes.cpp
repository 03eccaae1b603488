#include "datasets/gestures/drawing_strokes.h"

#include "datasets/gestures/path_pen.h"

#include <array>

namespace daumier::datasets {
namespace {

/// Rough lines of parts of a face, in units of any size, x right and y down.
const std::vector<Polyline>& FaceParts() {
  static const std::vector<Polyline> parts = {
      {{5, 0}, {4.5, 4}, {3, 8}, {2, 10}, {4, 11}, {6, 10.5}},                           // Nose: side and base.
      {{3, 0}, {3.2, 6}, {1, 9}, {2, 11}, {5, 11.5}, {8, 11}, {9, 9}, {7, 6}},           // Nose: both wings.
      {{0, 1}, {1, 3}, {3, 3}, {4, 2}, {5, 3}, {7, 3}, {8, 1}},                          // Base with nostrils.
      {{4, 1}, {1, 0}, {0, 3}, {2, 6}, {2, 9}, {5, 10}},                                 // Ear.
      {{4, 1}, {1, 0}, {0, 3}, {2, 7}, {4, 8}, {4, 5}, {2, 3}, {3, 2}},                  // Ear with its inside.
      {{0, 4}, {2, 1}, {5, 0}, {8, 2}, {10, 5}, {8, 4.5}},                               // Upper lid with its fold.
      {{10, 3}, {7, 0.5}, {3, 0.5}, {0, 3}, {3, 5}, {5.5, 5.6}},                         // Eye, not closed.
      {{0, 3}, {2, 1.5}, {4, 0}, {5, 1}, {6, 0}, {8, 1.5}, {10, 3}},                     // Upper lip.
      {{0, 1}, {1, 2}, {5, 3}, {9, 2}, {10, 0}},                                         // Smile.
      {{0, 0}, {1, 1}, {0.5, 2}, {3, 4}, {7, 4}, {9, 2}, {10, 0}},                       // Smile with its corner.
      {{0, 6}, {2, 1}, {3, 5}, {5, 0}, {6, 5}, {8, 1}, {9, 6}},                          // Fringe.
      {{0, 8}, {1, 3}, {4, 0}, {8, 0}, {11, 3}, {12, 8}},                                // Skull.
      {{0, 0}, {0, 5}, {2, 9}, {5, 11}, {8, 9}, {10, 5}, {10, 0}},                       // Jaw.
      {{6, 0}, {7, 3}, {3, 5}, {2, 9}, {5, 12}, {4, 16}, {6, 19}},                       // Long hair.
      {{3, 0}, {5, 2}, {3, 4}, {1, 2}, {4, 1}, {7, 4}, {6, 7}, {3, 6}, {5, 4}, {9, 8}},  // Curl.
      {{0, 6}, {3, 5}, {4, 2}, {4, 0}, {9, 0}, {9, 2}, {10, 5}, {13, 6}},                // Neck and shoulders.
      {{0, 3}, {4, 0}, {9, 1}, {10, 2}, {6, 2}, {1, 4}},                                 // Brow with both edges, open.
      {{0, 0}, {3, 2}, {6, 6}, {7, 10}, {5, 12}, {6, 14}, {5, 16}, {2, 18}},             // Profile.
      {{0, 0}, {1, 4}, {4, 5}, {6, 3}, {8, 5}, {11, 4}, {12, 0}},                        // Glasses, lower rims.
      {{0, 5}, {3, 4}, {3, 0}, {10, 0}, {10, 4}, {13, 5}},                               // Hat.
      {{2, 2}, {0, 4}, {3, 7}, {1, 10}, {4, 13}, {2, 16}},                               // Strand.
  };
  return parts;
}

}  // namespace

Polyline DrawingStroke(Rng& rng) {
  Polyline points = FaceParts()[rng.Below(FaceParts().size())];
  const double shift = 0.04 * BoxOf(points).sizes().maxCoeff();
  for (Eigen::Vector2d& point : points) point += shift * Eigen::Vector2d{rng.Normal(), rng.Normal()};
  if (Happens(0.3, rng)) {  // A part of it.
    const double from = rng.Uniform(0, 0.35);
    points = Part(points, from, from + rng.Uniform(0.45, 0.65), 40);
  }
  const Polyline line = Happens(0.8, rng) ? Smooth(points, 240) : Resampled(points, 240);
  const double side = EitherSign(rng), height = LogUniform(0.6, 1.6, rng);
  const Polyline sized = Scaled(line, side, height);
  const Polyline turned = Turned(sized, Deviate(0.3, rng));
  return Happens(0.5, rng) ? Reversed(turned) : turned;
}

}  // namespace daumier::datasets
