#pragma once
#include "core/options.h"
#include "core/random.h"
#include "faces/face_model.h"
#include "render/camera.h"

namespace daumier::datasets {

/// One orthographic camera for all faces of a database: the curves of the mean neutral face in a view are centred on
/// the canvas of render::kSketchCanvas pixels and span `curve_height` of it; larger faces stay within the margin. The
/// side view is that of the face's own right side. @throws Error if the template has no curve in the view.
render::Camera SketchCamera(const faces::FaceTemplate& face_template, faces::View view, double curve_height);

/// How far views stray from the exact one [Han et al. 2017, section 4.4]: standard deviations of normal distributions
/// that are cut off at twice as much.
struct ViewNoise {
  double yaw = 4;
  double pitch = 4;
  double roll = 2;
  double scale = 0.03;
  double shift = 2;

  template <class V>
  void Visit(V&& visit) {
    visit("yaw", yaw, Range{0, 30}, "Standard deviation of the turn to a side, degrees.");
    visit("pitch", pitch, Range{0, 30}, "Standard deviation of the nod, degrees.");
    visit("roll", roll, Range{0, 30}, "Standard deviation of the rotation in the picture plane, degrees.");
    visit("scale", scale, Range{0, 0.3}, "Standard deviation of the relative size.");
    visit("shift", shift, Range{0, 32}, "Standard deviation of the shift along x and along y, pixels of the canvas.");
  }
};

/// Views in which a face is turned far to a side.
struct TurnedViews {
  int count = 0;
  double least = 20;
  double greatest = 50;

  template <class V>
  void Visit(V&& visit) {
    visit("count", count, Range{0, 100},
          "Further sketches of a face, turned to a random side. Networks that read sketches do not see them; styled "
          "drawings do.");
    visit("least", least, Range{0, 80}, "Least turn, degrees.");
    visit("greatest", greatest, Range{0, 80}, "Greatest turn, degrees.");
  }
};

/// The camera with the face turned to one side or the other, by an angle between the two, and then NoisyCamera with the
/// noise of everything but yaw. @throws Error if the least turn is above the greatest.
render::Camera TurnedViewCamera(const render::Camera& camera, const TurnedViews& views, const ViewNoise& noise,
                                Rng& rng);

/// The camera turned about the point that it looks at, scaled and shifted by random amounts; the camera itself where
/// all noise is 0.
render::Camera NoisyCamera(const render::Camera& camera, const ViewNoise& noise, Rng& rng);

}  // namespace daumier::datasets
