#include "reports/head_file.h"

#include "geometry/obj.h"
#include "reports/face_surface.h"

#include <algorithm>

namespace daumier::reports {
namespace {

std::string NameOf(faces::HeadMaterial material) {
  return std::find_if(faces::kHeadMaterials.begin(), faces::kHeadMaterials.end(),
                      [&](const faces::NamedHeadMaterial& named) { return named.material == material; })
      ->name;
}

}  // namespace

void WriteHead(const std::filesystem::path& path, const faces::FinishedHead& head, const geometry::Points& face) {
  const std::string skin = NameOf(faces::HeadMaterial::kSkin);
  std::vector<geometry::ObjPart> parts = {{"face", skin, head.skin().rows() - head.num_cap_triangles()},
                                          {"neck", skin, head.num_cap_triangles()}};
  const std::vector<faces::HeadMaterial>& of_parts = head.part_materials();
  const size_t num_eye_triangles = of_parts.size() - size_t(head.num_mouth_triangles());
  for (size_t i = 0; i < of_parts.size(); ++i) {
    if (i == 0 || i == num_eye_triangles || of_parts[i] != of_parts[i - 1])
      parts.push_back({i < num_eye_triangles ? "eyes" : "mouth", NameOf(of_parts[i]), 0});
    ++parts.back().num_triangles;
  }
  std::erase_if(parts, [](const geometry::ObjPart& part) { return part.num_triangles == 0; });
  std::vector<geometry::ObjMaterial> materials;
  for (const faces::NamedHeadMaterial& named : faces::kHeadMaterials) {
    const std::string name(named.name);
    if (std::none_of(parts.begin(), parts.end(), [&](const auto& part) { return part.material == name; })) continue;
    const MaterialLook look = LookOf(named.material);
    materials.push_back({name, render::LinearLight(look.colour), look.gloss});
  }
  geometry::WriteObj(path, head.Mesh(face), parts, materials);
}

}  // namespace daumier::reports
