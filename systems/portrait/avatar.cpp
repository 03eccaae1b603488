#include "systems/portrait/avatar.h"

#include "core/error.h"
#include "core/num_cores.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "render/draw.h"

#include <algorithm>
#include <span>
#include <utility>

namespace daumier::portrait {
namespace {

using Flat = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>;

double MillisecondsOf(const Stopwatch& watch) {
  return 1e3 * watch.seconds();
}

fitting::PortraitLight LightOf(std::span<const float> coefficients) {
  fitting::PortraitLight light;
  std::ranges::copy(coefficients.subspan(size_t(faces::kLightSlot.first), light.size()), light.begin());
  return light;
}

/// From the crop to the picture.
fitting::PictureCamera CameraOf(const PictureMap& crop_from_picture) {
  const PictureMap picture_from_crop = crop_from_picture.Inverse();
  return {.view = {}, .linear = picture_from_crop.linear, .shift = picture_from_crop.shift};
}

}  // namespace

AvatarMaker::AvatarMaker(const std::function<std::unique_ptr<const PortraitPredictor>()>& open,
                         const faces::FaceModel& model, const AvatarOptions& options)
    : options_(options), expression_shapes_(model.expression_shapes) {
  if (options_.keep_expression) options_.texture.keep_gaze = true;
  if (options_.style.ends_with(".onnx")) {
    style_.emplace(options_.style, options_.network);
  } else if (options_.style != "none" && options_.style != "toon") {
    throw UsageError(
        fmt::format("there is no style '{}' (expected none, toon or a file that ends in .onnx)", options_.style));
  }
  OnAllCores(2, [&](int64_t part) {
    if (part == 0) {
      predictor_ = open();
      targets_.emplace(model);
    } else {
      rig_.emplace(model.face_template);
      painter_.emplace(rig_->texture_space(), fitting::MakeTextureGuide(model.face_template, *rig_), options_.texture);
    }
  });
  const faces::MorphableModel& of_faces = predictor_->run().model;
  DAUMIER_CHECK(of_faces.face_template.source == model.face_template.source &&
                    of_faces.face_template.num_vertices() == model.face_template.num_vertices(),
                "the portrait network is of the faces '{}', the expressions are of '{}': both have to be of one source",
                of_faces.face_template.source, model.face_template.source);
}

FoundPortrait AvatarMaker::FindStyled(render::Image& picture) const {
  if (style_) picture = style_->Apply(picture);
  FoundPortrait found = predictor_->Find(picture);
  if (options_.style != "toon" || found.landmarks.empty()) return found;
  ToonPortrait toon = MakeToonPortrait(picture, found.landmarks, found.mask ? &*found.mask : nullptr, options_.toon);
  picture = std::move(toon.picture);
  found.landmarks = std::move(toon.landmarks);
  found.mask = std::move(toon.mask);
  return found;
}

geometry::Points AvatarMaker::NeutralOf(const systems::FaceResult& face, const FaceEdit& edit) const {
  const Eigen::Index count = std::min(expression_shapes_.cols(), face.expression.size());
  const Eigen::VectorXf shown = expression_shapes_.leftCols(count) * face.expression.head(count);
  const geometry::Points expression = Flat(shown.data(), face.vertices.rows(), 3).cast<double>();
  geometry::Points neutral = face.vertices - expression;
  if (edit) neutral = edit(neutral);
  return options_.keep_expression ? geometry::Points(neutral + expression) : neutral;
}

Avatar AvatarMaker::Make(const render::Image& picture, const FaceEdit& edit) const {
  Stopwatch watch;
  Avatar avatar;
  avatar.picture = render::ToRgb(picture);
  FoundPortrait found = FindStyled(avatar.picture);
  avatar.times.style = MillisecondsOf(watch);

  watch = {};
  PortraitReading reading = predictor_->ReadFound(avatar.picture, std::move(found));
  DAUMIER_CHECK(reading.mask.has_value(),
                "the picture was not parsed, so that skin and background cannot be separated: a landmark run or the "
                "weights `landmarks` are needed");
  avatar.face = predictor_->ResultOf(avatar.picture, reading);
  avatar.times.face = MillisecondsOf(watch);

  watch = {};
  avatar.neutral = NeutralOf(avatar.face, edit);
  const rig::MorphTargets targets = targets_->On(avatar.neutral, unsigned(NumCores()));
  avatar.times.targets = MillisecondsOf(watch);

  watch = {};
  avatar.head = rig_->On(avatar.neutral, targets);
  avatar.times.head = MillisecondsOf(watch);

  watch = {};
  const fitting::ShownHead shown =
      fitting::ShownHeadOf(*rig_, reading.face.vertices, PoseOfCoefficients(reading.coefficients),
                           CameraOf(reading.map), LightOf(reading.coefficients), reading.face.albedo);
  avatar.painted = painter_->Paint(shown, avatar.picture, *reading.mask);
  avatar.texture = std::make_shared<const render::Image>(avatar.painted.picture);
  avatar.times.texture = MillisecondsOf(watch);
  avatar.found = std::move(static_cast<FoundPortrait&>(reading));
  return avatar;
}

}  // namespace daumier::portrait
