#include "gltf/own_parts.h"

#include "core/error.h"
#include "geometry/corner_uv.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace daumier::gltf {

std::vector<OwnPart> PartsByMaterial(const geometry::TriangleMesh& mesh, const std::vector<int>& own,
                                     const rig::MorphTargets& targets) {
  std::map<int, std::vector<int>> rows;
  for (int f = 0; f < mesh.triangles.rows(); ++f) rows[own[size_t(f)]].push_back(f);
  std::vector<float> motions(size_t(mesh.vertices.rows()), 0.0f);
  for (Eigen::Index t = 0; t < targets.offsets.cols(); ++t)
    for (size_t v = 0; v < motions.size(); ++v)
      motions[v] += targets.offsets.col(t).segment<3>(3 * Eigen::Index(v)).norm();
  std::vector<OwnPart> parts;
  for (const auto& [material, of_material] : rows) {
    OwnPart part{material, of_material, {mesh.vertices, mesh.triangles(of_material, Eigen::all), mesh.uv, {}}, 0};
    part.mesh.uv_triangles.resize(0, 3);
    if (mesh.has_uv()) part.mesh.uv_triangles = mesh.uv_triangles(of_material, Eigen::all);
    geometry::RemoveUnusedUv(part.mesh);
    std::vector<bool> is_used(motions.size(), false);
    for (const int v : part.mesh.triangles.reshaped()) {
      if (!is_used[size_t(v)]) part.motion += motions[size_t(v)];
      is_used[size_t(v)] = true;
    }
    parts.push_back(std::move(part));
  }
  const auto most = std::ranges::max_element(parts, {}, &OwnPart::motion);
  std::rotate(parts.begin(), most, most + 1);
  return parts;
}

int AddOwnMaterial(GlbBuilder& builder, const rig::OwnMaterial& material) {
  Json surface = {{"baseColorFactor", {material.colour[0], material.colour[1], material.colour[2], material.opacity}},
                  {"metallicFactor", 0},
                  {"roughnessFactor", 0.7}};
  if (material.picture) {
    const bool is_png = material.picture->starts_with("\x89PNG");
    const int image = builder.AddImage(*material.picture, is_png ? "image/png" : "image/jpeg");
    const int sampler = builder.Add("samplers", {{"magFilter", 9729}, {"minFilter", 9987}});
    surface["baseColorTexture"]["index"] = builder.Add("textures", {{"sampler", sampler}, {"source", image}});
  }
  Json item = {{"name", material.name}, {"pbrMetallicRoughness", surface}, {"doubleSided", true}};
  if (material.opacity < 1) item["alphaMode"] = "BLEND";
  return builder.Add("materials", std::move(item));
}

std::string NodeName(const std::string& name) {
  std::string clean = name;
  for (char& c : clean)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return clean;
}

}  // namespace daumier::gltf
