#include "rig/head_interior.h"

namespace daumier::rig {

HeadInterior::HeadInterior(const faces::FaceTemplate&) {}

}  // namespace daumier::rig
