#pragma once
#include "core/task.h"
#include "gltf/head_reader.h"
#include "studio/job_options.h"

#include <filesystem>

namespace daumier::studio {

/// Files of a rigged head at rest, other than those that `daumier rig` and `avatar` write.

/// Its mesh with both eyes, cm, by the suffix of the file: OBJ with UV, a .mtl of the same name and the atlas texture.png, where the head
/// has one; or PLY with UV. Hair, which has no UV, is NAME_hair.obj or .ply next to it, of one colour. @throws Error as
/// geometry::WriteObj and WritePly.
void WriteHeadMesh(const std::filesystem::path& file, const gltf::HeadInFile& head);

/// WriteTurntable of the head as it is seen in other programs. @throws Error as WriteTurntable.
void WriteHeadTurntable(const std::filesystem::path& folder, const gltf::HeadInFile& head,
                        const TurntableOptions& options, const Task& task);

}  // namespace daumier::studio
