#pragma once
#include "rig/head_rig.h"

#include <filesystem>
#include <string>

namespace daumier::reports {

/// The head of a face (V x 3, cm) by a rig, with UV in its atlas, as one mesh whose first V vertices are the face's, so
/// that what reads faces of its topology reads heads too; those beyond the cut of the neck belong to no triangle.
/// Triangles: those of rig::TextureSpace. @throws Error if the face has another size.
geometry::TriangleMesh HeadInAtlas(const rig::HeadRig& rig, const geometry::Points& face);

/// Writes HeadInAtlas as OBJ, and into a file of the same name with the extension .mtl its materials, `head` and a glossy
/// `eyes`, which both have the picture `texture`, a file in the same folder. Groups: face, neck, eyes, mouth.
/// @throws Error as HeadInAtlas and geometry::WriteObj.
void WriteTexturedHead(const std::filesystem::path& path, const rig::HeadRig& rig, const geometry::Points& face,
                       const std::string& texture);

}  // namespace daumier::reports
