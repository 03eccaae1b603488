#pragma once
#include "core/files.h"
#include "datasets/build/portrait_shard.h"
#include "faces/morphable_model.h"
#include "faces/openings.h"
#include "systems/portrait/portrait_picture.h"
#include "tests/support/synthetic_database.h"

#include <array>
#include <filesystem>
#include <vector>

/// Portraits of the synthetic face, drawn by FacePainter: what a portrait network can explain exactly. The same bytes on every
/// call.
namespace daumier::testing {

/// Colours of the synthetic face: skin with a red mouth, and three modes.
inline faces::AlbedoModes SyntheticColours(const faces::FaceTemplate& face_template) {
  const geometry::Points& p = face_template.neutral;
  faces::AlbedoModes colours{Eigen::MatrixXf(p.rows(), 3), Eigen::MatrixXf::Zero(p.size(), 3)};
  const geometry::Vector3 mouth = p.row(face_template.annotation.landmarks[66]);
  for (Eigen::Index v = 0; v < p.rows(); ++v) {
    const double near = std::exp(-(p.row(v).transpose() - mouth).squaredNorm() / 4);
    colours.mean.row(v) << float(0.75), float(0.55 - 0.3 * near), float(0.45 - 0.2 * near);
    colours.modes.col(0).segment<3>(3 * v).setConstant(0.1F);
    colours.modes(3 * v, 1) = 0.08F;
    colours.modes.col(2).segment<3>(3 * v).setConstant(float(0.05 * std::sin(0.8 * p(v, 1))));
  }
  return colours;
}

inline faces::MorphableModel SyntheticMorphable() {
  const faces::FaceModel source = SyntheticModel();
  return faces::ModelOfShapes(source, SyntheticColours(source.face_template));
}

/// 239 coefficients of a random face of a model, looking about to the front.
inline std::vector<float> DrawPortrait(const faces::MorphableModel& model, Rng& rng) {
  std::vector<float> x(faces::kNumCoefficients);
  const auto at = [&](const faces::CoefficientSlot& slot, int k) -> float& { return x[size_t(slot.first + k)]; };
  for (int k = 0; k < model.identity.cols(); ++k) at(faces::kIdentitySlot, k) = float(rng.Normal());
  for (int k = 0; k < model.expression.cols(); ++k)
    at(faces::kExpressionSlot, k) = rng.Uniform() < 0.5 ? 0 : float(rng.Uniform());
  for (int k = 0; k < model.albedo_modes.cols(); ++k) at(faces::kAlbedoSlot, k) = float(rng.Normal());
  for (int k = 0; k < faces::kLightSlot.count; ++k) at(faces::kLightSlot, k) = float(0.1 * rng.Normal());
  const std::array<double, 6> spread = {0.1, 0.3, 0.1, 1, 1, 4};
  for (int k = 0; k < 6; ++k) at(faces::kPoseSlot, k) = float(spread[size_t(k)] * rng.Normal());
  at(faces::kPoseSlot, 5) -= 40;
  return x;
}

/// Of the Rng from which DrawPortrait draws the portraits of WriteSmallPortraits, one after the other.
inline constexpr uint64_t kSmallPortraitSeed = 11;

/// Writes a PortraitDatabase of `per_person` portraits of each person of a database of faces of the synthetic model. The faces
/// shown are the model's own, not those of the database.
inline void WriteSmallPortraits(const std::filesystem::path& faces_folder, const std::filesystem::path& folder,
                                int per_person) {
  const faces::FaceDatabase faces_database(faces_folder);
  const faces::MorphableModel model = SyntheticMorphable();
  const portrait::FacePainter painter(model);
  const faces::FaceOpenings openings = faces::FindOpenings(model.face_template);
  const double mm = faces::MillimetresPerCm(model.face_template);
  Manifest manifest{.kind = "portraits", .verb = "dataset portraits"};
  MakeDirectory(folder / "shards");
  manifest.checksums = faces::WriteFaceTemplate(folder, SyntheticFace());
  Rng rng(kSmallPortraitSeed);
  for (int person = 0; person < faces_database.num_persons(); ++person) {
    std::vector<datasets::PortraitRecord> records;
    for (int i = 0; i < per_person; ++i) {
      const std::vector<float> x = DrawPortrait(model, rng);
      const portrait::FacePicture face = painter.Paint(x);
      render::Image picture(224, 224, 3, 60), mask(224, 224, 1, 0);
      picture = portrait::OverlayFace(picture, face);
      for (size_t p = 0; p < mask.pixels.size(); ++p) mask.pixels[p] = face.colours[4 * p + 3] > 0.5F ? 1 : 0;
      datasets::PortraitRecord record;
      record.picture = render::EncodeImage(picture, render::ImageFormat::kPng);
      record.mask = render::EncodeImage(mask, render::ImageFormat::kPng);
      std::copy(face.landmarks.begin(), face.landmarks.end(), record.landmarks.begin());
      record.visibility.fill(1);
      record.vertices = faces::Reconstruct(model, x).vertices;
      record.states = {float(mm * faces::MeanGap(openings.lids[0], record.vertices)),
                       float(mm * faces::MeanGap(openings.lids[1], record.vertices)),
                       float(mm * faces::MeanGap(openings.lips, record.vertices))};
      const auto copy = [&](const faces::CoefficientSlot& slot, auto& to) {
        std::copy_n(x.begin() + slot.first, slot.count, to.begin());
      };
      copy(faces::kExpressionSlot, record.expression);
      copy(faces::kAlbedoSlot, record.albedo);
      copy(faces::kLightSlot, record.light);
      copy(faces::kPoseSlot, record.pose);
      record.person = person;
      record.face = faces_database.index({person, 0, 0});
      records.push_back(std::move(record));
    }
    manifest.checksums[datasets::PortraitShardName(person)] =
        datasets::WritePortraitShard(folder / datasets::PortraitShardName(person), records);
  }
  const int count = faces_database.num_persons() * per_person;
  manifest.counts = {{"images", count}, {"shards", faces_database.num_persons()}};
  manifest.details = {{"faces_data_hash", DataHash(faces_folder)},
                      {"size", 224},
                      {"focal", 1015.0},
                      {"distance", 100.0},
                      {"centre", {model.centre.x(), model.centre.y(), model.centre.z()}},
                      {"vertices", true},
                      {"expressions", model.expression_names},
                      {"styles", {"plain"}}};
  manifest.sources = faces_database.manifest().sources;
  WriteManifest(folder, manifest);
}

}  // namespace daumier::testing
