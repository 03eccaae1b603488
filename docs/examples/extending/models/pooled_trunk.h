#pragma once
#include "models/sketch_trunks.h"

namespace daumier::models {

/// Three 3 x 3 convolutions of stride 2 with width, 2 width and 4 width channels, each with batch norm and ReLU, and the
/// mean of each channel over the picture. The number of parameters does not depend on the resolution.
SketchTrunk PooledTrunk(const TrunkOptions& options);

}  // namespace daumier::models
