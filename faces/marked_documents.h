#pragma once
#include "faces/marked_points.h"

#include <string_view>

namespace daumier::faces {

/// The points of a JSON text (ReadMarkedPoints).
MarkedPoints ParseMarkedJson(std::string_view text, const std::filesystem::path& path);

/// The points of MeshLab's .pp or of an imglab XML (ReadMarkedPoints).
MarkedPoints ParseMarkedXml(std::string_view text, const std::filesystem::path& path);

}  // namespace daumier::faces
