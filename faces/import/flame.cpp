#include "faces/import/flame.h"

#include "core/error.h"
#include "faces/import/linear_model.h"
#include "faces/import/npy.h"

#include <algorithm>

namespace daumier::faces {

FaceModel LoadFlame(const std::filesystem::path& path, const AnnotationFile& annotation) {
  if (path.extension() == ".pkl") {
    throw UsageError(fmt::format(
        "{} is a Python pickle, which can run any program and is not read; in Python, numpy.savez(\"flame.npz\", "
        "v_template=..., f=..., shapedirs=...) of its arrays",
        path.string()));
  }
  const NumberArrays arrays = ReadNpz(path, {"v_template", "f", "shapedirs"});
  const auto array = [&](const char* name) -> const NumberArray& { return ArrayOf(arrays, name, path.string()); };
  constexpr Eigen::Index kNumIdentities = 300;
  LinearFile file;
  file.source = "flame";
  file.mean = array("f").Polygons(0, array("v_template").Points());
  const Eigen::MatrixXf shapes = array("shapedirs").Matrix(file.mean.vertices.size(), -1);
  const Eigen::Index num_identities = std::min(kNumIdentities, shapes.cols());
  file.identity_shapes = shapes.leftCols(num_identities);
  file.expression_shapes = shapes.rightCols(shapes.cols() - num_identities);
  file.expression_shape_names = NumberedShapes("mode", file.expression_shapes.cols());
  file.expressions = ExpressionsOfModes(file.expression_shape_names);
  file.cm_per_unit = 100;
  file.provenance = {{"name", "FLAME"},
                     {"version", fmt::format("{} shape directions", shapes.cols())},
                     {"checksum", ""},
                     {"licence",
                      "Max Planck Institute's FLAME terms as they came with the file; they differ by version: FLAME "
                      "2020 and before are non-commercial research, 2023 Open is CC BY 4.0"}};
  return ImportLinearModel(file, annotation);
}

}  // namespace daumier::faces
