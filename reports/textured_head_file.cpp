#include "reports/textured_head_file.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/obj.h"
#include "reports/face_surface.h"

#include <vector>

namespace daumier::reports {
namespace {

const char* GroupOf(rig::TextureChart chart) {
  using enum rig::TextureChart;
  switch (chart) {
    case kSkin:
      return "face";
    case kNeckCap:
      return "neck";
    case kMouth:
    case kTeeth:
    case kTongue:
      return "mouth";
    default:
      return "eyes";
  }
}

/// Every material of an MTL file gets a picture; materials end with an empty line.
void AddPicture(const std::filesystem::path& library, const std::string& texture) {
  std::string text = ReadFile(library);
  const std::string line = "map_Kd " + texture + "\n";
  for (size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n", end + line.size() + 2))
    text.insert(end + 1, line);
  WriteFileAtomically(library, text);
}

bool IsEyeball(rig::TextureChart chart) {
  return chart == rig::TextureChart::kRightEye || chart == rig::TextureChart::kLeftEye;
}

}  // namespace

geometry::TriangleMesh HeadInAtlas(const rig::HeadRig& rig, const geometry::Points& face) {
  DAUMIER_CHECK(face.rows() == rig.finished().num_face_vertices(), "a face of {} vertices, expected {}", face.rows(),
                rig.finished().num_face_vertices());
  geometry::TriangleMesh head = rig::JoinedMesh(rig.On(face, {{}, Eigen::MatrixXf(face.size(), 0)}));
  const std::vector<int>& finished = rig.finished_vertices();
  std::vector<int> places(size_t(head.vertices.rows()));
  int num_vertices = int(face.rows());
  for (size_t i = 0; i < places.size(); ++i)
    places[i] = i < finished.size() && finished[i] < face.rows() ? finished[i] : num_vertices++;
  geometry::Points vertices(num_vertices, 3);
  vertices.topRows(face.rows()) = face;
  for (size_t i = 0; i < places.size(); ++i) vertices.row(places[i]) = head.vertices.row(Eigen::Index(i));
  head.vertices = std::move(vertices);
  head.triangles = head.triangles.unaryExpr([&](int vertex) { return places[size_t(vertex)]; }).eval();
  return head;
}

void WriteTexturedHead(const std::filesystem::path& path, const rig::HeadRig& rig, const geometry::Points& face,
                       const std::string& texture) {
  std::vector<geometry::ObjPart> parts;
  for (const rig::TextureChart chart : rig.texture_space().charts) {
    const std::string group = GroupOf(chart), material = IsEyeball(chart) ? "eyes" : "head";
    if (parts.empty() || parts.back().group != group || parts.back().material != material)
      parts.push_back({group, material, 0});
    ++parts.back().num_triangles;
  }
  const float gloss = LookOf(faces::HeadMaterial::kSclera).gloss;
  geometry::WriteObj(path, HeadInAtlas(rig, face), parts, {{"head", {1, 1, 1}, 0}, {"eyes", {1, 1, 1}, gloss}});
  AddPicture(std::filesystem::path(path).replace_extension(".mtl"), texture);
}

}  // namespace daumier::reports
