#include "faces/appearance/portrait_head.h"

#include "core/error.h"
#include "faces/appearance/beards.h"
#include "faces/appearance/brows.h"
#include "faces/appearance/bust.h"
#include "faces/appearance/eyes.h"
#include "faces/appearance/glasses.h"
#include "faces/appearance/hair.h"
#include "faces/appearance/hats.h"
#include "faces/appearance/head_soup.h"
#include "faces/appearance/mouth.h"
#include "faces/appearance/scalp.h"
#include "faces/appearance/skin_fields.h"
#include "geometry/normals.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace daumier::faces {
namespace {

bool IsOfEyeball(HeadMaterial material) {
  return material == HeadMaterial::kSclera || material == HeadMaterial::kLimbus || material == HeadMaterial::kIris ||
         material == HeadMaterial::kPupil;
}

}  // namespace

struct HeadDresser::Parts {
  explicit Parts(const FaceTemplate& face)
      : face_template(face),
        finished(face),
        albedo(MakeAlbedoBasis(face)),
        scalp(face),
        brows(face),
        beards(face),
        glasses(face),
        lips(FindLipContours(face)) {
    const Eigen::VectorXd lip = LipIndicator(face);
    std::vector<bool> is_ear(size_t(face.num_vertices()), false);
    if (const auto ears = face.annotation.regions.find("ears"); ears != face.annotation.regions.end())
      for (const int v : ears->second) is_ear[size_t(v)] = true;
    const int num_vertices = face.num_vertices();
    for (const auto& t : finished.skin().rowwise()) {
      PictureClass mask = PictureClass::kSkin;
      if (t.maxCoeff() < num_vertices) {
        if (lip[t[0]] > 0 && lip[t[1]] > 0 && lip[t[2]] > 0) mask = PictureClass::kLips;
        if (is_ear[size_t(t[0])] && is_ear[size_t(t[1])] && is_ear[size_t(t[2])]) mask = PictureClass::kEars;
      }
      skin_masks.push_back(mask);
    }
    for (int v = 0; v < num_vertices; ++v)
      if (lip[v] > 0) lip_vertices.push_back(v);
    std::map<std::pair<int, HeadMaterial>, int> copies;
    for (Eigen::Index t = 0; t < finished.parts().rows(); ++t) {
      const HeadMaterial material = finished.part_materials()[size_t(t)];
      if (IsOfEyeball(material)) continue;
      Eigen::Vector3i corners;
      for (int k = 0; k < 3; ++k) {
        const auto [at, is_new] =
            copies.emplace(std::pair{finished.parts()(t, k), material}, int(part_vertices.size()));
        if (is_new) part_vertices.push_back({finished.parts()(t, k), material});
        corners[k] = at->second;
      }
      part_triangles.push_back(corners);
      part_materials.push_back(material);
    }
    // The first rows of a finished head, before the parts', that have colours.
    Eigen::VectorXd known = finished.Values(Eigen::VectorXd::Zero(num_vertices));
    for (int v = num_vertices; v < finished.num_vertices(); ++v)
      if (known[v] == known[v]) edge_vertices.push_back(v);
  }

  FaceTemplate face_template;
  FinishedHead finished;
  AlbedoBasis albedo;
  Scalp scalp;
  BrowPatches brows;
  BeardShells beards;
  GlassesFit glasses;
  LipContours lips;
  std::vector<PictureClass> skin_masks;
  std::vector<int> lip_vertices, edge_vertices;
  struct Copy {
    int vertex;
    HeadMaterial material;
  };
  std::vector<Copy> part_vertices;  ///< Of lid rims and mouth, repeated for each material.
  std::vector<Eigen::Vector3i> part_triangles;
  std::vector<HeadMaterial> part_materials;
};

HeadDresser::HeadDresser(const FaceTemplate& face_template) : parts_(std::make_unique<const Parts>(face_template)) {}
HeadDresser::~HeadDresser() = default;
HeadDresser::HeadDresser(HeadDresser&&) noexcept = default;
HeadDresser& HeadDresser::operator=(HeadDresser&&) noexcept = default;

const FaceTemplate& HeadDresser::face_template() const {
  return parts_->face_template;
}
const FinishedHead& HeadDresser::finished() const {
  return parts_->finished;
}
const AlbedoBasis& HeadDresser::albedo() const {
  return parts_->albedo;
}

PortraitHead HeadDresser::Dress(const geometry::Points& face, const Looks& looks) const {
  const Parts& parts = *parts_;
  const geometry::Points vertices = parts.finished.Vertices(face);
  const Eigen::MatrixXf skin = AlbedoOf(parts.albedo, looks.albedo);
  Eigen::MatrixXf colours(vertices.rows(), 3);
  colours.topRows(face.rows()) = skin;
  colours.bottomRows(vertices.rows() - face.rows()).rowwise() = skin.colwise().mean();
  if (!parts.edge_vertices.empty()) {
    Eigen::RowVector3f border = Eigen::RowVector3f::Zero();
    for (int channel = 0; channel < 3; ++channel) {
      const Eigen::VectorXd values = parts.finished.Values(skin.col(channel).cast<double>());
      for (const int v : parts.edge_vertices) {
        colours(v, channel) = float(values[v]);
        border[channel] += float(values[v]) / float(parts.edge_vertices.size());
      }
    }
    for (int v = parts.edge_vertices.back() + 1; v < colours.rows(); ++v) colours.row(v) = border;
  }
  const geometry::Points normals = geometry::VertexNormals({face, parts.face_template.triangles});

  HeadSoup soup(vertices, colours);
  for (Eigen::Index t = 0; t < parts.finished.skin().rows(); ++t) {
    const auto corners = parts.finished.skin().row(t);
    soup.AddTriangle(corners[0], corners[1], corners[2], {parts.skin_masks[size_t(t)], PicturePart::kSkin});
  }
  Eigen::Vector3f lip_colour = Eigen::Vector3f::Zero();
  for (const int v : parts.lip_vertices) lip_colour += skin.row(v).transpose() / float(parts.lip_vertices.size());
  const int first = soup.size();
  for (const Parts::Copy& copy : parts.part_vertices) {
    Eigen::Vector3f colour(0.38f, 0.11f, 0.11f);
    if (copy.material == HeadMaterial::kThroat) colour = {0.16f, 0.03f, 0.04f};
    if (copy.material == HeadMaterial::kInnerLip) colour = 0.8f * lip_colour;
    if (copy.material == HeadMaterial::kLidRim) colour = 0.8f * colours.row(copy.vertex).transpose();
    soup.AddVertex(vertices.row(copy.vertex), colour);
  }
  for (size_t t = 0; t < parts.part_triangles.size(); ++t) {
    const Eigen::Vector3i corners = parts.part_triangles[t].array() + first;
    SoupKind kind{PictureClass::kMouth, PicturePart::kMouth};
    if (parts.part_materials[t] == HeadMaterial::kInnerLip) kind.mask = PictureClass::kLips;
    if (parts.part_materials[t] == HeadMaterial::kLidRim) kind = {PictureClass::kEyes, PicturePart::kLidRim};
    soup.AddTriangle(corners[0], corners[1], corners[2], kind);
  }
  for (const Eyeball& eyeball : parts.finished.Eyeballs(face)) AddEye(eyeball, looks, soup);
  AddTeeth(parts.lips, face, soup);
  parts.brows.AddBrows(face, normals, looks, soup);
  parts.brows.AddLashes(face, normals, looks, soup);

  const SkullGrid skull = parts.scalp.GridOf(face);
  const double size = skull.radius() / kUsualSkullRadius;
  const HatFit hat(looks.hat, parts.scalp.lines(), size);
  std::vector<geometry::Vector3> border;
  for (const int v : parts.edge_vertices) border.emplace_back(vertices.row(v));
  Eigen::Vector3f neck = Eigen::Vector3f::Zero();
  for (const int v : parts.edge_vertices) neck += colours.row(v).transpose() / float(parts.edge_vertices.size());
  AddBust(border, neck, size, looks, soup);
  AddHair(skull, parts.scalp.lines(), hat, size, looks, soup);
  parts.beards.AddBeard(face, normals, looks, size, soup);
  AddHat(skull, hat, size, looks, soup);
  parts.glasses.AddGlasses(face, looks, soup);
  return soup.Take();
}

}  // namespace daumier::faces
