#pragma once

#include "faces/face_model.h"
#include "fitting/texture_head.h"
#include "render/image.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"
#include "systems/portrait/portrait_predictor.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace daumier::portrait {

struct AvatarOptions {
  fitting::TextureOptions texture;
  bool keep_expression = false;

  template <class V>
  void Visit(V&& visit) {
    visit("texture", texture, Table{}, "How the head is painted from the picture.");
    visit("keep_expression", keep_expression, Flag{},
          "The head rests with the expression and the gaze of the picture; otherwise without them.");
  }
};

/// All that may be set of an avatar.
struct AvatarConfig {
  PortraitPredictOptions face;
  AvatarOptions avatar;

  template <class V>
  void Visit(V&& visit) {
    visit("face", face, Table{}, "How the face is found and aligned.");
    visit("avatar", avatar, Table{}, "How the head is made of it.");
  }
};

/// Milliseconds of the stages of an avatar.
struct AvatarTimes {
  double face = 0, targets = 0, head = 0, texture = 0;
};

/// A portrait as a head that can be animated [Pan et al. 2024, section 3].
struct Avatar {
  rig::RiggedHead head;                          ///< 52 targets by ARKit's names.
  std::shared_ptr<const render::Image> texture;  ///< The atlas.
  fitting::HeadTexture painted;                  ///< What the texels of skin were taken from.
  systems::FaceResult face;                      ///< What the predictor found; its pictures are the first stages.
  AvatarTimes times;
};

/// Makes avatars: picture -> face aligned to its landmarks -> neutral face -> targets -> rigged head -> texture. Const and
/// thread-safe.
class AvatarMaker {
 public:
  /// `model`: of the predictor's topology, with its expressions. @throws Error if it is another one, as
  /// rig::ExpressionTargets, rig::HeadRig and fitting::HeadPainter.
  AvatarMaker(std::unique_ptr<const PortraitPredictor> predictor, const faces::FaceModel& model,
              const AvatarOptions& options = {});

  /// The head of the face of highest confidence. @throws Error "no face found ..." as PortraitPredictor::Read, or if
  /// there is no parsing of the picture.
  Avatar Make(const render::Image& picture) const;

  /// What the source cannot make, a line each.
  const std::vector<std::string>& warnings() const { return targets_->warnings(); }

 private:
  std::unique_ptr<const PortraitPredictor> predictor_;
  AvatarOptions options_;
  Eigen::MatrixXf expression_shapes_;  ///< 3V x E
  // Prepared on two cores.
  std::optional<rig::ExpressionTargets> targets_;
  std::optional<rig::HeadRig> rig_;
  std::optional<fitting::HeadPainter> painter_;
};

}  // namespace daumier::portrait
