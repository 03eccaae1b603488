#pragma once
#include "render/image.h"

namespace daumier::render {

/// Whether a picture shows something bright, such as paper, before a darker ground: one bright area, with few notches,
/// that covers 15 to 85 % of the picture, and dark on three quarters of the picture's border. Lines do not count, nor
/// does a scan whose border is dark only at some sides. Where FindSheets finds nothing there, its edge will be read as
/// lines.
bool ShowsDesk(const Image& picture);

}  // namespace daumier::render
