#include "studio/display_head.h"

#include "render/camera.h"
#include "reports/face_surface.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace daumier::studio {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes are sent as they lie in memory");

template <class T>
std::string BytesOf(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

void Append(const geometry::Triangles& triangles, Eigen::Index row, std::vector<uint32_t>& indices) {
  for (int corner = 0; corner < 3; ++corner) indices.push_back(uint32_t(triangles(row, corner)));
}

const char* NameOfMaterial(faces::HeadMaterial material) {
  for (const faces::NamedHeadMaterial& named : faces::kHeadMaterials)
    if (named.material == material) return named.name;
  return "skin";
}

}  // namespace

DisplayHead::DisplayHead(const faces::FaceTemplate& face_template)
    : head_(reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral)) {
  std::map<faces::HeadMaterial, std::vector<uint32_t>> groups;
  for (Eigen::Index t = 0; t < head_.skin().rows(); ++t) Append(head_.skin(), t, groups[faces::HeadMaterial::kSkin]);
  for (Eigen::Index t = 0; t < head_.parts().rows(); ++t)
    Append(head_.parts(), t, groups[head_.part_materials()[size_t(t)]]);

  std::vector<uint32_t> indices;
  Json list = Json::array();
  for (const auto& [material, corners] : groups) {
    const reports::MaterialLook look = reports::LookOf(material);
    list.push_back({{"material", NameOfMaterial(material)},
                    {"colour", look.colour},
                    {"gloss", look.gloss},
                    {"first", indices.size() / 3},
                    {"count", corners.size() / 3}});
    indices.insert(indices.end(), corners.begin(), corners.end());
  }
  triangles_ = BytesOf(indices);
  const render::Frame frame = render::FrameOf(head_.Vertices(face_template.neutral));
  description_ = {{"num_vertices", head_.num_vertices()},
                  {"num_face_vertices", head_.num_face_vertices()},
                  {"num_triangles", indices.size() / 3},
                  {"groups", std::move(list)},
                  {"centre", {frame.centre.x(), frame.centre.y(), frame.centre.z()}},
                  {"half_height", frame.half_height}};
}

std::string DisplayHead::Vertices(const geometry::Points& face) const {
  const geometry::Points vertices = head_.Vertices(face);
  std::vector<float> numbers;
  numbers.reserve(size_t(vertices.size()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(float(vertices(v, axis)));
  return BytesOf(numbers);
}

}  // namespace daumier::studio
