#pragma once
#include "rig/weights_clip.h"

#include <string>
#include <vector>

namespace daumier::rig {

/// Five seconds that show what a head can do: neutral, a blink, an open mouth, a smile, a look to either side, up and
/// down, a nod, neutral. It names all of `targets`, and moves those that have ARKit names; weights change smoothly, 0 .. 1; the
/// first and the last 0.1 s are neutral, so that it repeats without a jump.
WeightsClip DemoClip(const std::vector<std::string>& targets);

}  // namespace daumier::rig
