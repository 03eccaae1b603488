#include "systems/deform/import_authors_model.h"

#include "core/config.h"
#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/safetensors.h"
#include "core/staged_directory.h"
#include "faces/annotate.h"
#include "faces/face_database.h"
#include "faces/import/mesh_folder.h"
#include "systems/deform/authors_model.h"
#include "systems/deform/options.h"
#include "systems/deform/run_folder.h"

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

/// The box of the authors' template: x +-0.85, y -0.71 .. 1.40, z -1.15 .. 0.63.
const Eigen::RowVector3d kLow(-0.85, -0.71, -1.15), kHigh(0.85, 1.40, 0.63);

constexpr const char* kImportVerb = "import";

/// @throws Error unless the box of the mesh is about that of the authors' template, for which the network was trained.
void CheckPlace(const geometry::Points& vertices, const std::string& file) {
  constexpr double kMostUnits = 1;
  const Eigen::RowVector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  const double away = std::max((low - kLow).cwiseAbs().maxCoeff(), (high - kHigh).cwiseAbs().maxCoeff());
  DAUMIER_CHECK(
      away <= kMostUnits,
      "{}: the mesh lies at x {:.3g} .. {:.3g}, y {:.3g} .. {:.3g}, z {:.3g} .. {:.3g}, expected about x -0.85 "
      ".. 0.85, y -0.71 .. 1.4, z -1.15 .. 0.63: the network reads the coordinates of the template that it was "
      "trained with. Name the authors' template, unchanged",
      file, low.x(), high.x(), low.y(), high.y(), low.z(), high.z());
}

struct ImportedTemplate {
  faces::FaceTemplate face_template;
  geometry::Points vertices;  ///< Of the network.
  double cm_per_unit = 1;
};

ImportedTemplate ReadTemplate(const AuthorsFiles& files) {
  geometry::PolygonMesh mesh = faces::ReadMesh(files.template_mesh);
  DAUMIER_CHECK(mesh.vertices.allFinite(), "{}: a coordinate is not finite", files.template_mesh.string());
  CheckPlace(mesh.vertices, files.template_mesh.string());
  const faces::AnnotationFile annotation =
      faces::ParseAnnotationFile(ReadFile(files.annotation), files.annotation.string());
  ImportedTemplate result;
  result.cm_per_unit = annotation.cm_per_unit.value_or(kAuthorsCmPerUnit);
  const geometry::Points given = mesh.vertices;
  mesh.vertices *= result.cm_per_unit;
  faces::AnnotatedTemplate annotated =
      faces::Annotate(mesh, annotation, "the authors' template", faces::Completeness::kLandmarks);
  result.face_template = std::move(annotated.face_template);
  result.face_template.provenance = {{"name", "template of Jung et al. 2022"},
                                     {"version", fmt::format("{} vertices", mesh.vertices.rows())},
                                     {"checksum", Sha256OfFile(files.template_mesh)},
                                     {"licence", files.licence.empty() ? kAuthorsLicence : files.licence}};
  result.vertices = geometry::SelectPoints(given, annotated.vertices);
  return result;
}

std::string WriteWeights(const fs::path& file, const AuthorsModel& model, const ImportedTemplate& imported) {
  SafetensorsWriter writer;
  for (const auto& [name, array] : model.arrays) writer.Add<float>(name, array.shape, array.values);
  std::vector<float> vertices;
  for (const double x : imported.vertices.reshaped<Eigen::RowMajor>()) vertices.push_back(float(x));
  writer.Add<float>("network.template_vertices", {imported.vertices.rows(), 3}, vertices);
  const std::vector<double> model_from_cm = {1 / imported.cm_per_unit, 0, 0, 0};
  writer.Add<double>("network.model_from_cm", {4}, model_from_cm);
  MakeDirectory(file.parent_path());
  return writer.Write(file);
}

}  // namespace

Json ImportAuthorsModel(const AuthorsFiles& files, const fs::path& out) {
  if (fs::exists(out / "manifest.json") && ReadManifest(out, "run").verb != kImportVerb)
    throw UsageError(fmt::format("{}: this is a run that was trained. Name another folder", out.string()));
  StagedDirectory staged(out, "run");
  const AuthorsModel model = AuthorsModelOf(ReadStateFile(files.checkpoint), files.checkpoint.string());
  const ImportedTemplate imported = ReadTemplate(files);
  const std::string licence = files.licence.empty() ? kAuthorsLicence : files.licence,
                    checksum = Sha256OfFile(files.checkpoint);

  const Json config = {{"system", kSystem}, {"network", ToJson(model.options)}, {"loss", ToJson(DeformLossOptions())}};
  Manifest manifest;
  manifest.kind = "run";
  manifest.verb = kImportVerb;
  manifest.config = config;
  manifest.sources = {{{"name", "checkpoint of Jung et al. 2022"},
                       {"version", "as given"},
                       {"checksum", checksum},
                       {"licence", licence}},
                      imported.face_template.provenance};
  const int64_t num_codes = model.arrays.at("codes").shape[0];
  int64_t num_parameters = 0;
  for (const auto& [name, array] : model.arrays)
    if (name != "codes") num_parameters += std::ssize(array.values);
  manifest.counts = {{"training_faces", num_codes}, {"parameters", num_parameters}};
  manifest.details = {{"system", kSystem},
                      {"data", Json::object()},
                      {"imported",
                       {{"checkpoint", checksum},
                        {"template", Sha256OfFile(files.template_mesh)},
                        {"cm_per_unit", imported.cm_per_unit},
                        {"unused", model.unused}}}};
  manifest.checksums = faces::WriteFaceTemplate(staged.path(), imported.face_template);
  WriteFileAtomically(ResolvedConfig(staged.path()), ToToml(config));
  manifest.checksums[ResolvedConfig("").string()] = Sha256OfFile(ResolvedConfig(staged.path()));
  manifest.checksums[kBestFile] = WriteWeights(BestWeights(staged.path()), model, imported);
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  return {{"vertices", imported.face_template.num_vertices()},
          {"training_faces", num_codes},
          {"parameters", num_parameters},
          {"latent", model.options.latent},
          {"layers", model.options.siren().num_layers()},
          {"cm_per_unit", imported.cm_per_unit},
          {"mm_per_unit", faces::MillimetresPerCm(imported.face_template) * imported.cm_per_unit},
          {"unused_tensors", model.unused.size()}};
}

}  // namespace daumier::deform
