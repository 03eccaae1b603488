#include "faces/morphable_model.h"

#include "core/error.h"
#include "core/manifest.h"
#include "core/safetensors.h"
#include "faces/principal_components.h"
#include "geometry/coordinates.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <functional>

namespace daumier::faces {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMorphableFile = "morphable.safetensors";
constexpr double kLeastComponent = 1e-6;

geometry::Vector3 LandmarkMean(const FaceTemplate& face_template) {
  geometry::Vector3 sum = geometry::Vector3::Zero();
  for (const int vertex : face_template.annotation.landmarks) sum += face_template.neutral.row(vertex).transpose();
  return sum / double(face_template.annotation.landmarks.size());
}

/// All but the identity modes.
MorphableModel WithoutIdentity(const FaceModel& source, const AlbedoModes& albedo) {
  const FaceTemplate& face_template = source.face_template;
  const Eigen::Index num_vertices = face_template.num_vertices();
  DAUMIER_CHECK(source.expression_shapes.cols() <= kExpressionSlot.count,
                "{} has {} expression shapes; a portrait's coefficients hold {} at most", face_template.source,
                source.expression_shapes.cols(), kExpressionSlot.count);
  DAUMIER_CHECK(albedo.mean.rows() == num_vertices && albedo.mean.cols() == 3 &&
                    albedo.modes.rows() == 3 * num_vertices && albedo.modes.cols() <= kAlbedoSlot.count,
                "colours are {} x {} with modes {} x {}, expected {} x 3 with modes {} x at most {}",
                albedo.mean.rows(), albedo.mean.cols(), albedo.modes.rows(), albedo.modes.cols(), num_vertices,
                3 * num_vertices, kAlbedoSlot.count);
  MorphableModel model;
  model.face_template = face_template;
  model.centre = LandmarkMean(face_template);
  model.face_template.neutral.rowwise() -= model.centre.transpose();
  model.expression = source.expression_shapes;
  model.expression_names = source.expression_shape_names;
  model.expression_weights = face_template.source == "bfm" || face_template.source == "flame"
                                 ? ExpressionWeights::kStandardNormal
                                 : ExpressionWeights::kUnit;
  model.albedo_mean = albedo.mean;
  model.albedo_modes = albedo.modes;
  return model;
}

void AddFloatRows(SafetensorsWriter& writer, const std::string& name, const Eigen::MatrixXf& matrix) {
  const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
  writer.Add<float>(name, {rows.rows(), rows.cols()}, {rows.data(), size_t(rows.size())});
}

Eigen::MatrixXf MatrixIn(const SafetensorsFile& arrays, const std::string& name, const fs::path& file) {
  const ArrayView& array = arrays.at(name);
  DAUMIER_CHECK(array.shape.size() == 2, "{}: '{}' has {} dimensions, expected 2", file.string(), name,
                array.shape.size());
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(array.As<float>().data(), array.shape[0], array.shape[1]);
}

Eigen::VectorXf SlotOf(std::span<const float> coefficients, const CoefficientSlot& slot, Eigen::Index modes) {
  return Eigen::Map<const Eigen::VectorXf>(coefficients.data() + slot.first, modes);
}

}  // namespace

MorphableModel ModelOfShapes(const FaceModel& source, const AlbedoModes& albedo) {
  MorphableModel model = WithoutIdentity(source, albedo);
  const auto count = std::min<Eigen::Index>(kIdentitySlot.count, Eigen::Index(source.identity_controls.size()));
  model.identity.resize(source.identity_shapes.rows(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const IdentityControl& control = source.identity_controls[size_t(i)];
    DAUMIER_CHECK(control.kind == IdentityControl::Kind::kGaussian && control.shapes.size() == 1,
                  "identity control '{}' of {} is no standard deviation of a shape: use the principal components of "
                  "faces (identity=components)",
                  control.name, source.face_template.source);
    model.identity.col(i) = float(control.sigma) * source.identity_shapes.col(control.shapes.front());
  }
  model.identity_source = "shapes";
  return model;
}

MorphableModel ModelOfFaces(const FaceModel& source, const AlbedoModes& albedo, int num_faces,
                            const std::function<std::span<const float>(int)>& face) {
  DAUMIER_CHECK(num_faces >= 2, "{} faces have no principal components; expected two or more", num_faces);
  const int num_coordinates = 3 * source.face_template.num_vertices();
  const SnapshotComponents components = FindComponents(GramMatrix(num_faces, num_coordinates, face, Centring::kMean),
                                                       std::min(kIdentitySlot.count, num_faces - 1), kLeastComponent);
  // Columns of W sum to 0 over the faces, so that W^T X is the same of faces with and without their mean.
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(num_coordinates);
  Eigen::MatrixXf modes = Eigen::MatrixXf::Zero(num_coordinates, components.weights.cols());
  const Eigen::MatrixXf weights = components.weights.cast<float>();
  Eigen::VectorXf first = Eigen::Map<const Eigen::VectorXf>(face(0).data(), num_coordinates);
  for (int i = 0; i < num_faces; ++i) {
    const Eigen::Map<const Eigen::VectorXf> coordinates(face(i).data(), num_coordinates);
    mean += coordinates.cast<double>();
    modes += (coordinates - first) * weights.row(i);
  }
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    modes.col(k) *= float(std::sqrt(components.variances[k] / num_faces));
    FixSign(modes.col(k));
  }
  mean /= num_faces;
  const Eigen::VectorXf mean_coordinates = mean.cast<float>();
  return ModelOfModes(source, albedo, geometry::PointsFrom({mean_coordinates.data(), size_t(num_coordinates)}),
                      std::move(modes), "components");
}

MorphableModel ModelOfModes(const FaceModel& source, const AlbedoModes& albedo, const geometry::Points& mean,
                            Eigen::MatrixXf modes, const std::string& identity_source) {
  MorphableModel model = WithoutIdentity(source, albedo);
  DAUMIER_CHECK(mean.rows() == source.face_template.neutral.rows() && modes.rows() == mean.size() &&
                    modes.cols() <= kIdentitySlot.count,
                "a mean shape of {} vertices and modes {} x {}, expected {} and {} x at most {}", mean.rows(),
                modes.rows(), modes.cols(), source.face_template.neutral.rows(), source.face_template.neutral.size(),
                kIdentitySlot.count);
  model.identity = std::move(modes);
  model.face_template.neutral = mean.rowwise() - model.centre.transpose();
  model.identity_source = identity_source;
  return model;
}

std::string NameOf(ExpressionWeights weights) {
  return weights == ExpressionWeights::kUnit ? "unit" : "standard normal";
}

ExpressionWeights ExpressionWeightsNamed(const std::string& name) {
  for (const ExpressionWeights weights : {ExpressionWeights::kUnit, ExpressionWeights::kStandardNormal})
    if (NameOf(weights) == name) return weights;
  throw Error(fmt::format("expression_weights is '{}', expected 'unit' or 'standard normal'", name));
}

std::vector<int> NeutralFaces(const FaceDatabase& database, const std::vector<int>& persons) {
  std::vector<int> faces;
  for (const int person : persons)
    for (int level = 0; level < database.num_levels(); ++level) faces.push_back(database.index({person, level, 0}));
  return faces;
}

ColouredFace Reconstruct(const MorphableModel& model, std::span<const float> coefficients) {
  DAUMIER_CHECK(coefficients.size() == size_t(kNumCoefficients), "{} coefficients of a portrait, expected {}",
                coefficients.size(), kNumCoefficients);
  const Eigen::VectorXf offset = model.identity * SlotOf(coefficients, kIdentitySlot, model.identity.cols()) +
                                 model.expression * SlotOf(coefficients, kExpressionSlot, model.expression.cols());
  const Eigen::VectorXf colours = model.albedo_modes * SlotOf(coefficients, kAlbedoSlot, model.albedo_modes.cols());
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return {model.face_template.neutral + geometry::PointsFrom({offset.data(), size_t(offset.size())}),
          model.albedo_mean + Eigen::Map<const Rows>(colours.data(), colours.size() / 3, 3)};
}

Eigen::VectorXf FitIdentity(const MorphableModel& model, const geometry::Points& neutral, double ridge) {
  const Eigen::Index num_vertices = model.face_template.num_vertices();
  DAUMIER_CHECK(neutral.rows() == num_vertices, "a face of {} vertices, expected {}", neutral.rows(), num_vertices);
  const geometry::Points difference = neutral - model.face_template.neutral;
  const Eigen::VectorXd target = Eigen::Map<const Eigen::VectorXd>(difference.data(), difference.size());
  const Eigen::MatrixXd modes = model.identity.cast<double>();
  Eigen::MatrixXd matrix = modes.transpose() * modes;
  matrix.diagonal().array() += ridge * double(num_vertices);
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(kIdentitySlot.count);
  weights.head(modes.cols()) = matrix.llt().solve(modes.transpose() * target).cast<float>();
  return weights;
}

std::map<std::string, std::string> WriteMorphableFiles(const fs::path& directory, const MorphableModel& model) {
  auto checksums = WriteFaceTemplate(directory, model.face_template);
  SafetensorsWriter writer;
  AddFloatRows(writer, "identity", model.identity);
  AddFloatRows(writer, "expression", model.expression);
  AddFloatRows(writer, "albedo_mean", model.albedo_mean);
  AddFloatRows(writer, "albedo_modes", model.albedo_modes);
  writer.Add<double>("centre", {3}, {model.centre.data(), 3});
  writer.SetMetadata("kind", "morphable model");
  writer.SetMetadata("expression_names", Json(model.expression_names).dump());
  writer.SetMetadata("expression_weights", NameOf(model.expression_weights));
  writer.SetMetadata("identity_source", model.identity_source);
  checksums[kMorphableFile] = writer.Write(directory / kMorphableFile);
  return checksums;
}

void WriteMorphableModel(const fs::path& directory, const MorphableModel& model) {
  Manifest manifest{.kind = "morphable model", .verb = "train"};
  manifest.sources = Json::array({model.face_template.provenance});
  manifest.counts = {{"vertices", model.face_template.num_vertices()},
                     {"identity_modes", model.identity.cols()},
                     {"expression_shapes", model.expression.cols()},
                     {"albedo_modes", model.albedo_modes.cols()}};
  manifest.checksums = WriteMorphableFiles(directory, model);
  WriteManifest(directory, manifest);
}

MorphableModel ReadMorphableModel(const fs::path& directory) {
  const fs::path file = directory / kMorphableFile;
  const SafetensorsFile arrays(file);
  MorphableModel model;
  model.face_template = ReadFaceTemplate(directory);
  model.identity = MatrixIn(arrays, "identity", file);
  model.expression = MatrixIn(arrays, "expression", file);
  model.albedo_mean = MatrixIn(arrays, "albedo_mean", file);
  model.albedo_modes = MatrixIn(arrays, "albedo_modes", file);
  const ArrayView& centre = arrays.at("centre");
  DAUMIER_CHECK(centre.size() == 3, "{}: 'centre' has {} numbers, expected 3", file.string(), centre.size());
  std::copy_n(centre.As<double>().begin(), 3, model.centre.data());
  const auto text = [&](const char* key) {
    const auto found = arrays.metadata().find(key);
    DAUMIER_CHECK(found != arrays.metadata().end(), "{}: metadata '{}' is missing", file.string(), key);
    return found->second;
  };
  try {
    model.expression_names = Json::parse(text("expression_names")).get<std::vector<std::string>>();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: 'expression_names' is malformed: {}", file.string(), TextOf(error)));
  }
  const std::string weights = text("expression_weights");
  try {
    model.expression_weights = ExpressionWeightsNamed(weights);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
  model.identity_source = text("identity_source");
  const Eigen::Index coordinates = 3 * Eigen::Index(model.face_template.num_vertices());
  DAUMIER_CHECK(model.identity.rows() == coordinates && model.expression.rows() == coordinates &&
                    model.albedo_modes.rows() == coordinates && model.albedo_mean.rows() * 3 == coordinates &&
                    model.albedo_mean.cols() == 3 && model.identity.cols() <= kIdentitySlot.count &&
                    model.expression.cols() == Eigen::Index(model.expression_names.size()) &&
                    model.expression.cols() <= kExpressionSlot.count && model.albedo_modes.cols() <= kAlbedoSlot.count,
                "{}: the shapes do not belong to a template of {} vertices, or are too many", file.string(),
                coordinates / 3);
  return model;
}

}  // namespace daumier::faces
