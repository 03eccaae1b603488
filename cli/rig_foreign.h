#pragma once
#include "cli/rig_face.h"
#include "core/json.h"
#include "faces/face_model.h"
#include "render/sheet.h"
#include "rig/rigged_head.h"

#include <filesystem>
#include <vector>

namespace daumier::cli {

/// A head of another topology than a face model's, rigged.
struct RiggedForeignHead {
  rig::RiggedHead head;         ///< cm, y up, the face to +z: the head's own vertices, turned and scaled alone.
  geometry::Points registered;  ///< The model's template on it, V x 3, cm, in the head's frame.
  std::vector<render::SheetCell> stages;  ///< The head with the landmarks that were found.
  Json facts;                             ///< What the command prints: axes, unit, landmarks, registration, slits, cut.
};

/// Whether the head has the materials of its file, or is to be covered by another texture.
enum class TakenLook { kOwn, kNone };

/// Whether lips and lids that are sealed are opened (rig::OpenSealedSlits).
enum class SealedSlits { kKept, kCut };

/// Rigs a mesh by landmarks of a file, or by those that the shipped network finds in pictures of it. Logs what it takes for
/// granted (axes, unit) and what the head lacks.
/// @throws Error naming the mesh, the cause and the repair: a vertex in use that is not finite, no triangles, no face, two
/// faces, landmarks that do not fit, a registration that fails.
RiggedForeignHead RigForeignHead(const GivenFace& given, const std::filesystem::path& landmarks,
                                 const faces::FaceModel& model, TakenLook look,
                                 SealedSlits sealed = SealedSlits::kKept);

/// The 52 targets of a face model on the vertices of another topology's mean face.
struct CarriedTargets {
  rig::MorphTargets targets;  ///< 3V x 52, cm, in the frame of the other template.
  Json registration;          ///< A row of quality.json (docs/registration.md).
};

/// Registers the model by the landmarks of both annotations. @throws Error as RegisterMesh and ForeignRig.
CarriedTargets CarryTargetsTo(const faces::FaceTemplate& face, const faces::FaceModel& model);

}  // namespace daumier::cli
