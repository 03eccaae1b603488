#include "faces/face_model_file.h"

#include "core/files.h"
#include "tests/faces/same_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"
#include "tests/support/temp_dir.h"

#include <functional>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::ExpectSameModel;

/// The synthetic model with everything that a model can have.
FaceModel ModelWithAll() {
  FaceModel model = testing::SyntheticModel();
  model.identity_controls[0] = {"width", IdentityControl::Kind::kBipolar, {0, -1}, 0.5};
  model.identity_controls[1] = {"group", IdentityControl::Kind::kSimplex, {1, 2, 3}, 1};
  model.align_identities = true;
  for (int v = 0; v < model.face_template.num_vertices(); ++v) model.numbering.vertices.push_back(2 * v);
  model.numbering.num_vertices = 2 * model.face_template.num_vertices();
  model.numbering.cm_per_unit = 2.5;
  return model;
}

TEST(FaceModelFile, ReadUndoesWriteToTheTolerance) {
  const testing::TempDir folder;
  const FaceModel model = ModelWithAll();
  WriteFaceModel(folder.path(), model);
  const FaceModel read = ReadFaceModel(folder.path());
  ExpectSameModel(read, model);
  EXPECT_LE((read.identity_shapes - model.identity_shapes).cwiseAbs().maxCoeff(), 1.001 * kShapeToleranceCm);
  EXPECT_LE((read.expression_shapes - model.expression_shapes).cwiseAbs().maxCoeff(), 1.001 * kShapeToleranceCm);
  EXPECT_FALSE(read.identity_shapes == model.identity_shapes) << "float32 would need four times the space";
}

TEST(FaceModelFile, NumbersThatDoNotBelongTogetherAreRefused) {
  const testing::TempDir folder;
  WriteFaceModel(folder.path(), testing::SyntheticModel());
  const Json text = ReadJson(folder / kModelText);
  const auto with = [&](const std::function<void(Json&)>& change) {
    Json changed = text;
    change(changed);
    WriteFileAtomically(folder / kModelText, changed.dump());
    ReadFaceModel(folder.path());
  };
  EXPECT_NO_THROW(with([](Json&) {}));
  ExpectError([&] { with([](Json& json) { json["format_version"] = 2; }); },
              std::string(kModelText) + ": format version 2 is not supported (expected 1)");
  ExpectError([&] { with([](Json& json) { json.erase("expressions"); }); }, "malformed");
  ExpectError([&] { with([](Json& json) { json["identity_controls"][0]["shapes"] = {99}; }); }, "names shape 99 of 12");
  ExpectError([&] { with([](Json& json) { json["identity_controls"][0]["kind"] = "cubic"; }); }, "kind 'cubic'");
  ExpectError([&] { with([](Json& json) { json["expression_shapes"].erase(0); }); },
              "6 names of expression shapes, expected 7");
  ExpectError([&] { with([](Json& json) { json["expressions"][1]["weights"]["grin"] = 1; }); }, "the shape 'grin'");

  FaceModel other = testing::SyntheticModel();
  other.numbering.vertices = {1, 2, 3};
  WriteFaceModel(folder.path(), other);
  ExpectError([&] { ReadFaceModel(folder.path()); }, "'numbering' has 3 vertices");
  other = testing::SyntheticModel();
  other.identity_shapes.conservativeResize(30, Eigen::NoChange);
  WriteFaceModel(folder.path(), other);
  ExpectError([&] { ReadFaceModel(folder.path()); }, "shapes of 10 vertices, but the template has");
}

}  // namespace
}  // namespace daumier::faces
