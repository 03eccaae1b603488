#include "c_api/calls.h"
#include "c_api/objects.h"
#include "c_api/places.h"
#include "fitting/exaggerated_face.h"
#include "fitting/mesh_code.h"
#include "systems/deform/edit_points.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace daumier;
using namespace daumier::c_api;

namespace {

constexpr double kMostNumber = 1000;  // Of a code, which are of the order of 1.

const fitting::CodeModel& ModelOf(const daumier_model* model) {
  return *Given(model, "model").opened.model;
}

size_t NumVertices(const fitting::CodeModel& model) {
  return size_t(model.face_template().num_vertices());
}

/// Different vertices of a model.
std::vector<int> HandleVertices(const int32_t* vertices, size_t num_handles, size_t num_vertices) {
  if (num_handles < 1 || num_handles > DAUMIER_MOST_HANDLES)
    throw UsageError(fmt::format("num_handles is {} (expected 1 to {})", num_handles, DAUMIER_MOST_HANDLES));
  Given(vertices, "vertices");
  std::vector<int> handles;
  for (size_t h = 0; h < num_handles; ++h) {
    const int32_t vertex = vertices[h];
    if (vertex < 0 || size_t(vertex) >= num_vertices || std::ranges::count(handles, vertex) > 0)
      throw UsageError(
          fmt::format("vertices[{}] is {} (expected different numbers below {})", h, vertex, num_vertices));
    handles.push_back(vertex);
  }
  return handles;
}

}  // namespace

daumier_status daumier_model_open(const char* folder, daumier_model** model) {
  return Call([&] {
    Given(model, "model");
    *model = new daumier_model{deform::OpenCodeModel(ModelNamed(folder))};
  });
}

void daumier_model_free(daumier_model* model) {
  delete model;
}

size_t daumier_model_num_vertices(const daumier_model* model) {
  return model == nullptr ? 0 : NumVertices(*model->opened.model);
}

size_t daumier_model_num_triangles(const daumier_model* model) {
  return model == nullptr ? 0 : size_t(model->opened.model->face_template().triangles.rows());
}

daumier_status daumier_model_triangles(const daumier_model* model, int32_t* corners, size_t size) {
  return Call([&] { WriteTriangles(ModelOf(model).face_template().triangles, corners, size); });
}

int32_t daumier_model_landmark(const daumier_model* model, int32_t landmark) {
  if (model == nullptr || landmark < 0 || landmark >= 68) return -1;
  return model->opened.model->face_template().annotation.landmarks[size_t(landmark)];
}

size_t daumier_model_num_numbers(const daumier_model* model) {
  return model == nullptr ? 0 : size_t(model->opened.model->num_numbers());
}

daumier_status daumier_model_decode(const daumier_model* model, const float* code, size_t num_numbers, float* xyz,
                                    size_t size) {
  return Call([&] {
    const fitting::CodeModel& opened = ModelOf(model);
    CheckBuffer(code, num_numbers, size_t(opened.num_numbers()), "code");
    CheckBuffer(xyz, size, 3 * NumVertices(opened), "xyz");
    const Eigen::VectorXd numbers = Eigen::Map<const Eigen::VectorXf>(code, Eigen::Index(num_numbers)).cast<double>();
    if (!(numbers.cwiseAbs().maxCoeff() <= kMostNumber))
      throw UsageError(fmt::format("a number of code is not finite, or beyond {}", kMostNumber));
    WritePoints(opened.Vertices(numbers), xyz, size, "xyz");
  });
}

daumier_status daumier_model_encode(const daumier_model* model, const float* xyz, size_t size, float* code,
                                    size_t num_numbers) {
  return Call([&] {
    const fitting::CodeModel& opened = ModelOf(model);
    CheckBuffer(code, num_numbers, size_t(opened.num_numbers()), "code");
    const geometry::Points face = ReadPoints(xyz, size, NumVertices(opened), "xyz");
    Eigen::Map<Eigen::VectorXf>(code, Eigen::Index(num_numbers)) = fitting::CodeOfMesh(opened, face).code.cast<float>();
  });
}

daumier_status daumier_model_exaggerate(const daumier_model* model, const float* xyz, size_t size, float strength,
                                        float* exaggerated, size_t exaggerated_size) {
  return Call([&] {
    const fitting::CodeModel& opened = ModelOf(model);
    const geometry::Points face = ReadPoints(xyz, size, NumVertices(opened), "xyz");
    CheckBuffer(exaggerated, exaggerated_size, size, "exaggerated");
    if (!(strength >= 0 && strength <= 2)) throw UsageError(fmt::format("strength is {} (expected 0 to 2)", strength));
    WritePoints(fitting::Exaggerate(opened, face, strength, model->opened.expression).vertices, exaggerated,
                exaggerated_size, "exaggerated");
  });
}

daumier_status daumier_edit_begin(const daumier_model* model, const float* xyz, size_t size, const int32_t* vertices,
                                  size_t num_handles, int is_local, daumier_edit** edit) {
  return Call([&] {
    Given(edit, "edit");
    const fitting::CodeModel& opened = ModelOf(model);
    geometry::Points face = ReadPoints(xyz, size, NumVertices(opened), "xyz");
    const std::vector<int> handles = HandleVertices(vertices, num_handles, NumVertices(opened));
    fitting::HandleOptions options{.fixed = model->opened.expression};
    if (is_local != 0)
      options.outside = deform::OutsideOfPart(
          opened.face_template(),
          {.points = handles, .displacements = geometry::Points::Zero(Eigen::Index(num_handles), 3)});
    fitting::MeshCode code = fitting::CodeOfMesh(opened, face);
    *edit = new daumier_edit{std::move(face), std::move(code.vertices), opened,
                             fitting::HandleEditor(opened, std::move(code.code), handles, std::move(options))};
  });
}

void daumier_edit_free(daumier_edit* edit) {
  delete edit;
}

daumier_status daumier_edit_move(daumier_edit* edit, const float* moves, size_t num_moves, float* xyz, size_t size) {
  return Call([&] {
    daumier_edit& begun = Given(edit, "edit");
    const geometry::Points displacements = ReadPoints(moves, num_moves, size_t(begun.editor.places().rows()), "moves");
    CheckBuffer(xyz, size, 3 * size_t(begun.face.rows()), "xyz");
    const fitting::HandleEdit moved = begun.editor.MoveBy(displacements);
    WritePoints(begun.face + begun.model.Vertices(moved.code) - begun.of_code, xyz, size, "xyz");
  });
}
