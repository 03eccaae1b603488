#pragma once
#include "core/json.h"

#include <filesystem>
#include <string>

namespace daumier::deform {

/// Files of the authors' model [Jung et al. 2022].
struct AuthorsFiles {
  std::filesystem::path checkpoint;     ///< deform::ReadStateFile
  std::filesystem::path template_mesh;  ///< The template in the network's own coordinates.
  std::filesystem::path annotation;     ///< Landmarks and hairline of its vertices (docs/annotation.md).
  std::string licence;                  ///< Of the checkpoint; empty: kAuthorsLicence.
};

inline constexpr const char* kAuthorsLicence =
    "That of the authors' files: their program is AGPL-3.0, and 3DCaricShop, on which the weights were trained, is for "
    "research alone";

/// Length of a unit of the authors' coordinates where the annotation has none: their head is 2.1 units high.
inline constexpr double kAuthorsCmPerUnit = 10;

/// Writes a finished run of the task `deform` (DeformRunFolder) that decodes as the authors' program does: the SIREN
/// reads the coordinates of the template mesh unchanged, and adds to them. In the manifest the verb is "import",
/// details.imported has the checksums of the files, and there are no faces of its own. The folder is written whole or
/// not at all; it replaces an earlier run that was imported. Returns what it holds.
/// @throws Error as AuthorsModelOf, faces::ReadMesh, faces::Annotate; if the template lies elsewhere than the authors';
/// UsageError as CheckReplacedFolder.
Json ImportAuthorsModel(const AuthorsFiles& files, const std::filesystem::path& out);

}  // namespace daumier::deform
