// A drawing -> a face -> its nose pulled out -> a rigged head for a game, by the C++ libraries (CMakeLists.txt).
#include <daumier/faces/face_model_file.h>
#include <daumier/fitting/code_handles.h>
#include <daumier/fitting/mesh_code.h>
#include <daumier/gltf/head_file.h>
#include <daumier/rig/expression_targets.h>
#include <daumier/rig/head_rig.h>
#include <daumier/systems/deform/edit_points.h>
#include <daumier/systems/deform/open_code_model.h>
#include <daumier/systems/shipped_weights.h>
#include <daumier/systems/sketch/system.h>

#include <cstdio>

using namespace daumier;

int main(int argc, char** argv) try {
  if (argc != 3) throw UsageError("usage: draw_a_face DRAWING HEAD.glb");
  const auto places = systems::WeightsPlaces();
  const auto weights = systems::WeightsNamed("sketch-ict", systems::ListWeights(places), places);
  const auto sketch = sketch::SketchSystem();
  const auto predictor = sketch.open(weights, Device{}, sketch.resolve_prediction(Json::object(), "the example"));
  geometry::Points face = predictor->Predict(sketch.read_inputs(argv[1])).front().vertices;  // V x 3, cm

  const auto opened = deform::OpenCodeModel(deform::ShippedModel());
  const auto model = faces::ReadFaceModelWeights(deform::ShippedModel());
  const auto nose = deform::ParseHandle(model.face_template, "30=0,0,1");  // Landmark 30 to the front by 1 cm.
  const auto before = fitting::CodeOfMesh(*opened.model, face);
  const fitting::HandleOptions options{.outside = deform::OutsideOfPart(model.face_template, nose),
                                       .fixed = opened.expression};
  const auto edit = fitting::EditByHandles(*opened.model, before.code, nose.points, nose.displacements, options);
  face += opened.model->Vertices(edit.code) - before.vertices;

  const auto head = rig::HeadRig(model.face_template).On(face, rig::ExpressionTargets(model).On(face));
  gltf::WriteHead(argv[2], head, nullptr, std::nullopt);
  const auto tip = face.row(nose.points.front());
  std::printf("%ld vertices, nose at %.2f %.2f %.2f cm\n", long(face.rows()), tip.x(), tip.y(), tip.z());
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
