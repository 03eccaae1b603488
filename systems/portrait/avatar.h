#pragma once

#include "faces/face_model.h"
#include "fitting/texture_head.h"
#include "render/image.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"
#include "systems/portrait/portrait_predictor.h"
#include "systems/portrait/style_network.h"
#include "systems/portrait/toon_portrait.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace daumier::portrait {

struct AvatarOptions {
  std::string style = "none";
  ToonPortraitOptions toon;
  StyleNetworkOptions network;
  fitting::TextureOptions texture;
  bool keep_expression = false;

  template <class V>
  void Visit(V&& visit) {
    visit("style", style, Text{},
          "What the picture is made into before its face is read: none; toon, a cartoon of flat colours with larger "
          "eyes; or the ONNX file of an image-to-image network.");
    visit("toon", toon, Table{}, "The cartoon.");
    visit("network", network, Table{}, "How the network is used.");
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
    visit("face", face, Table{}, "How the face of a portrait is found and aligned.");
    visit("avatar", avatar, Table{}, "How the head is made of it.");
  }
};

/// Milliseconds of the stages of an avatar.
struct AvatarTimes {
  double style = 0, face = 0, targets = 0, head = 0, texture = 0;
};

/// A change of a neutral face, V x 3, cm.
using FaceEdit = std::function<geometry::Points(const geometry::Points&)>;

/// A portrait as a head that can be animated [Pan et al. 2024, section 3].
struct Avatar {
  rig::RiggedHead head;                          ///< 52 targets by ARKit's names.
  std::shared_ptr<const render::Image> texture;  ///< The atlas.
  fitting::HeadTexture painted;                  ///< What the texels of skin were taken from.
  systems::FaceResult face;                      ///< What the predictor found; its pictures are the first stages.
  geometry::Points neutral;                      ///< V x 3, cm: the face that was rigged.
  FoundPortrait found;                           ///< Landmarks and parsing of `picture`.
  render::Image picture;                         ///< In its style, RGB: what the texture was painted from.
  AvatarTimes times;
};

/// Makes avatars: picture -> its style -> face aligned to its landmarks -> neutral face -> edit -> targets -> rigged head
/// -> texture. Const and thread-safe.
class AvatarMaker {
 public:
  /// `open` makes the predictor, while the rest is prepared on another core. `model`: of its topology, with expressions.
  /// @throws Error as `open`; UsageError if the style is none of those that
  /// the options name; Error if the model is of another topology, as StyleNetwork,
  /// rig::ExpressionTargets, rig::HeadRig and fitting::HeadPainter.
  AvatarMaker(const std::function<std::unique_ptr<const PortraitPredictor>()>& open, const faces::FaceModel& model,
              const AvatarOptions& options = {});

  /// The head of the face of highest confidence. `edit`: changes the neutral face (an exaggeration); the texture is that of
  /// the face as the picture shows it. @throws Error "no face found ..." as PortraitPredictor::Find, or if there is no
  /// parsing of the picture; as `edit`.
  Avatar Make(const render::Image& picture, const FaceEdit& edit = {}) const;

  /// What the source cannot make, a line each.
  const std::vector<std::string>& warnings() const { return targets_->warnings(); }

  const PortraitPredictor& predictor() const { return *predictor_; }

 private:
  /// What is found in a picture, which takes its style.
  FoundPortrait FindStyled(render::Image& picture) const;
  geometry::Points NeutralOf(const systems::FaceResult& face, const FaceEdit& edit) const;

  std::unique_ptr<const PortraitPredictor> predictor_;
  AvatarOptions options_;
  std::optional<StyleNetwork> style_;
  Eigen::MatrixXf expression_shapes_;  ///< 3V x E
  std::optional<rig::ExpressionTargets> targets_;
  std::optional<rig::HeadRig> rig_;
  std::optional<fitting::HeadPainter> painter_;
};

}  // namespace daumier::portrait
