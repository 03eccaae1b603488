#include "core/error.h"
#include "core/licence_text.h"
#include "gltf/head_document.h"
#include "gltf/head_file.h"
#include "gltf/vrm_expressions.h"
#include "rig/gaze.h"

#include <array>
#include <numbers>

namespace daumier::gltf {
namespace {

/// A joint of the body that the head lacks, in a T-pose: y and x over the ground, as a share of the height of the head's
/// pivot. Joints come after their parents.
struct VrmJoint {
  const char* name;
  const char* bone;
  int parent;  ///< -1: the root.
  double x, y;
};
constexpr int kNeck = 2;  // The parent of the head.
constexpr std::array<VrmJoint, 15> kVrmJoints = {{{"Hips", "hips", -1, 0, 0.60},
                                                  {"Spine", "spine", 0, 0, 0.68},
                                                  {"Neck", "neck", 1, 0, 0.94},
                                                  {"LeftArm", "leftUpperArm", 1, 0.11, 0.88},
                                                  {"LeftForeArm", "leftLowerArm", 3, 0.28, 0.88},
                                                  {"LeftHand", "leftHand", 4, 0.44, 0.88},
                                                  {"RightArm", "rightUpperArm", 1, -0.11, 0.88},
                                                  {"RightForeArm", "rightLowerArm", 6, -0.28, 0.88},
                                                  {"RightHand", "rightHand", 7, -0.44, 0.88},
                                                  {"LeftUpLeg", "leftUpperLeg", 0, 0.06, 0.58},
                                                  {"LeftLeg", "leftLowerLeg", 9, 0.06, 0.31},
                                                  {"LeftFoot", "leftFoot", 10, 0.06, 0.05},
                                                  {"RightUpLeg", "rightUpperLeg", 0, -0.06, 0.58},
                                                  {"RightLeg", "rightLowerLeg", 12, -0.06, 0.31},
                                                  {"RightFoot", "rightFoot", 13, -0.06, 0.05}}};

Json Bone(int node) {
  return {{"node", node}};
}

/// Adds the joints around the head. Returns `humanoid.humanBones`.
Json AddSkeleton(GlbBuilder& builder, const HeadNodes& nodes, double height) {
  const auto place = [&](const VrmJoint& joint) { return geometry::Vector3(joint.x * height, joint.y * height, 0); };
  std::array<int, kVrmJoints.size()> indices{};
  Json bones;
  for (size_t j = 0; j < kVrmJoints.size(); ++j) {
    const VrmJoint& joint = kVrmJoints[j];
    geometry::Vector3 translation = place(joint);
    if (joint.parent >= 0) translation -= place(kVrmJoints[size_t(joint.parent)]);
    indices[j] = builder.Add("nodes", {{"name", joint.name}, {"translation", ToArray(translation)}});
    bones[joint.bone] = Bone(indices[j]);
    if (joint.parent >= 0) {
      builder.json()["nodes"][size_t(indices[size_t(joint.parent)])]["children"].push_back(indices[j]);
    }
  }
  builder.json()["nodes"][size_t(indices[kNeck])]["children"].push_back(nodes.head);
  builder.json()["scenes"] = Json::array({{{"nodes", {indices[0]}}}});
  builder.json()["scene"] = 0;
  bones["head"] = Bone(nodes.head);
  bones["leftEye"] = Bone(*nodes.left_eye);
  bones["rightEye"] = Bone(*nodes.right_eye);
  return bones;
}

Json VrmMeta(const rig::RiggedHead& head, const HeadFileOptions& options) {
  return {{"name", options.title},
          {"authors", options.authors},
          {"copyrightInformation", head.licence},
          {"references", {head.source}},
          {"thirdPartyLicenses", LicenceNotices(Json::array({{{"name", head.source}, {"licence", head.licence}}}))},
          {"licenseUrl", "https://vrm.dev/licenses/1.0/"}};
}

/// Eyes turn as far as what they look at is aside, up to kGazeAngle. All ranges are equal: three-vrm 3.5.5 exchanges up
/// and down.
Json VrmLookAt(const rig::RiggedHead& head) {
  constexpr double kDegrees = rig::kGazeAngle * 180 / std::numbers::pi;
  Json look_at = {
      {"offsetFromHeadBone", ToArray(Metres(0.5 * (head.eyes[0].centre + head.eyes[1].centre), head.head_pivot))},
      {"type", "bone"}};
  for (const char* range : {"HorizontalInner", "HorizontalOuter", "VerticalDown", "VerticalUp"}) {
    look_at[std::string("rangeMap") + range] = {{"inputMaxValue", kDegrees}, {"outputScale", kDegrees}};
  }
  return look_at;
}

void CheckVrm(const rig::RiggedHead& head, const HeadFileOptions& options) {
  DAUMIER_CHECK(!head.eyes.empty(), "a VRM needs a head with eyes, this one has none");
  DAUMIER_CHECK(!options.title.empty(), "a VRM needs a title");
  DAUMIER_CHECK(!options.authors.empty(), "a VRM needs an author");
  for (const std::string& author : options.authors) DAUMIER_CHECK(!author.empty(), "an author of the VRM has no name");
}

}  // namespace

std::string HeadToVrm(const rig::RiggedHead& head, const render::Image* texture, const HeadFileOptions& options) {
  CheckHead(head, texture);
  CheckVrm(head, options);
  GlbBuilder builder(options.compressed ? GlbEncoding::kMeshopt : GlbEncoding::kPlain);
  AddAsset(builder, head);
  const double height = options.pivot_height_m;
  const HeadNodes nodes = AddHead(builder, head, texture, options, (1 - kVrmJoints[kNeck].y) * height);
  Json vrm = {{"specVersion", "1.0"}, {"meta", VrmMeta(head, options)}};
  vrm["humanoid"]["humanBones"] = AddSkeleton(builder, nodes, height);
  vrm["expressions"] = VrmExpressions(nodes.with_targets, head.targets.names);
  vrm["lookAt"] = VrmLookAt(head);
  builder.json()["extensionsUsed"].push_back("VRMC_vrm");
  builder.json()["extensions"]["VRMC_vrm"] = std::move(vrm);
  return builder.Finish();
}

}  // namespace daumier::gltf
