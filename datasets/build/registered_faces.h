#pragma once
#include "core/json.h"
#include "core/options.h"
#include "core/task.h"
#include "datasets/build/landmark_fit.h"
#include "datasets/build/registration_inputs.h"
#include "faces/face_model.h"
#include "faces/source.h"
#include "geometry/registration.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::datasets {

struct RegisterOptions {
  faces::SourceOptions source;
  std::string licence = "unknown";
  double contour_weight = 0.1;
  geometry::RegistrationOptions registration;
  RegistrationLimits limits;

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "The template, where it is not that of a database.");
    visit("licence", licence, Text{}, "Licence of the meshes, copied to everything made of them.");
    visit("contour_weight", contour_weight, Range{1e-3, 1.0},
          "Weight of the contour landmarks 0 .. 16, whose places depend on the view; the other landmarks weigh 1.");
    visit("registration", registration, Table{}, "How the template is brought onto a mesh.");
    visit("limits", limits, Table{}, "When a registration has failed.");
  }
};

/// The template specified by options and `template_folder`: that of the database in the folder, or of options.source
/// where it is empty.
faces::FaceTemplate RegistrationTemplateOf(const RegisterOptions& options,
                                           const std::filesystem::path& template_folder);

/// A mesh that could not be read or registered.
struct FailedMesh {
  std::string name;
  std::string cause;  ///< With the repair.
};

/// Writes a faces::FaceDatabase: person p is the template registered onto the p-th mesh that could be registered
/// (geometry::NonRigidRegistration), one level, the expression neutral, no identity weights. In the template's frame,
/// in cm. The manifest names the template and the meshes, each with its licence, details.meshes the persons' names,
/// and details.failed {name: cause} the meshes that are no persons, where there are any. A shard holds besides
/// `distances` (V, cm to the target, NaN without a match) and, in its metadata, `quality`. Next to the database,
/// quality.json holds `unit`, a list `meshes` with a row a person, and `summary` with means over them, sums of flips,
/// and `failed`. Distances there are in millimetres, one scale a database (faces::MillimetresPerCm). Resumes an
/// interrupted build of the same inputs. Returns the meshes that failed: they cannot be read, their landmarks do not
/// fit (FaultOfLandmarks), the registration throws, or its result is beyond options.limits. Meshes that are inside
/// out are turned, with a warning.
/// @throws Error as BuildShards, and if all meshes failed, with their causes: then nothing is written. UsageError if
/// there is no mesh or two of a name.
std::vector<FailedMesh> BuildRegisteredFaces(const faces::FaceTemplate& face_template, const MeshInputs& inputs,
                                             const RegisterOptions& options, const std::filesystem::path& directory,
                                             const Task& task = {});

/// A template on one mesh.
struct RegisteredMesh {
  geometry::Points vertices;                  ///< V x 3, cm, in the template's frame.
  Eigen::VectorXd distances;                  ///< V: cm to the mesh, NaN without a match.
  geometry::Similarity template_from_target;  ///< By the landmarks.
  Json row;                                   ///< Of quality.json.
};

/// The template brought onto a mesh with landmarks, a person of BuildRegisteredFaces. @throws Error where that lists the
/// mesh as failed.
RegisteredMesh RegisterMesh(const faces::FaceTemplate& face_template, LandmarkedMesh mesh,
                            const RegisterOptions& options = {});
/// The same for the one mesh of `inputs`.
RegisteredMesh RegisterMesh(const faces::FaceTemplate& face_template, const MeshInputs& inputs,
                            const RegisterOptions& options = {});

/// "2 of 5 meshes failed:" and a line for each.
std::string ListFailures(const std::vector<FailedMesh>& failed, size_t num_meshes);

/// The row of quality.json of a person: `name`, `template_to_target_mm` and `target_to_template_mm` {mean, median,
/// p95} (null without a match), `landmarks_mm` (mean), `coverage`, `target_reached`, `flipped_face`, `flipped_matched`,
/// `self_intersections`, `self_intersections_at_rest`, template_from_target {scale, rotation, translation}, and
/// `turned_inside_out` where the triangles of the mesh were turned.
Json ReadRegistrationQuality(const std::filesystem::path& directory, int person);

}  // namespace daumier::datasets
