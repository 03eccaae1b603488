#include "faces/import/bfm.h"

#include "core/error.h"
#include "faces/import/hdf5_file.h"
#include "faces/import/linear_model.h"
#include "faces/import/mat_file.h"

#include <fstream>
#include <utility>

namespace daumier::faces {

namespace {

constexpr const char* kLicence = "University of Basel's terms: non-commercial research, not to be passed on";

bool IsHdf5(const std::filesystem::path& file) {
  constexpr std::string_view kMagic = "\x89HDF";
  char begin[4] = {};
  std::ifstream(file, std::ios::binary).read(begin, sizeof(begin));
  return std::string_view(begin, sizeof(begin)) == kMagic;
}

LinearFile ReadBfm2009(const std::filesystem::path& path) {
  const NumberArrays arrays = ReadMatFile(path, {"shapeMU", "shapePC", "shapeEV", "tl"});
  const auto array = [&](const char* name) -> const NumberArray& { return ArrayOf(arrays, name, path.string()); };
  LinearFile file;
  file.source = "bfm";
  file.mean = array("tl").Polygons(1, array("shapeMU").Points());
  DAUMIER_CHECK(static_cast<int>(file.mean.corners.size()) == 3 * file.mean.num_polygons(), "{}: tl is not F x 3",
                path.string());
  for (size_t k = 0; k < file.mean.corners.size(); k += 3)
    std::swap(file.mean.corners[k + 1], file.mean.corners[k + 2]);
  file.identity_shapes = array("shapePC").Matrix(file.mean.vertices.size(), -1);
  file.identity_shapes *= array("shapeEV").Vector(file.identity_shapes.cols()).asDiagonal();
  file.expression_shapes.resize(file.mean.vertices.size(), 0);
  file.expressions = {NeutralExpression(0)};
  file.cm_per_unit = 1e-4;
  file.provenance = {{"name", "Basel Face Model"}, {"version", "2009"}, {"checksum", ""}, {"licence", kLicence}};
  return file;
}

LinearFile ReadBfm2017(const std::filesystem::path& path) {
  const NumberArrays arrays =
      ReadHdf5(path, {"shape/model/mean", "shape/model/pcaBasis", "shape/model/pcaVariance", "expression/model/mean",
                      "expression/model/pcaBasis", "expression/model/pcaVariance", "shape/representer/cells",
                      "representer/cells"});
  const auto array = [&](const std::string& name) -> const NumberArray& {
    return ArrayOf(arrays, name, path.string());
  };
  LinearFile file;
  file.source = "bfm";
  const auto scaled_basis = [&](const std::string& model) -> Eigen::MatrixXf {
    const Eigen::MatrixXf basis = array(model + "/pcaBasis").Matrix(file.mean.vertices.size(), -1);
    const Eigen::VectorXf variance = array(model + "/pcaVariance").Vector(basis.cols());
    DAUMIER_CHECK((variance.array() >= 0).all(), "{}: {}/pcaVariance is negative", path.string(), model);
    return basis * variance.cwiseSqrt().asDiagonal();
  };
  const char* const cells = arrays.count("representer/cells") ? "representer/cells" : "shape/representer/cells";
  file.mean = array(cells).Transposed().Polygons(0, array("shape/model/mean").Points());
  file.identity_shapes = scaled_basis("shape/model");
  const Eigen::MatrixXf modes = scaled_basis("expression/model");
  file.expression_shapes.resize(modes.rows(), modes.cols() + 1);
  file.expression_shapes << array("expression/model/mean").Vector(modes.rows()), modes;
  file.expression_shape_names = NumberedShapes("mode", modes.cols());
  file.expression_shape_names.insert(file.expression_shape_names.begin(), "mean_expression");
  file.expressions = ExpressionsOfModes(file.expression_shape_names, 1);
  file.cm_per_unit = 0.1;
  file.provenance = {
      {"name", "Basel Face Model"}, {"version", "2017 or 2019"}, {"checksum", ""}, {"licence", kLicence}};
  return file;
}

}  // namespace

FaceModel LoadBfm(const std::filesystem::path& file, const AnnotationFile& annotation) {
  DAUMIER_CHECK(std::filesystem::exists(file), "{} does not exist", file.string());
  DAUMIER_CHECK(std::filesystem::file_size(file) > 0, "{} is empty. Copy or download it again", file.string());
  const bool is_hdf5 = IsHdf5(file) || file.extension() == ".h5";  // Damaged ones are named by what they should be.
  return ImportLinearModel(is_hdf5 ? ReadBfm2017(file) : ReadBfm2009(file), annotation);
}

}  // namespace daumier::faces
