#include "datasets/build/portrait_maker.h"

#include "core/error.h"
#include "datasets/build/portrait_buffers.h"
#include "faces/appearance/skin_tone.h"
#include "render/styles/styled_picture.h"

#include <algorithm>
#include <limits>

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

render::FloatImage ToFloatImage(const render::PictureBuffers& buffers, const PortraitOptics& optics) {
  render::FloatImage image{buffers.height, buffers.width, {}};
  const auto channel = [&](const char* name) -> std::vector<float>& {
    auto& values = image.channels[name];
    values.resize(buffers.size());
    return values;
  };
  auto &depths = channel("Z"), &px = channel("P.X"), &py = channel("P.Y"), &pz = channel("P.Z");
  const std::array<std::vector<float>*, 3> normals = {&channel("N.X"), &channel("N.Y"), &channel("N.Z")};
  for (size_t pixel = 0; pixel < buffers.size(); ++pixel) {
    depths[pixel] = std::numeric_limits<float>::infinity();
    if (!buffers.is_covered(pixel)) continue;
    const double x = double(pixel % size_t(buffers.width)) + 0.5, y = double(pixel / size_t(buffers.width)) + 0.5;
    const double depth = buffers.depth[pixel], middle = optics.size / 2.0;
    depths[pixel] = buffers.depth[pixel];
    px[pixel] = static_cast<float>((x - middle) * depth / optics.focal);
    py[pixel] = static_cast<float>((middle - y) * depth / optics.focal);
    pz[pixel] = static_cast<float>(optics.distance - depth);
    for (size_t axis = 0; axis < 3; ++axis) (*normals[axis])[pixel] = buffers.normal[3 * pixel + axis];
  }
  return image;
}

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

PortraitRecord PortraitMaker::MakeWithBuffers(const geometry::Points& face, Rng& rng,
                                              render::FloatImage* float_buffers) const {
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
  if (render::UsesStrokes(style))
    buffers.lines = lines_.Draw(vertices, render::Enlarged(camera, options_.supersampling), buffers);
  if (float_buffers) *float_buffers = ToFloatImage(DrawBuffers(head, camera, record.light, 1), optics_);

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
