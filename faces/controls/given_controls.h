#pragma once
#include "faces/controls/face_controls.h"
#include "faces/face_model.h"

#include <string>
#include <vector>

namespace daumier::faces {

/// Reads controls of a user's own, each "NAME=FILE.target" (a morph target of MakeHuman in the numbers and unit of the
/// source's files) or "NAME=FROM.obj,TO.obj" (two meshes, OBJ or PLY, of the template's vertices in cm, or of the source's
/// in its unit: the control at value 1 moves what FROM is to TO).
/// @throws UsageError on another form, or on a target for a source whose numbers are not known; Error naming the file
/// that cannot be read, has another number of vertices, or vertices that are not finite, or a control that moves nothing
/// or a vertex by more than a quarter of the head. Names have letters, digits, _ and -, and are none of AnatomicalControls.
std::vector<GivenControl> ReadGivenControls(const std::vector<std::string>& specifications,
                                            const FaceTemplate& face_template, const SourceNumbering& numbering);

}  // namespace daumier::faces
