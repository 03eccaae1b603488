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
    : face_triangles_(face_template.triangles),
      head_(reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral)),
      parts_(head_.parts()),
      part_materials_(head_.part_materials()) {
  if (head_.mouth()) {
    interior_.emplace(face_template);
    for (const rig::ChartPiece& piece : rig::HeadInterior::Charts(head_.num_vertices())) {
      const Eigen::Index first = parts_.rows();
      parts_.conservativeResize(first + piece.triangles.rows(), 3);
      parts_.bottomRows(piece.triangles.rows()) = piece.triangles;
    }
    const std::vector<faces::HeadMaterial> materials = rig::HeadInterior::Materials();
    part_materials_.insert(part_materials_.end(), materials.begin(), materials.end());
  }
  std::map<faces::HeadMaterial, std::vector<uint32_t>> groups;
  for (Eigen::Index t = 0; t < head_.skin().rows(); ++t) Append(head_.skin(), t, groups[faces::HeadMaterial::kSkin]);
  for (Eigen::Index t = 0; t < parts_.rows(); ++t) Append(parts_, t, groups[part_materials_[size_t(t)]]);

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
  description_ = {{"num_vertices", head_.num_vertices() + (interior_ ? rig::HeadInterior::NumVertices() : 0)},
                  {"num_face_vertices", head_.num_face_vertices()},
                  {"num_triangles", indices.size() / 3},
                  {"groups", std::move(list)},
                  {"centre", {frame.centre.x(), frame.centre.y(), frame.centre.z()}},
                  {"half_height", frame.half_height}};
}

bool DisplayHead::IsBareFace(const geometry::TriangleMesh& mesh) const {
  return mesh.vertices.rows() == head_.num_face_vertices() && mesh.triangles.rows() == face_triangles_.rows() &&
         mesh.triangles == face_triangles_;
}

geometry::Points DisplayHead::PointsOf(const geometry::Points& face) const {
  geometry::Points points = head_.Vertices(face);
  if (!interior_) return points;
  const geometry::Points interior = interior_->Vertices(face);
  const Eigen::Index first = points.rows();
  points.conservativeResize(first + interior.rows(), 3);
  points.bottomRows(interior.rows()) = interior;
  return points;
}

std::string DisplayHead::Vertices(const geometry::Points& face) const {
  const geometry::Points vertices = PointsOf(face);
  std::vector<float> numbers;
  numbers.reserve(size_t(vertices.size()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(float(vertices(v, axis)));
  return BytesOf(numbers);
}

render::RenderInput DisplayHead::Picture(const geometry::Points& face) const {
  render::RenderInput input{.surface = {PointsOf(face), head_.skin()}, .closing_triangles = parts_};
  input.is_solid = head_.faces_outwards();
  for (const faces::HeadMaterial material : part_materials_) {
    const reports::MaterialLook look = reports::LookOf(material);
    input.closing_colours.push_back(look.colour);
    input.closing_gloss.push_back(look.gloss);
  }
  return input;
}

}  // namespace daumier::studio
