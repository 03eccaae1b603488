#include "cli/edit_files.h"

#include "core/files.h"
#include "core/log.h"
#include "core/staged_directory.h"
#include "geometry/flips.h"
#include "geometry/obj.h"
#include "geometry/ply.h"
#include "geometry/self_intersections.h"
#include "reports/face_pictures.h"
#include "reports/face_surface.h"
#include "reports/textured_head_file.h"

#include <fmt/format.h>

#include <algorithm>

#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kTexturedYaw = -40;  ///< Degrees: half to the face's own right, as the side view is.

/// The faces with their texture, from the front and then turned.
std::vector<render::SheetCell> TexturedCells(const EditContent& content, const render::Frame& frame) {
  std::vector<render::SheetCell> cells;
  for (const double yaw : {0.0, kTexturedYaw}) {
    const render::Camera camera = render::TurnedCamera(frame.centre, frame.half_height, reports::kCell, yaw);
    for (const EditedFace& face : content.faces) {
      const render::RenderInput input{.surface = reports::HeadInAtlas(*content.texture->rig, face.vertices),
                                      .is_solid = true,
                                      .texture = content.texture->picture};
      cells.push_back({render::RenderMesh(input, camera)});
    }
  }
  return cells;
}

render::Image SheetOfEdit(const fitting::CodeModel& model, const EditContent& content) {
  const faces::FaceTemplate& face_template = model.face_template();
  const faces::FinishedHead head = reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral);
  std::vector<geometry::Points> vertices;
  for (const EditedFace& face : content.faces) vertices.push_back(face.vertices);
  const render::Frame frame = reports::FrameOfFaces(vertices);
  std::vector<render::SheetCell> fronts, sides;
  for (const EditedFace& face : content.faces) {
    fronts.push_back({reports::FrontView(head, face.vertices, frame), face.caption});
    sides.push_back({reports::SideView(head, face.vertices, frame)});
  }
  std::vector<render::SheetCell> cells = std::move(fronts);
  cells.insert(cells.end(), sides.begin(), sides.end());
  if (content.texture) {
    const std::vector<render::SheetCell> textured = TexturedCells(content, frame);
    cells.insert(cells.end(), textured.begin(), textured.end());
  }
  render::Image sheet = render::MakeSheet(cells, int(content.faces.size()));
  if (content.pictures.empty()) return sheet;
  std::vector<render::SheetCell> all = content.pictures;
  all.push_back({std::move(sheet)});
  return render::MakeSheet(all, int(all.size()), {.gap = 4});
}

std::vector<double> NumbersOf(const Eigen::VectorXd& vector) {
  return {vector.begin(), vector.end()};
}

}  // namespace

void MeasureFaces(const fitting::CodeModel& model, std::vector<EditedFace>& faces) {
  const faces::FaceTemplate& face_template = model.face_template();
  const double mm_per_cm = faces::MillimetresPerCm(face_template);
  const geometry::Points& first = faces.front().vertices;
  for (EditedFace& face : faces) {
    if (face.code.size() > 0) {
      face.record["radius"] = face.code.norm();
      face.record["usual"] = face.code.norm() <= model.usual_radius();
      if (face.code.norm() > std::max(model.usual_radius(), faces.front().code.norm()))
        log::Warn(
            "{}: the face is unlike those that the model was made of: its code is {:.1f} long, 99 % of theirs are "
            "below {:.1f}. Change it less, or drop --local",
            face.caption, face.code.norm(), model.usual_radius());
    }
    face.record["self_intersections"] = geometry::SelfIntersections({face.vertices, face_template.triangles}).size();
    if (&face == &faces.front()) continue;
    face.record["moved_mm"] = (face.vertices - first).rowwise().norm().mean() * mm_per_cm;
    face.record["new_flips"] = geometry::CountFlippedTriangles(first, face.vertices, face_template.triangles);
  }
}

Json WriteEdit(const fs::path& out, const fitting::CodeModel& model, const EditContent& content) {
  StagedDirectory staged(out, kEditKind);
  Manifest manifest = content.manifest;
  manifest.kind = kEditKind;
  const auto add = [&](const std::string& name) { manifest.checksums[name] = Sha256OfFile(staged.path() / name); };
  Json list = Json::array();
  for (const EditedFace& face : content.faces) {
    const geometry::TriangleMesh mesh = faces::SurfaceMesh(model.face_template(), face.vertices);
    if (content.texture) {
      reports::WriteTexturedHead(staged.path() / (face.name + ".obj"), *content.texture->rig, face.vertices,
                                 kTextureFile);
      add(face.name + ".mtl");
    } else {
      geometry::WriteObj(staged.path() / (face.name + ".obj"), mesh);
    }
    add(face.name + ".obj");
    if (content.writes_ply) {
      geometry::WritePly(staged.path() / (face.name + ".ply"), mesh);
      add(face.name + ".ply");
    }
    Json entry = face.record;
    entry["name"] = face.name;
    if (face.code.size() > 0) {
      entry["code"] = NumbersOf(face.code);
      entry["latent"] = NumbersOf(model.Latent(face.code));
    }
    list.push_back(std::move(entry));
  }
  render::WriteImage(staged.path() / "sheet.png", SheetOfEdit(model, content));
  add("sheet.png");
  Json edit = {{"model", content.model}, {"constraints", content.constraints}, {"faces", std::move(list)}};
  if (content.texture) {
    render::WriteImage(staged.path() / kTextureFile, *content.texture->picture);
    add(kTextureFile);
    edit["texture"] = content.texture->record;
  }
  WriteFileAtomically(staged.path() / "edit.json", edit.dump(1) + "\n");
  add("edit.json");
  manifest.counts["faces"] = content.faces.size();
  WriteManifest(staged.path(), manifest);
  staged.Commit();
  for (Json& face : edit["faces"]) {
    face.erase("code");
    face.erase("latent");
  }
  return edit;
}

}  // namespace daumier::cli
