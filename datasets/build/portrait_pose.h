#pragma once
#include "core/options.h"
#include "core/random.h"
#include "datasets/read/portrait_camera.h"
#include "geometry/mesh.h"

#include <array>

namespace daumier::datasets {

struct PoseOptions {
  double yaw = 60;
  double pitch = 25;
  double roll = 15;
  double frontal = 0.75;
  double smallest = 0.40;
  double largest = 0.72;
  double shift = 0.07;

  template <class V>
  void Visit(V&& visit) {
    visit("yaw", yaw, Range{0, 90}, "Largest turn to a side, degrees.");
    visit("pitch", pitch, Range{0, 60}, "Largest nod, degrees.");
    visit("roll", roll, Range{0, 90}, "Largest tilt, degrees.");
    visit("frontal", frontal, Range{0, 1}, "Share of faces within half of the largest yaw, most of them near 0.");
    visit("smallest", smallest, Range{0.1, 1}, "Least longer side of the landmarks' box, as a share of the picture.");
    visit("largest", largest, Range{0.1, 1}, "Greatest longer side of the landmarks' box, as a share of the picture.");
    visit("shift", shift, Range{0, 0.5}, "Largest shift of the face from its place, as a share of the picture.");
  }
};

/// t_z of portraits, cm.
inline constexpr double kNearestPose = 20, kFarthestPose = -120;

/// Pitch, yaw, roll (radians), t_x, t_y, t_z (cm) of a face whose landmarks are `landmarks` (68 x 3, cm, about the
/// origin): turned at random, then placed so that the longer side of the projected landmarks' box has a random size and
/// its centre is a little below the picture's centre, shifted at random. t_z stays within kFarthestPose and kNearestPose.
std::array<float, 6> DrawPose(const geometry::Points& landmarks, const PortraitOptics& optics,
                              const PoseOptions& options, Rng& rng);

}  // namespace daumier::datasets
