#pragma once
#include "core/json.h"
#include "core/options.h"
#include "core/task.h"
#include "datasets/build/landmark_file.h"
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

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "The template, where it is not that of a database.");
    visit("licence", licence, Text{}, "Licence of the meshes, copied to everything made of them.");
    visit("contour_weight", contour_weight, Range{1e-3, 1.0},
          "Trust in the landmarks 0 .. 16 of the contour, which depends on the view; the others have 1.");
    visit("registration", registration, Table{}, "How the template is brought onto a mesh.");
  }
};

/// The meshes to register and the files of their landmarks.
struct MeshInputs {
  std::vector<std::filesystem::path> meshes;  ///< OBJ or PLY, counter-clockwise seen from outside; distinct names.
  std::filesystem::path landmarks;   ///< A LandmarkFile for all meshes, or a folder with NAME.txt (or .json) for each.
  std::filesystem::path vertex_map;  ///< May be empty; see LandmarkFile.
};

/// A mesh to register.
struct LandmarkedMesh {
  std::string name;
  geometry::TriangleMesh mesh;
  MeshLandmarks landmarks;
};
/// @throws Error naming file and cause: unreadable, no surface, landmarks missing or out of range, or fewer than six.
LandmarkedMesh ReadLandmarkedMesh(const MeshInputs& inputs, int index);

/// The template specified by options and `template_folder`: that of the database in the folder, or of options.source
/// where it is empty.
faces::FaceTemplate RegistrationTemplateOf(const RegisterOptions& options,
                                           const std::filesystem::path& template_folder);

/// Writes a faces::FaceDatabase: person p is the template registered onto mesh p (geometry::NonRigidRegistration), one
/// level, the expression neutral, no identity weights. In the template's frame, in cm. The manifest names the template
/// and the meshes, each with its licence, and details.meshes the meshes' names. A shard holds besides `distances` (V,
/// cm to the target, NaN without a match) and, in its metadata, `quality`. Next to the database, quality.json holds
/// `unit`, a list `meshes` with a row a mesh, and `summary` with means over meshes and sums of flips. Distances there
/// are in millimetres, one scale a database (faces::MillimetresPerCm). Resumes an interrupted build of the same inputs.
/// @throws Error as ReadLandmarkedMesh, NonRigidRegistration and BuildShards; UsageError if there is no mesh or two of
/// a name.
void BuildRegisteredFaces(const faces::FaceTemplate& face_template, const MeshInputs& inputs,
                          const RegisterOptions& options, const std::filesystem::path& directory,
                          const Task& task = {});

/// The row of quality.json of a person: `name`, `template_to_target_mm` and `target_to_template_mm` {mean, median,
/// p95}, `landmarks_mm` (mean), `coverage`, `target_reached`, `flipped_face`, `flipped_matched`, `self_intersections`,
/// `self_intersections_at_rest`, and template_from_target {scale, rotation, translation}.
Json ReadRegistrationQuality(const std::filesystem::path& directory, int person);

}  // namespace daumier::datasets
