#include "faces/face_model_file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/safetensors.h"
#include "core/weights_folder.h"
#include "faces/face_database.h"
#include "faces/scaled_shapes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace daumier::faces {
namespace {

namespace fs = std::filesystem;

constexpr int kModelVersion = 1;
constexpr std::array<std::pair<IdentityControl::Kind, const char*>, 3> kControlKinds = {
    {{IdentityControl::Kind::kGaussian, "gaussian"},
     {IdentityControl::Kind::kBipolar, "bipolar"},
     {IdentityControl::Kind::kSimplex, "simplex"}}};

Json ControlToJson(const IdentityControl& control) {
  const auto* const kind = std::ranges::find(kControlKinds, control.kind, [](const auto& pair) { return pair.first; });
  return {{"name", control.name}, {"kind", kind->second}, {"shapes", control.shapes}, {"sigma", control.sigma}};
}

IdentityControl ControlFromJson(const Json& json, Eigen::Index num_shapes) {
  IdentityControl control{.name = json.at("name"), .shapes = json.at("shapes"), .sigma = json.at("sigma")};
  const auto name = json.at("kind").get<std::string>();
  const auto* const kind = std::ranges::find(kControlKinds, name, [](const auto& pair) { return pair.second; });
  DAUMIER_CHECK(kind != kControlKinds.end(), "the control '{}' is of unknown kind '{}'", control.name, name);
  control.kind = kind->first;
  for (const int shape : control.shapes)
    DAUMIER_CHECK(shape >= -1 && shape < num_shapes, "the control '{}' names shape {} of {}", control.name, shape,
                  num_shapes);
  return control;
}

/// {name, weights: {shape: weight}}, without weights of 0.
Json ExpressionToJson(const Expression& expression, const std::vector<std::string>& shapes) {
  Json weights = Json::object();
  for (size_t e = 0; e < shapes.size(); ++e)
    if (expression.weights[Eigen::Index(e)] != 0) weights[shapes[e]] = expression.weights[Eigen::Index(e)];
  return {{"name", expression.name}, {"weights", std::move(weights)}};
}

Expression ExpressionFromJson(const Json& json, const std::vector<std::string>& shapes) {
  Expression expression{json.at("name"), Eigen::VectorXf::Zero(Eigen::Index(shapes.size()))};
  for (const auto& [name, weight] : json.at("weights").items()) {
    const auto found = std::ranges::find(shapes, name);
    DAUMIER_CHECK(found != shapes.end(), "the expression '{}' names the shape '{}', which the model does not have",
                  expression.name, name);
    expression.weights[found - shapes.begin()] = weight.get<float>();
  }
  return expression;
}

Json ModelToJson(const FaceModel& model) {
  Json controls = Json::array(), expressions = Json::array();
  for (const IdentityControl& control : model.identity_controls) controls.push_back(ControlToJson(control));
  for (const Expression& expression : model.expressions)
    expressions.push_back(ExpressionToJson(expression, model.expression_shape_names));
  return {{"format_version", kModelVersion},           {"align_identities", model.align_identities},
          {"identity_controls", std::move(controls)},  {"expression_shapes", model.expression_shape_names},
          {"expressions", std::move(expressions)},     {"source_vertices", model.numbering.num_vertices},
          {"cm_per_unit", model.numbering.cm_per_unit}};
}

/// All but template, shapes and the numbers of vertices.
void ReadModelText(const Json& text, FaceModel& model) {
  const Json version = text.at("format_version");
  DAUMIER_CHECK(version == kModelVersion, "format version {} is not supported (expected {})", version.dump(),
                kModelVersion);
  model.align_identities = text.at("align_identities").get<bool>();
  for (const Json& control : text.at("identity_controls"))
    model.identity_controls.push_back(ControlFromJson(control, model.identity_shapes.cols()));
  model.expression_shape_names = text.at("expression_shapes").get<std::vector<std::string>>();
  DAUMIER_CHECK(Eigen::Index(model.expression_shape_names.size()) == model.expression_shapes.cols(),
                "{} names of expression shapes, expected {}", model.expression_shape_names.size(),
                model.expression_shapes.cols());
  for (const Json& expression : text.at("expressions"))
    model.expressions.push_back(ExpressionFromJson(expression, model.expression_shape_names));
  model.numbering.num_vertices = text.at("source_vertices").get<int>();
  model.numbering.cm_per_unit = text.at("cm_per_unit").get<double>();
}

void ReadNumbering(const SafetensorsFile& arrays, FaceModel& model) {
  if (!arrays.contains("numbering")) return;
  const auto numbers = arrays.at("numbering").As<int32_t>();
  DAUMIER_CHECK(int(numbers.size()) == model.face_template.num_vertices(), "'numbering' has {} vertices, expected {}",
                numbers.size(), model.face_template.num_vertices());
  model.numbering.vertices.assign(numbers.begin(), numbers.end());
}

double LargestLength(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b, const char* what) {
  DAUMIER_CHECK(a.rows() == b.rows() && a.cols() == b.cols(), "{} shapes are {} x {} and {} x {}", what, a.rows(),
                a.cols(), b.rows(), b.cols());
  double largest = 0;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    const Eigen::VectorXf difference = a.col(k) - b.col(k);
    for (Eigen::Index v = 0; v + 2 < difference.size(); v += 3)
      largest = std::max(largest, double(difference.segment<3>(v).norm()));
  }
  return largest;
}

}  // namespace

std::map<std::string, std::string> WriteFaceModel(const fs::path& directory, const FaceModel& model) {
  auto checksums = WriteFaceTemplate(directory, model.face_template);
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "face model");
  AddScaledShapes(writer, "identity", model.identity_shapes, kShapeToleranceCm);
  AddScaledShapes(writer, "expression", model.expression_shapes, kShapeToleranceCm);
  if (!model.numbering.vertices.empty())
    writer.Add<int32_t>("numbering", {int64_t(model.numbering.vertices.size())}, model.numbering.vertices);
  checksums[kModelShapes] = writer.Write(directory / kModelShapes);
  const std::string text = ModelToJson(model).dump(1) + "\n";
  WriteFileAtomically(directory / kModelText, text);
  checksums[kModelText] = Sha256(text);
  return checksums;
}

FaceModel ReadFaceModel(const fs::path& directory) {
  const fs::path shapes_file = directory / kModelShapes, text_file = directory / kModelText;
  FaceModel model;
  model.face_template = ReadFaceTemplate(directory);
  const SafetensorsFile arrays(shapes_file);
  model.identity_shapes = ReadScaledShapes(arrays, "identity", shapes_file);
  model.expression_shapes = ReadScaledShapes(arrays, "expression", shapes_file);
  const Eigen::Index rows = 3 * Eigen::Index(model.face_template.num_vertices());
  for (const Eigen::MatrixXf* shapes : {&model.identity_shapes, &model.expression_shapes})
    DAUMIER_CHECK(shapes->cols() == 0 || shapes->rows() == rows, "{}: shapes of {} vertices, but the template has {}",
                  shapes_file.string(), shapes->rows() / 3, model.face_template.num_vertices());
  const Json text = ReadJson(text_file);
  try {
    ReadModelText(text, model);
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", text_file.string(), TextOf(error)));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", text_file.string(), error.what()));
  }
  try {
    ReadNumbering(arrays, model);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", shapes_file.string(), error.what()));
  }
  return model;
}

FaceModel ReadFaceModelWeights(const fs::path& directory, const std::string& source) {
  ReadWeights(directory, kFaceModelSystem, {kModelText, kModelShapes});
  FaceModel model = ReadFaceModel(directory);
  DAUMIER_CHECK(source.empty() || model.face_template.source == source,
                "{} is a face model of the source '{}' (expected '{}'). Set source.name={}", directory.string(),
                model.face_template.source, source, model.face_template.source);
  return model;
}

ModelDifference DifferenceOf(const FaceModel& a, const FaceModel& b) {
  return {LargestLength(a.identity_shapes, b.identity_shapes, "identity"),
          LargestLength(a.expression_shapes, b.expression_shapes, "expression")};
}

}  // namespace daumier::faces
