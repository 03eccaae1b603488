#pragma once
#include "faces/finished_head.h"

#include <filesystem>

namespace daumier::reports {

/// Writes the finished head of a face (V x 3, cm) as OBJ, and the colours of its materials (LookOf) into a file of the
/// same name with the extension .mtl. The first V vertices are the face's; those beyond the cut of the neck belong to no
/// polygon. Groups: face, neck, eyes, mouth. @throws Error as geometry::WriteObj and faces::FinishedHead::Vertices.
void WriteHead(const std::filesystem::path& path, const faces::FinishedHead& head, const geometry::Points& face);

}  // namespace daumier::reports
