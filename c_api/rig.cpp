#include "c_api/calls.h"
#include "c_api/objects.h"
#include "c_api/places.h"
#include "gltf/head_file.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

using namespace daumier;
using namespace daumier::c_api;

namespace {

const rig::RiggedHead& HeadIn(const daumier_head* head) {
  return Given(head, "head").head;
}

}  // namespace

daumier_status daumier_rig_open(const char* face_model, daumier_rig** rig) {
  return Call([&] {
    Given(rig, "rig");
    faces::FaceModel model = faces::ReadFaceModelWeights(FaceModelNamed(face_model));
    rig::ExpressionTargets expressions(model);
    rig::HeadRig heads(model.face_template);
    *rig = new daumier_rig{std::move(model), std::move(expressions), std::move(heads)};
  });
}

void daumier_rig_free(daumier_rig* rig) {
  delete rig;
}

daumier_status daumier_rig_neutral(const daumier_rig* rig, const daumier_face* face, float* xyz, size_t size) {
  return Call([&] {
    const faces::FaceModel& model = Given(rig, "rig").model;
    const systems::FaceResult& result = Given(face, "face").result;
    if (result.vertices.rows() != model.face_template.num_vertices())
      throw UsageError(fmt::format("the face has {} vertices, the rig's topology {}", result.vertices.rows(),
                                   model.face_template.num_vertices()));
    geometry::Points neutral = result.vertices;
    static const Json::json_pointer place("/coefficients/expression");  // As `daumier rig` reads it from a prediction.
    if (result.record.contains(place)) {
      const auto stated = result.record.at(place).get<std::vector<float>>();
      const auto num_stated = std::min<Eigen::Index>(model.expression_shapes.cols(), std::ssize(stated));
      const Eigen::VectorXd offset =
          (model.expression_shapes.leftCols(num_stated) * Eigen::Map<const Eigen::VectorXf>(stated.data(), num_stated))
              .cast<double>();
      neutral -= Eigen::Map<const geometry::Points>(offset.data(), neutral.rows(), 3);
    }
    WritePoints(neutral, xyz, size, "xyz");
  });
}

daumier_status daumier_rig_head(const daumier_rig* rig, const float* xyz, size_t size, daumier_head** head) {
  return Call([&] {
    Given(head, "head");
    const daumier_rig& opened = Given(rig, "rig");
    const geometry::Points neutral = ReadPoints(xyz, size, size_t(opened.model.face_template.num_vertices()), "xyz");
    *head = new daumier_head{opened.rig.On(neutral, opened.expressions.On(neutral))};
  });
}

void daumier_head_free(daumier_head* head) {
  delete head;
}

size_t daumier_head_num_vertices(const daumier_head* head) {
  return head == nullptr ? 0 : size_t(head->head.mesh.vertices.rows());
}

size_t daumier_head_num_triangles(const daumier_head* head) {
  return head == nullptr ? 0 : size_t(head->head.mesh.triangles.rows());
}

daumier_status daumier_head_vertices(const daumier_head* head, float* xyz, size_t size) {
  return Call([&] { WritePoints(HeadIn(head).mesh.vertices, xyz, size, "xyz"); });
}

daumier_status daumier_head_triangles(const daumier_head* head, int32_t* corners, size_t size) {
  return Call([&] { WriteTriangles(HeadIn(head).mesh.triangles, corners, size); });
}

size_t daumier_head_num_targets(const daumier_head* head) {
  return head == nullptr ? 0 : head->head.targets.names.size();
}

const char* daumier_head_target_name(const daumier_head* head, size_t target) {
  return target < daumier_head_num_targets(head) ? head->head.targets.names[target].c_str() : nullptr;
}

daumier_status daumier_head_target(const daumier_head* head, size_t target, float* offsets, size_t size) {
  return Call([&] {
    const rig::MorphTargets& targets = HeadIn(head).targets;
    if (target >= targets.names.size())
      throw UsageError(fmt::format("target is {} (expected below {})", target, targets.names.size()));
    CheckBuffer(offsets, size, size_t(targets.offsets.rows()), "offsets");
    Eigen::Map<Eigen::VectorXf>(offsets, targets.offsets.rows()) = targets.offsets.col(Eigen::Index(target));
  });
}

daumier_status daumier_head_write(const daumier_head* head, const char* path) {
  return Call([&] { gltf::WriteHead(&Given(path, "path"), HeadIn(head), nullptr, std::nullopt); });
}
