#include "faces/face_model_weights.h"

#include "core/error.h"
#include "core/files.h"
#include "core/licence_text.h"
#include "core/staged_directory.h"
#include "core/weights_folder.h"
#include "faces/face_model_file.h"

namespace daumier::faces {
namespace {

namespace fs = std::filesystem;

std::string CardOf(const FaceModel& model, const std::string& name, const Json& error_mm) {
  const FaceTemplate& face = model.face_template;
  const auto text = [&](const char* key) {
    const Json value = face.provenance.value(key, Json("unknown"));
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  return fmt::format(
             "# {}: face model of the source `{}`\n\n"
             "A linear model of faces, converted from {} (version {}, checksum {}) by\n\n"
             "    daumier dataset model --out weights/{} source.name={} source.path=FOLDER_OR_ARCHIVE\n\n"
             "It takes the place of that source wherever a source is named: `source.name={} source.path=weights/{}`. "
             "Other "
             "weights refer to it.\n\n",
             name, face.source, text("name"), text("version"), text("checksum"), name, face.source, face.source, name) +
         fmt::format(
             "| file | content |\n|---|---|\n"
             "| `template.safetensors`, `template.json` | mean face of {} vertices and {} triangles, UV, 68 landmarks, "
             "regions, curves; exact |\n"
             "| `shapes.safetensors` | {} identity shapes and {} expression shapes as integers of 8 or 16 bits, each "
             "shape with a scale of its own |\n"
             "| `model.json` | names, how identities are drawn, {} expressions |\n\n"
             "Eyes and the albedo basis are computed from the template and are not stored.\n\n"
             "## Errors\n\n"
             "Largest distance of a vertex from the source, for a shape of weight 1: {:.4f} mm (identity), {:.4f} mm "
             "(expression); 200 mm are the height of the mean face.\n\n",
             face.num_vertices(), face.triangles.rows(), model.identity_shapes.cols(), model.expression_shapes.cols(),
             model.expressions.size(), error_mm.at("identity").get<double>(), error_mm.at("expression").get<double>()) +
         "## Licences\n\n" + LicenceNotices(Json::array({face.provenance})) +
         "## Limits\n\n"
         "- The model is that of its source: faces of persons that its makers scanned or drew, in their proportions of "
         "sex, age and origin.\n"
         "- It has no hair, no teeth and no texture.\n"
         "- It must not be used to identify or to judge people.\n";
}

}  // namespace

Json WriteFaceModelWeights(const fs::path& out_directory, const FaceModel& model) {
  StagedDirectory staged(out_directory, kWeightsKind);
  FaceModel stored = model;
  stored.face_template.provenance["shapes"] = fmt::format("rounded to {:g} mm", 10 * kShapeToleranceCm);
  Manifest manifest{.kind = kWeightsKind, .verb = "dataset model"};
  manifest.config = {{"source", {{"name", model.face_template.source}}}};
  manifest.sources = Json::array({stored.face_template.provenance});
  manifest.counts = {{"vertices", model.face_template.num_vertices()},
                     {"identity_shapes", model.identity_shapes.cols()},
                     {"expression_shapes", model.expression_shapes.cols()},
                     {"expressions", model.expressions.size()}};
  manifest.checksums = WriteFaceModel(staged.path(), stored);
  const ModelDifference difference = DifferenceOf(ReadFaceModel(staged.path()), model);
  const double scale = MillimetresPerCm(model.face_template);
  const Json error_mm = {{"identity", scale * difference.identity_cm},
                         {"expression", scale * difference.expression_cm}};
  manifest.details = {{"weights_version", kWeightsVersion},
                      {"system", kFaceModelSystem},
                      {"source", model.face_template.source},
                      {"largest_error_mm", error_mm}};
  const std::string card = CardOf(stored, WeightsName(out_directory), error_mm);
  WriteFileAtomically(staged.path() / kWeightsCard, card);
  manifest.checksums[kWeightsCard] = Sha256(card);
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  return manifest.details;
}

}  // namespace daumier::faces
