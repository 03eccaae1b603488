#pragma once
#include "core/options.h"
#include "faces/face_model.h"
#include "faces/gradient_scaling.h"

#include <vector>

namespace daumier::faces {

struct ExaggerationOptions {
  std::vector<double> gammas = {0.0, 0.08, 0.16, 0.24};
  int smoothing_rings = 4;
  double clamp_ratio = 20.0;
  double ear_damping = 0.3;
  int blend_rings = 4;

  template <class V>
  void Visit(V&& visit) {
    visit(
        "gammas", gammas, Range{0.0, 0.8},
        "One exponent of normalised |Gaussian curvature| for each level; it scales the gradients of the coordinates.");
    visit("smoothing_rings", smoothing_rings, Range{0, 20}, "Rings over which |K| is averaged before use.");
    visit("clamp_ratio", clamp_ratio, Range{1.0, 1e6}, "|K| is clamped to [Kbar / ratio, ratio * Kbar].");
    visit("ear_damping", ear_damping, Range{0.0, 1.0}, "Multiplier of gamma on the ears.");
    visit("blend_rings", blend_rings, Range{0, 20},
          "Rings over which the exaggeration fades in around fixed regions and around the damped ears.");
  }
};

/// V: sensitivity to curvature of the gradients around each vertex of a neutral face (V x 3, cm),
///   e = d log(|K| / Kbar),
/// K the Gaussian curvature (angle defect over area), |K| averaged over rings and clamped to [Kbar / ratio, ratio
/// Kbar], Kbar the area-weighted geometric mean of |K| over what is free to move, d the damping (ear_damping on the
/// ears, fading from 0 to 1 around the regions eyes, mouth and neck_border, where curvature is not stable); on the nose
/// log(|K| / Kbar) is its mean over the nose, so that the nose is scaled as one and its nostrils do not pass through
/// its wings. @throws Error if `face` has another number of vertices, if eyes, mouth and neck are the whole surface, or
/// naming the region that the annotation lacks.
Eigen::VectorXd CurvatureExponent(const FaceTemplate& face_template, const geometry::Points& face,
                                  const ExaggerationOptions& options);

/// A neutral face that is ready for any gamma: its curvature is measured and its gradients' system factorised once.
class FaceExaggerator {
 public:
  /// options.gammas are not read. @throws Error as Exaggerate.
  FaceExaggerator(const FaceTemplate& face_template, const geometry::Points& face, const ExaggerationOptions& options);

  /// V x 3, cm: the face as Exaggerate has it for this gamma. Thread-safe.
  geometry::Points At(double gamma) const;

 private:
  Eigen::VectorXd exponent_;
  GradientScaling scaling_;
  int blend_rings_;
};

/// Exaggerates a neutral face [Sela et al. 2015; Han et al. 2017, section 4.1]: the surface is rebuilt by
/// GradientScaling::RebuildWithoutFlips from gradients scaled by exp(gamma e), e its CurvatureExponent, with the
/// regions eyes, mouth and neck_border where they were. Returns one face a gamma, in the order of options.gammas;
/// `face` is V x 3 in cm. Promises: gamma 0 returns the input; a larger gamma moves more; at the default gammas a
/// face's height from chin to hairline changes by less than 10 %, no vertex moves more than 60 mm, and no triangle of
/// the face flips.
/// @throws Error if `face` has another number of vertices, or a triangle without area.
std::vector<geometry::Points> Exaggerate(const FaceTemplate& face_template, const geometry::Points& face,
                                         const ExaggerationOptions& options);

}  // namespace daumier::faces
