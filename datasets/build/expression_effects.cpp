#include "datasets/build/expression_effects.h"

#include "core/error.h"
#include "faces/openings.h"

#include <cmath>
#include <limits>

namespace daumier::datasets {
namespace {

constexpr double kAlike = 0.25;  // Of the length of a shape: how far it may be from another one's mirror image.

/// The shape as it is on the other side.
Eigen::VectorXf MirrorShape(const Eigen::VectorXf& shape, const std::vector<int>& mirror) {
  Eigen::VectorXf other(shape.size());
  for (size_t v = 0; v < mirror.size(); ++v) {
    const Eigen::Vector3f d = shape.segment<3>(3 * mirror[v]);
    other.segment<3>(3 * Eigen::Index(v)) = Eigen::Vector3f(-d.x(), d.y(), d.z());
  }
  return other;
}

void FindMirrored(const faces::Annotation& annotation, const Eigen::MatrixXf& shapes,
                  std::vector<ExpressionEffect>& effects) {
  if (annotation.mirror.empty()) return;
  for (Eigen::Index e = 0; e < shapes.cols(); ++e) {
    const Eigen::VectorXf mirrored = MirrorShape(shapes.col(e), annotation.mirror);
    float least = std::numeric_limits<float>::infinity();
    Eigen::Index nearest = e;
    for (Eigen::Index other = 0; other < shapes.cols(); ++other) {
      const float distance = (shapes.col(other) - mirrored).norm();
      if (distance < least) least = distance, nearest = other;
    }
    if (nearest != e && least < float(kAlike) * mirrored.norm()) effects[size_t(e)].mirrored = int(nearest);
  }
  for (size_t e = 0; e < effects.size(); ++e) {
    auto& mirrored = effects[e].mirrored;
    if (mirrored && effects[size_t(*mirrored)].mirrored != int(e)) mirrored.reset();
  }
}

}  // namespace

std::vector<ExpressionEffect> MeasureEffects(const faces::FaceTemplate& face_template, const Eigen::MatrixXf& shapes) {
  const geometry::Points& neutral = face_template.neutral;
  DAUMIER_CHECK(shapes.rows() == neutral.size(), "expression shapes of {} rows on a template of {} coordinates",
                shapes.rows(), neutral.size());
  const faces::FaceOpenings openings = faces::FindOpenings(face_template);
  const auto& landmarks = face_template.annotation.landmarks;
  const auto at = [&](const geometry::Points& face, int l) -> geometry::Vector3 { return face.row(landmarks[l]); };
  const double mouth = (at(neutral, 54) - at(neutral, 48)).norm(), eyes = (at(neutral, 45) - at(neutral, 36)).norm();
  const double side = at(neutral, 54).x() > at(neutral, 48).x() ? 1 : -1;
  const double neutral_crossing = faces::CrossingDepth(openings.lips, neutral);

  std::vector<ExpressionEffect> effects(static_cast<size_t>(shapes.cols()));
  for (Eigen::Index e = 0; e < shapes.cols(); ++e) {
    geometry::Points face = neutral;
    Eigen::Map<Eigen::VectorXd>(face.data(), face.size()) += shapes.col(e).cast<double>();
    ExpressionEffect& effect = effects[size_t(e)];
    for (size_t eye = 0; eye < 2; ++eye) {
      const double before = faces::MeanGap(openings.lids[eye], neutral);
      effect.closes[eye] = before > 0 ? 1 - faces::MeanGap(openings.lids[eye], face) / before : 0;
    }
    effect.opens = (faces::MeanGap(openings.lips, face) - faces::MeanGap(openings.lips, neutral)) / mouth;
    for (const auto& [l, outwards] : {std::pair(48, -side), std::pair(54, side)}) {
      const geometry::Vector3 way = at(face, l) - at(neutral, l);
      effect.smiles += (way.y() + outwards * way.x()) / 2 / mouth;
    }
    for (int l = 17; l < 27; ++l) effect.brows += (at(face, l).y() - at(neutral, l).y()) / 10 / eyes;
    effect.lips_cross = (faces::CrossingDepth(openings.lips, face) - neutral_crossing) / mouth;
  }
  FindMirrored(face_template.annotation, shapes, effects);
  return effects;
}

}  // namespace daumier::datasets
