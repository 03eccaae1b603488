#include "faces/source.h"

#include "faces/ict.h"
#include "faces/makehuman.h"

namespace daumier::faces {

FaceModel LoadFaceModel(const SourceOptions& options) {
  if (options.name == "ict") {
    if (options.path.empty())
      throw UsageError("source ict needs source.path: a checkout of ICT-FaceKit or its tar archive");
    return LoadIct(options.path);
  }
  return LoadMakeHuman(options.path.empty() ? DefaultMakeHumanFolder() : std::filesystem::path(options.path));
}

}  // namespace daumier::faces
