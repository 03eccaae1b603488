#include "systems/portrait/avatar.h"

#include "core/error.h"
#include "core/num_cores.h"
#include "core/stopwatch.h"
#include "render/draw.h"

#include <utility>

namespace daumier::portrait {
namespace {

using Flat = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>;

double MillisecondsOf(const Stopwatch& watch) {
  return 1e3 * watch.seconds();
}

/// For each vertex of the template its number in a rigged head, -1: none.
std::vector<int> HeadFromFace(const rig::HeadRig& rig, int num_vertices) {
  std::vector<int> numbers(size_t(num_vertices), -1);
  const std::vector<int>& kept = rig.finished_vertices();
  for (size_t i = 0; i < kept.size() && kept[i] < num_vertices; ++i) numbers[size_t(kept[i])] = int(i);
  return numbers;
}

fitting::HeadPainter PainterOf(const rig::HeadRig& rig, const faces::FaceTemplate& face,
                               const fitting::TextureOptions& options) {
  const rig::TextureSpace& space = rig.texture_space();
  const int num_vertices = space.triangles.maxCoeff() + 1;
  return {space, fitting::MakeTextureGuide(face, HeadFromFace(rig, face.num_vertices()), num_vertices), options};
}

/// The head as the picture shows it.
fitting::ShownHead ShownIn(const PortraitReading& reading, const rig::RiggedHead& head,
                           const geometry::Vector3& model_centre) {
  fitting::ShownHead shown;
  shown.vertices = rig::JoinedMesh(head).vertices.rowwise() - model_centre.transpose();
  for (size_t side = 0; side < 2; ++side) shown.eye_centres[side] = head.eyes.at(side).centre - model_centre;
  const auto& x = reading.coefficients;
  for (int k = 0; k < faces::kPoseSlot.count; ++k) shown.pose[k] = x[size_t(faces::kPoseSlot.first + k)];
  fitting::PortraitLight light;
  for (int k = 0; k < faces::kLightSlot.count; ++k) light[size_t(k)] = x[size_t(faces::kLightSlot.first + k)];
  shown.light = light;
  const PictureMap picture_from_crop = reading.map.Inverse();
  shown.camera.linear = picture_from_crop.linear;
  shown.camera.shift = picture_from_crop.shift;
  return shown;
}

}  // namespace

AvatarMaker::AvatarMaker(std::unique_ptr<const PortraitPredictor> predictor, const faces::FaceModel& model,
                         const AvatarOptions& options)
    : predictor_(std::move(predictor)),
      options_(options),
      expression_shapes_(model.expression_shapes),
      targets_(model),
      rig_(model.face_template),
      painter_(PainterOf(rig_, model.face_template, options.texture)) {
  const faces::MorphableModel& of_faces = predictor_->run().model;
  DAUMIER_CHECK(of_faces.face_template.source == model.face_template.source &&
                    of_faces.face_template.num_vertices() == model.face_template.num_vertices(),
                "the portrait network is of the faces '{}', the expressions are of '{}': both have to be of one source",
                of_faces.face_template.source, model.face_template.source);
}

Avatar AvatarMaker::Make(const render::Image& picture) const {
  Stopwatch watch;
  Avatar avatar;
  const PortraitReading reading = predictor_->Read(picture);
  DAUMIER_CHECK(reading.mask.has_value(),
                "the picture was not parsed, so that skin and background cannot be separated: a landmark run or the "
                "weights `landmarks` are needed");
  avatar.face = predictor_->ResultOf(picture, reading);
  avatar.times.face = MillisecondsOf(watch);

  watch = {};
  geometry::Points neutral = avatar.face.vertices;
  if (!options_.keep_expression && avatar.face.expression.size() > 0) {
    const Eigen::Index count = std::min(expression_shapes_.cols(), avatar.face.expression.size());
    const Eigen::VectorXf offset = expression_shapes_.leftCols(count) * avatar.face.expression.head(count);
    neutral -= Flat(offset.data(), neutral.rows(), 3).cast<double>();
  }
  const rig::MorphTargets targets = targets_.On(neutral, unsigned(NumCores()));
  avatar.times.targets = MillisecondsOf(watch);

  watch = {};
  avatar.head = rig_.On(neutral, targets);
  avatar.times.head = MillisecondsOf(watch);

  watch = {};
  const rig::MorphTargets none{{}, Eigen::MatrixXf(avatar.face.vertices.size(), 0)};
  const rig::RiggedHead as_shown = rig_.On(avatar.face.vertices, none);
  avatar.painted =
      painter_.Paint(ShownIn(reading, as_shown, predictor_->run().model.centre), render::ToRgb(picture), *reading.mask);
  avatar.texture = std::make_shared<const render::Image>(avatar.painted.picture);
  avatar.times.texture = MillisecondsOf(watch);
  return avatar;
}

}  // namespace daumier::portrait
