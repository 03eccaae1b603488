#include "gltf/head_document.h"

#include "core/licence_text.h"
#include "gltf/head_mesh.h"
#include "gltf/own_parts.h"
#include "gltf/triangle_runs.h"

#include <map>
#include <string>
#include <utility>

namespace daumier::gltf {
namespace {

constexpr int kJpegQuality = 90;

Json Channel(int node, const char* path, int sampler) {
  return {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
}

Json Sampler(int times, int values) {
  return {{"input", times}, {"interpolation", "LINEAR"}, {"output", values}};
}

}  // namespace

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

geometry::Vector3 Metres(const geometry::Vector3& point, const geometry::Vector3& pivot) {
  return 0.01 * (point - pivot);
}

Json ToArray(const geometry::Vector3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

namespace {

/// Adds the meshes of a head and its nodes.
class HeadAssembly {
 public:
  HeadAssembly(GlbBuilder& builder, const rig::RiggedHead& head, const render::Image* texture,
               const HeadFileOptions& options)
      : builder_(builder), head_(head), options_(options), is_coloured_(texture == nullptr) {
    if (!head.own_materials.empty()) return;
    texture_ = AddTexture(builder, texture);
  }

  HeadNodes Add(double head_y) {
    HeadNodes nodes;
    const int face = is_own() ? -1 : AddMeshOf("Face", head_.mesh, head_.materials, Surface("Skin", 0.7));
    nodes.head =
        builder_.Add("nodes", {{"name", "Head"}, {"translation", {0, head_y, 0}}, {"children", Json::array()}});
    if (is_own()) {
      AddOwnFace(nodes);
    } else {
      node(nodes.head)["mesh"] = face;
      nodes.with_targets = {nodes.head};
      StateTriangles(nodes.head, head_.materials, head_.neck_cap);
    }
    if (!head_.eyes.empty()) {
      const int surface = is_own() ? -1 : Surface("Eye", 0.2);
      nodes.left_eye = AddEye(nodes.head, head_.eyes[1], "LeftEye", surface);
      nodes.right_eye = AddEye(nodes.head, head_.eyes[0], "RightEye", surface);
    }
    for (const rig::HeadAttachment& attachment : head_.attachments) {
      const int material = AddMaterial(builder_, (attachment.name + "Material").c_str(), std::nullopt, 0.8);
      const int mesh = AddAttachmentMesh(builder_, attachment.name + "Mesh", attachment, head_.head_pivot, material);
      AddChild(nodes.head, {{"name", attachment.name}, {"mesh", mesh}}, geometry::Vector3::Zero());
    }
    nodes.jaw = AddChild(nodes.head, {{"name", "Jaw"}}, Metres(head_.jaw_pivot, head_.head_pivot));
    return nodes;
  }

 private:
  bool is_own() const { return !head_.own_materials.empty(); }
  Json& node(int index) { return builder_.json()["nodes"][size_t(index)]; }
  int Surface(const char* name, double roughness) { return AddMaterial(builder_, name, texture_, roughness); }
  int OwnSurface(int row) {
    const auto found = own_surfaces_.find(row);
    if (found != own_surfaces_.end()) return found->second;
    return own_surfaces_[row] = AddOwnMaterial(builder_, head_.own_materials[size_t(row)]);
  }

  int AddMeshOf(const std::string& name, const geometry::TriangleMesh& mesh,
                const std::vector<faces::HeadMaterial>& materials, int surface) {
    return AddMesh(builder_, name.c_str(), mesh, materials, head_.head_pivot, head_.targets, surface, is_coloured_,
                   options_);
  }
  int AddChild(int parent, Json child, const geometry::Vector3& place) {
    if (!place.isZero(0)) child["translation"] = ToArray(place);
    const int index = builder_.Add("nodes", std::move(child));
    node(parent)["children"].push_back(index);
    return index;
  }

  /// Not where compression changes the order of triangles.
  void StateTriangles(int of_node, const std::vector<faces::HeadMaterial>& materials,
                      const std::vector<int>& neck_cap) {
    if (builder_.encoding() == GlbEncoding::kPlain)
      node(of_node)["extras"]["triangles"] = TriangleRuns(materials, neck_cap);
  }

  /// A mesh a material: the part that moves most at the head's node, the others below it. Parts that do not move have no
  /// targets.
  void AddOwnFace(HeadNodes& nodes) {
    bool is_first = true;
    for (const OwnPart& part : PartsByMaterial(head_.mesh, head_.own, head_.targets)) {
      const std::string name = NodeName(head_.own_materials[size_t(part.material)].name);
      const bool has_targets = is_first || part.motion > 0;
      const int mesh =
          AddMesh(builder_, is_first ? "Face" : ("Face_" + name).c_str(), part.mesh, {}, head_.head_pivot,
                  has_targets ? head_.targets : rig::MorphTargets(), OwnSurface(part.material), false, options_);
      int of_part = nodes.head;
      if (is_first) {
        node(nodes.head)["mesh"] = mesh;
      } else {
        of_part = AddChild(nodes.head, {{"name", "Head_" + name}, {"mesh", mesh}}, geometry::Vector3::Zero());
      }
      if (has_targets) nodes.with_targets.push_back(of_part);
      is_first = false;
    }
  }

  int AddEye(int parent, const rig::RiggedEye& eye, const std::string& name, int surface) {
    const geometry::Vector3 place = Metres(eye.centre, head_.head_pivot), zero = geometry::Vector3::Zero();
    if (!is_own()) {
      const int mesh = AddMesh(builder_, (name + "ball").c_str(), eye.mesh, eye.materials, zero, {}, surface,
                               is_coloured_, options_);
      const int of_eye = AddChild(parent, {{"name", name}, {"mesh", mesh}}, place);
      StateTriangles(of_eye, eye.materials, {});
      return of_eye;
    }
    std::optional<int> node_of_eye;
    for (const OwnPart& part : PartsByMaterial(eye.mesh, eye.own, {})) {
      const int mesh = AddMesh(builder_, (name + "ball").c_str(), part.mesh, {}, zero, {}, OwnSurface(part.material),
                               false, options_);
      if (!node_of_eye) {
        node_of_eye = AddChild(parent, {{"name", name}, {"mesh", mesh}, {"children", Json::array()}}, place);
      } else {
        const std::string own = NodeName(head_.own_materials[size_t(part.material)].name);
        AddChild(*node_of_eye, {{"name", name + "_" + own}, {"mesh", mesh}}, zero);
      }
    }
    if (node(*node_of_eye)["children"].empty()) node(*node_of_eye).erase("children");
    return *node_of_eye;
  }

  GlbBuilder& builder_;
  const rig::RiggedHead& head_;
  const HeadFileOptions& options_;
  bool is_coloured_;
  std::optional<int> texture_;
  std::map<int, int> own_surfaces_;
};

}  // namespace

HeadNodes AddHead(GlbBuilder& builder, const rig::RiggedHead& head, const render::Image* texture,
                  const HeadFileOptions& options, double head_y) {
  return HeadAssembly(builder, head, texture, options).Add(head_y);
}

void AddAnimation(GlbBuilder& builder, const HeadNodes& nodes, const HeadAnimation& animation) {
  if (animation.times.empty()) return;
  const int times = builder.AddTimes(animation.times);
  Json item = {{"name", "Clip"}, {"channels", Json::array()}, {"samplers", Json::array()}};
  const auto add = [&](int node, const char* path, int values) {
    item["channels"].push_back(Channel(node, path, static_cast<int>(item["samplers"].size())));
    item["samplers"].push_back(Sampler(times, values));
  };
  if (animation.weights.cols() > 0) {
    const int weights = builder.AddKeys(animation.weights, true, kWeightExponent);
    for (const int node : nodes.with_targets) add(node, "weights", weights);
  }
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
