#pragma once
#include "datasets/build/portrait_lines.h"
#include "datasets/build/portrait_pose.h"
#include "datasets/build/portrait_shard.h"
#include "faces/appearance/portrait_head.h"
#include "faces/openings.h"
#include "render/exr.h"
#include "render/styles/photo_effects.h"
#include "render/styles/style_choice.h"

#include <string>
#include <vector>

namespace daumier::datasets {

struct PictureOptions {
  int supersampling = 2;
  std::string format = "jpeg";
  int quality = 95;
  double bald = 0.5;
  PoseOptions pose;
  faces::LooksOptions looks;
  render::StyleOptions styles;
  render::PhotoEffectOptions effects;

  template <class V>
  void Visit(V&& visit) {
    visit("supersampling", supersampling, Range{1, 3}, "Samples a pixel and axis.");
    visit("format", format, Choices{{"jpeg", "png"}}, "How pictures are stored; masks are always PNG.");
    visit("quality", quality, Range{50, 100}, "JPEG quality of stored pictures.");
    visit("bald", bald, Range{0, 1}, "Share of untextured pictures (styles.clay) whose heads have no hair.");
    visit("pose", pose, Table{}, "How heads are turned and framed.");
    visit("looks", looks, Table{}, "Hair, eyes, skin, hats, glasses and beards.");
    visit("styles", styles, Table{}, "How pictures are drawn.");
    visit("effects", effects, Table{}, "Blur, noise, compression and the like.");
  }
};

/// Makes portraits of the faces of one topology. Const and thread-safe.
class PortraitMaker {
 public:
  /// Keeps references to the template and the options.
  /// @throws Error as faces::HeadDresser and faces::FindOpenings.
  PortraitMaker(const faces::FaceTemplate& face_template, const PictureOptions& options);

  /// A portrait of a face (V x 3, cm, with its expression), all random choices from `rng`, and its truth but for what
  /// is known about the face: face, person and expression. The vertices are there.
  PortraitRecord Make(const geometry::Points& face, Rng& rng) const { return MakeWithBuffers(face, rng, nullptr); }

  /// The same, and the buffers of a portrait at the centres of its pixels: channels Z (depth from the viewer along its
  /// axis, cm, infinite where there is nothing), N.X, N.Y, N.Z (unit normal), P.X, P.Y, P.Z (posed point q of
  /// PortraitDatabase, cm), 0 where there is nothing; x to the right, y up, z to the viewer.
  PortraitRecord MakeWithBuffers(const geometry::Points& face, Rng& rng, render::FloatImage* buffers) const;

  /// What the vertices of portraits are relative to: the mean of the template's neutral 68 landmarks, cm.
  const geometry::Vector3& centre() const { return centre_; }
  const PortraitOptics& optics() const { return optics_; }
  static std::vector<std::string> StyleNames();

 private:
  const faces::FaceTemplate& face_template_;
  const PictureOptions& options_;
  PortraitOptics optics_;
  faces::HeadDresser dresser_;
  faces::FaceOpenings openings_;
  PortraitLines lines_;
  geometry::Vector3 centre_;
  double mm_per_cm_;
};

}  // namespace daumier::datasets
