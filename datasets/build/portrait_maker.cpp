#include "datasets/build/portrait_maker.h"

#include "core/error.h"
#include "datasets/build/portrait_buffers.h"
#include "faces/appearance/skin_tone.h"
#include "render/styles/styled_picture.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

using render::PictureStyle;

/// Nothing that is not the face's own: for pictures of heads of clay.
void Undress(faces::Looks& looks) {
  looks.hair = faces::HairStyle::kBald;
  looks.beard = faces::BeardStyle::kNone;
  looks.hat = faces::HatStyle::kNone;
  looks.glasses = faces::GlassesStyle::kNone;
  looks.lash_length = 0;
  looks.lid_line = 0;
}

bool IsBare(const faces::Looks& looks) {
  return looks.hair == faces::HairStyle::kBald && looks.beard == faces::BeardStyle::kNone &&
         looks.hat == faces::HatStyle::kNone && looks.glasses == faces::GlassesStyle::kNone;
}

/// A point is hidden by what lies in front of it by more than this.
constexpr double kHiddenMm = 3;

constexpr const char* kGreySuffix = "_grey";

int StyleIndex(const render::StyleChoice& choice) {
  const std::vector<std::string> names = PortraitMaker::StyleNames();
  const auto found = std::find(names.begin(), names.end(), render::StyleName(choice));
  DAUMIER_CHECK(found != names.end(), "the style {} is not in the list", render::StyleName(choice));
  return static_cast<int>(found - names.begin());
}

}  // namespace

std::vector<std::string> PortraitMaker::StyleNames() {
  std::vector<std::string> names;
  for (int style = 0; style < render::kNumPictureStyles; ++style)
    names.emplace_back(render::NameOf(PictureStyle(style)));
  for (int style = 0; style < render::kNumPictureStyles; ++style) names.push_back(names[size_t(style)] + kGreySuffix);
  return names;
}

PortraitMaker::PortraitMaker(const faces::FaceTemplate& face_template, const PictureOptions& options)
    : face_template_(face_template),
      options_(options),
      dresser_(face_template),
      openings_(faces::FindOpenings(face_template)),
      lines_(face_template),
      mm_per_cm_(faces::MillimetresPerCm(face_template)) {
  const auto& landmarks = face_template.annotation.landmarks;
  centre_ = face_template.neutral(landmarks, Eigen::all).colwise().mean();
}

PortraitRecord PortraitMaker::Make(const geometry::Points& face, Rng& rng,
                                   const std::function<void(const render::PictureBuffers&)>& inspect) const {
  PortraitRecord record;
  const geometry::Points vertices = face.rowwise() - centre_.transpose();
  const geometry::Points landmarks = vertices(face_template_.annotation.landmarks, Eigen::all);

  faces::Looks looks = faces::DrawLooks(rng, options_.looks);
  const render::StyleChoice style = render::DrawStyleChoice(rng, options_.styles);
  const bool undress = rng.Uniform() < options_.bald;
  if (style.style == PictureStyle::kClay && undress) Undress(looks);
  record.is_bald = style.style == PictureStyle::kClay && IsBare(looks);
  record.pose = DrawPose(landmarks, optics_, options_.pose, rng);
  record.light = DrawLight(rng);

  const render::Camera camera = PortraitCamera(optics_, record.pose);
  const faces::PortraitHead head = dresser_.Dress(vertices, looks);
  render::PictureBuffers buffers = DrawBuffers(head, camera, record.light, options_.supersampling);
  if (render::UsesStrokes(style)) buffers.lines = lines_.Draw(head, render::Enlarged(camera, options_.supersampling));
  if (inspect) inspect(buffers);

  const render::Image mask = MaskOf(buffers);
  record.mask = render::EncodeImage(mask, render::ImageFormat::kPng);
  const render::Image picture = render::ApplyPhotoEffects(render::DrawStyled(buffers, style, rng),
                                                          render::DrawPhotoEffects(rng, options_.effects), rng);
  record.picture = options_.format == "png"
                       ? render::EncodeImage(picture, render::ImageFormat::kPng)
                       : render::EncodeImage(picture, render::ImageFormat::kJpeg, options_.quality);

  const geometry::Points pixels = render::Project(camera, landmarks);
  for (Eigen::Index l = 0; l < landmarks.rows(); ++l) {
    record.landmarks[size_t(2 * l)] = static_cast<float>(pixels(l, 0));
    record.landmarks[size_t(2 * l + 1)] = static_cast<float>(pixels(l, 1));
  }
  const std::vector<uint8_t> seen = SeenPoints(buffers, camera, landmarks, kHiddenMm / mm_per_cm_);
  std::ranges::copy(seen, record.visibility.begin());
  record.states = {static_cast<float>(mm_per_cm_ * faces::MeanGap(openings_.lids[0], vertices)),
                   static_cast<float>(mm_per_cm_ * faces::MeanGap(openings_.lids[1], vertices)),
                   static_cast<float>(mm_per_cm_ * faces::MeanGap(openings_.lips, vertices))};
  std::copy(looks.albedo.begin(), looks.albedo.end(), record.albedo.begin());
  record.style = StyleIndex(style);
  record.skin_tone = faces::SkinToneOf(looks.albedo);
  record.vertices = vertices;
  return record;
}

}  // namespace daumier::datasets
