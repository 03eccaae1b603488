#include "cli/edit_texture.h"

#include "cli/shipped_landmarks.h"
#include "core/error.h"
#include "fitting/landmark_head.h"
#include "render/draw.h"

#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

/// The 68 landmarks; those of the face for what is absent.
std::vector<float> AllLandmarks(const PicturedFace& pictured, const EditedFace& face, const fitting::CodeModel& model) {
  const fitting::PicturePoints shown =
      fitting::ShownLandmarks(model, fitting::ContourPaths(model.face_template()), face.code, pictured.view);
  std::vector<float> numbers;
  for (Eigen::Index k = 0; k < shown.rows(); ++k) {
    const Eigen::RowVector2d at = pictured.landmarks.row(k).allFinite() ? pictured.landmarks.row(k) : shown.row(k);
    numbers.push_back(float(at.x()));
    numbers.push_back(float(at.y()));
  }
  return numbers;
}

void Paint(const PicturedFace& pictured, const EditedFace& face, const fitting::CodeModel& model, int size,
           EditTexture& texture) {
  const ShippedLandmarks network;
  const render::Image picture = render::ToRgb(render::ReadImage(pictured.picture));
  const portrait::DetectedFace parsed = network.detector().FindGiven(picture, AllLandmarks(pictured, face, model));
  const render::Image mask = network.detector().HeadMask(picture, parsed);
  const fitting::HeadTexture painted = fitting::PaintHead(
      texture.rig->texture_space(), fitting::MakeTextureGuide(model.face_template(), *texture.rig),
      fitting::ShownHeadOf(*texture.rig, model.face_template(), face.vertices, pictured.view, pictured.landmarks),
      picture, mask, {.size = size, .keep_gaze = true});
  texture.picture = std::make_shared<const render::Image>(painted.picture);
  texture.record["picture"] = pictured.picture.filename().string();
  texture.record["seen"] = painted.seen;
  texture.record["mirrored"] = painted.mirrored;
  texture.record["filled"] = painted.filled;
}

/// That of the edit which the code comes from.
void TakeEarlier(const fs::path& code, EditTexture& texture) {
  const fs::path file = FileOfCode(code).file;
  const Json edit = ReadJson(file);
  DAUMIER_CHECK(edit.contains("texture"), "{}: that edit has no texture: repeat it with --texture", file.string());
  const Json earlier = edit.at("texture");
  for (const char* key : {"topology", "vertices"})
    DAUMIER_CHECK(earlier.contains(key) && earlier.at(key) == texture.record.at(key),
                  "{}: its texture is that of another topology ({})", file.string(), key);
  texture.record = earlier;
  texture.picture =
      std::make_shared<const render::Image>(render::ToRgb(render::ReadImage(file.parent_path() / kTextureFile)));
}

}  // namespace

EditTexture TextureOf(const EditStartArguments& arguments, const EditStart& start, const fitting::CodeModel& model,
                      int size) {
  if (!start.pictured && arguments.code.empty())
    throw UsageError(
        "--texture needs the picture that the face was found in: --picture FILE, with or without --landmarks, or "
        "--code "
        "of an edit that has a texture");
  const faces::FaceTemplate& face_template = model.face_template();
  EditTexture texture{.rig = std::make_unique<const rig::HeadRig>(face_template), .picture = {}, .record = {}};
  texture.record = {{"file", kTextureFile},
                    {"topology", face_template.source},
                    {"vertices", face_template.num_vertices()},
                    {"size", size}};
  if (start.pictured) {
    Paint(*start.pictured, start.face, model, size, texture);
  } else {
    TakeEarlier(arguments.code, texture);
  }
  return texture;
}

}  // namespace daumier::cli
