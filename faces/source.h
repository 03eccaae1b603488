#pragma once
#include "core/options.h"
#include "faces/face_model.h"
#include "faces/import/given_faces.h"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace daumier::faces {

/// The names of the table of sources, in its order, and what `source.path` is of each.
std::vector<std::string> SourceNames();
std::string SourcePathHelp();

struct SourceOptions {
  std::string name = "makehuman";
  std::string path = "";
  std::string annotation = "";
  std::string template_mesh = "";
  std::string person = "file";
  std::string licence = "unknown; set source.licence";

  template <class V>
  void Visit(V&& visit) {
    visit("name", name, Choices{SourceNames()}, "Source of the faces (docs/importers.md).");
    visit("path", path, Text{}, SourcePathHelp());
    visit("annotation", annotation, Text{},
          "JSON file with landmarks, regions and curves of the topology (docs/annotation.md). makehuman and ict have "
          "theirs built in.");
    visit("template_mesh", template_mesh, Text{},
          "facewarehouse: a mesh with the polygons, if no OBJ is next to shape.bs.");
    visit("person", person, Choices{{"file", "folder"}},
          "meshes: every file shows another person (file), or all files of one folder show the same person (folder).");
    visit("licence", licence, Text{}, "meshes: licence of the meshes, copied into every manifest and model card.");
  }
};

/// The name of the source that a file or folder is of, by its content; nothing for any other.
/// - a folder that `daumier dataset model` wrote: as its manifest names it;
/// - MakeHuman (package or checkout), ICT-FaceKit (checkout, its FaceXModel, or a tar archive), a folder of Tester_1 .. (facewarehouse);
/// - .npz with v_template (flame) or shape_bm_core (facescape); .mat and .h5 (bfm); .pkl (flame, which is refused when it is read).
std::optional<std::string> RecognisedSource(const std::filesystem::path& path);

/// What a source gives, in centimetres and annotated: a model of which faces are drawn, or given faces.
using LoadedSource = std::variant<FaceModel, GivenFaces>;

/// A row of the table of sources, which is in source.cpp.
struct FaceSource {
  const char* name;  ///< `source.name`.
  const char* path;  ///< What `source.path` is: "a folder".
  /// Whether a file or folder, which may be absent, is of it; null: `source.name` has to name it.
  bool (*recognises)(const std::filesystem::path& path) = nullptr;
  LoadedSource (*load)(const SourceOptions& options) = nullptr;  ///< Reads nothing but what the options name.
  bool path_may_be_empty = false;
};

/// The description of the topology that `source.annotation` names. @throws UsageError if it names none; Error as
/// ParseAnnotationFile.
AnnotationFile ReadSourceAnnotation(const SourceOptions& options);

/// By the row of options.name.
/// @throws Error naming what is missing, truncated or of another topology, and how to get it; UsageError if the path or
/// the annotation is required and missing.
LoadedSource LoadSource(const SourceOptions& options);

/// The face model of a source. @throws Error as LoadSource, and UsageError if the source gives no model.
FaceModel LoadFaceModel(const SourceOptions& options);

}  // namespace daumier::faces
