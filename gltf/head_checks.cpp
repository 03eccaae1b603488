#include "core/error.h"
#include "geometry/corner_uv.h"
#include "gltf/head_document.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace daumier::gltf {
namespace {

void CheckMesh(const char* part, const geometry::TriangleMesh& mesh, const std::vector<faces::HeadMaterial>& materials,
               const render::Image* texture) {
  DAUMIER_CHECK(mesh.triangles.rows() > 0, "the {} has no triangles", part);
  DAUMIER_CHECK(std::ssize(materials) == mesh.triangles.rows(), "the {} has {} materials for {} triangles", part,
                materials.size(), mesh.triangles.rows());
  geometry::CheckUv(mesh);
  DAUMIER_CHECK(texture == nullptr || mesh.has_uv(), "the {} has no UV, which its texture requires", part);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (const int v : mesh.triangles.row(t)) {
      DAUMIER_CHECK(v >= 0 && v < mesh.vertices.rows(), "triangle {} of the {} names vertex {}, there are {}", t, part,
                    v, mesh.vertices.rows());
      DAUMIER_CHECK(mesh.vertices.row(v).allFinite(), "vertex {} of the {} is not finite: ({}, {}, {})", v, part,
                    mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
    }
  }
}

bool IsNameCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

void CheckNames(const std::vector<std::string>& names) {
  std::set<std::string> found;  // In lower case: some programs do not distinguish it.
  for (const std::string& name : names) {
    DAUMIER_CHECK(!name.empty() && std::all_of(name.begin(), name.end(), IsNameCharacter),
                  "the target name '{}' is not made of letters, digits and '_'", name);
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return char(std::tolower(static_cast<unsigned char>(c))); });
    DAUMIER_CHECK(found.insert(lower).second, "two targets have the name '{}', or differ in case alone", name);
  }
}

void CheckTargets(const rig::RiggedHead& head) {
  const rig::MorphTargets& targets = head.targets;
  DAUMIER_CHECK(targets.offsets.cols() == targets.num_targets(), "{} names for {} targets", targets.names.size(),
                targets.offsets.cols());
  DAUMIER_CHECK(targets.num_targets() == 0 || targets.offsets.rows() == 3 * head.mesh.vertices.rows(),
                "targets of {} numbers for {} vertices, expected {}", targets.offsets.rows(), head.mesh.vertices.rows(),
                3 * head.mesh.vertices.rows());
  CheckNames(targets.names);
  for (Eigen::Index t = 0; t < targets.offsets.cols(); ++t) {
    for (const int v : head.mesh.triangles.reshaped()) {
      DAUMIER_CHECK(targets.offsets.col(t).segment<3>(3 * v).allFinite(),
                    "target {} moves vertex {} by no finite amount", targets.names[size_t(t)], v);
    }
  }
}

void CheckOwn(const rig::RiggedHead& head, const geometry::TriangleMesh& mesh, const std::vector<int>& own) {
  DAUMIER_CHECK(std::ssize(own) == mesh.triangles.rows(), "{} triangles have materials of their own, expected {}",
                own.size(), mesh.triangles.rows());
  for (const int row : own)
    DAUMIER_CHECK(row >= 0 && row < std::ssize(head.own_materials), "a triangle has the material {}, there are {}", row,
                  head.own_materials.size());
}

void CheckAttachment(const rig::HeadAttachment& attachment) {
  const geometry::TriangleMesh& mesh = attachment.mesh;
  DAUMIER_CHECK(
      !attachment.name.empty() && std::all_of(attachment.name.begin(), attachment.name.end(), IsNameCharacter),
      "the attachment '{}' is not named by letters", attachment.name);
  DAUMIER_CHECK(mesh.triangles.rows() > 0 && mesh.triangles.minCoeff() >= 0 &&
                    mesh.triangles.maxCoeff() < mesh.vertices.rows() && mesh.vertices.allFinite(),
                "the attachment {} is no mesh with finite vertices", attachment.name);
  DAUMIER_CHECK(attachment.colours.rows() == mesh.vertices.rows() && attachment.colours.cols() == 3 &&
                    attachment.colours.allFinite(),
                "the attachment {} has not a colour a vertex", attachment.name);
}

}  // namespace

void CheckHead(const rig::RiggedHead& head, const render::Image* texture) {
  CheckMesh("head", head.mesh, head.materials, texture);
  CheckTargets(head);
  DAUMIER_CHECK(head.head_pivot.allFinite() && head.jaw_pivot.allFinite(), "a pivot of the head is not finite");
  DAUMIER_CHECK(head.eyes.empty() || head.eyes.size() == 2, "the head has {} eyes, expected 0 or 2", head.eyes.size());
  for (const rig::RiggedEye& eye : head.eyes) {
    CheckMesh("eye", eye.mesh, eye.materials, texture);
    DAUMIER_CHECK(eye.centre.allFinite(), "the centre of an eye is not finite");
  }
  for (const rig::HeadAttachment& attachment : head.attachments) CheckAttachment(attachment);
  if (!head.own_materials.empty()) {
    CheckOwn(head, head.mesh, head.own);
    for (const rig::RiggedEye& eye : head.eyes) CheckOwn(head, eye.mesh, eye.own);
  }
  DAUMIER_CHECK(head.eyes.empty() || head.eyes[0].centre.x() < head.eyes[1].centre.x(),
                "the eyes are at x = {} and {}, expected the head's right one (less x) first", head.eyes[0].centre.x(),
                head.eyes[1].centre.x());
}

}  // namespace daumier::gltf
