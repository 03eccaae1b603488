#include "gltf/head_document.h"

#include "core/licence_text.h"
#include "gltf/head_mesh.h"

#include <utility>

namespace daumier::gltf {
namespace {

constexpr int kJpegQuality = 90;

/// The texture of the document, if any; materials share it.
std::optional<int> AddTexture(GlbBuilder& builder, const render::Image* texture) {
  if (texture == nullptr) return std::nullopt;
  const bool is_small = builder.encoding() == GlbEncoding::kMeshopt;
  const std::string bytes =
      render::EncodeImage(*texture, is_small ? render::ImageFormat::kJpeg : render::ImageFormat::kPng, kJpegQuality);
  const int image = builder.AddImage(bytes, is_small ? "image/jpeg" : "image/png");
  // Linear between texels and between mipmaps.
  const int sampler = builder.Add("samplers", {{"magFilter", 9729}, {"minFilter", 9987}});
  return builder.Add("textures", {{"sampler", sampler}, {"source", image}});
}

int AddMaterial(GlbBuilder& builder, const char* name, std::optional<int> texture, double roughness) {
  Json surface;
  if (texture) surface["baseColorTexture"] = {{"index", *texture}};
  surface["metallicFactor"] = 0;
  surface["roughnessFactor"] = roughness;
  return builder.Add("materials", {{"name", name}, {"pbrMetallicRoughness", surface}});
}

Json Channel(int node, const char* path, int sampler) {
  return {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
}

Json Sampler(int times, int values) {
  return {{"input", times}, {"interpolation", "LINEAR"}, {"output", values}};
}

}  // namespace

geometry::Vector3 Metres(const geometry::Vector3& point, const geometry::Vector3& pivot) {
  return 0.01 * (point - pivot);
}

Json ToArray(const geometry::Vector3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

HeadNodes AddHead(GlbBuilder& builder, const rig::RiggedHead& head, const render::Image* texture,
                  const HeadFileOptions& options, double head_y) {
  const std::optional<int> texture_index = AddTexture(builder, texture);
  const bool is_coloured = texture == nullptr;
  const auto add_mesh = [&](const char* name, const geometry::TriangleMesh& mesh,
                            const std::vector<faces::HeadMaterial>& materials, const geometry::Vector3& pivot,
                            const rig::MorphTargets& targets, int material) {
    return AddMesh(builder, name, mesh, materials, pivot, targets, material, is_coloured, options);
  };
  const int skin = AddMaterial(builder, "Skin", texture_index, 0.7);
  const int face = add_mesh("Face", head.mesh, head.materials, head.head_pivot, head.targets, skin);

  HeadNodes nodes;
  nodes.head = builder.Add(
      "nodes", {{"name", "Head"}, {"mesh", face}, {"translation", {0, head_y, 0}}, {"children", Json::array()}});
  const auto add_child = [&](Json node, const geometry::Vector3& centre) {
    node["translation"] = ToArray(Metres(centre, head.head_pivot));
    const int index = builder.Add("nodes", std::move(node));
    builder.json()["nodes"][size_t(nodes.head)]["children"].push_back(index);
    return index;
  };
  if (!head.eyes.empty()) {
    const int surface = AddMaterial(builder, "Eye", texture_index, 0.2);
    const auto add_eye = [&](const rig::RiggedEye& eye, const char* mesh_name, const char* node_name) {
      const int mesh = add_mesh(mesh_name, eye.mesh, eye.materials, geometry::Vector3::Zero(), {}, surface);
      return add_child({{"name", node_name}, {"mesh", mesh}}, eye.centre);
    };
    nodes.left_eye = add_eye(head.eyes[1], "LeftEyeball", "LeftEye");
    nodes.right_eye = add_eye(head.eyes[0], "RightEyeball", "RightEye");
  }
  nodes.jaw = add_child({{"name", "Jaw"}}, head.jaw_pivot);
  return nodes;
}

void AddAnimation(GlbBuilder& builder, const HeadNodes& nodes, const HeadAnimation& animation) {
  if (animation.times.empty()) return;
  const int times = builder.AddTimes(animation.times);
  Json item = {{"name", "Clip"}, {"channels", Json::array()}, {"samplers", Json::array()}};
  const auto add = [&](int node, const char* path, int values) {
    item["channels"].push_back(Channel(node, path, static_cast<int>(item["samplers"].size())));
    item["samplers"].push_back(Sampler(times, values));
  };
  if (animation.weights.cols() > 0)
    add(nodes.head, "weights", builder.AddKeys(animation.weights, true, kWeightExponent));
  add(nodes.head, "rotation", builder.AddKeys(animation.head, false, 0));
  if (nodes.left_eye) add(*nodes.left_eye, "rotation", builder.AddKeys(animation.left_eye, false, 0));
  if (nodes.right_eye) add(*nodes.right_eye, "rotation", builder.AddKeys(animation.right_eye, false, 0));
  item["extras"]["leadInSeconds"] = animation.lead_in_seconds;
  builder.Add("animations", std::move(item));
}

void AddAsset(GlbBuilder& builder, const rig::RiggedHead& head) {
  const Json source = {{"name", head.source}, {"licence", head.licence}};
  Json extras = source;
  extras["notices"] = LicenceNotices(Json::array({source}));
  builder.json()["asset"] = {{"version", "2.0"},
                             {"generator", "Daumier " DAUMIER_VERSION},
                             {"copyright", head.licence},
                             {"extras", std::move(extras)}};
}

}  // namespace daumier::gltf
