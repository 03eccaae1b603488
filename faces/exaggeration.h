#pragma once
#include "core/options.h"
#include "faces/face_model.h"

#include <vector>

namespace daumier::faces {

struct ExaggerationOptions {
  std::vector<double> gammas = {0.0, 0.1, 0.2, 0.3};
  int smoothing_rings = 4;
  double clamp_ratio = 20.0;
  double ear_damping = 0.3;

  template <class V>
  void Visit(V&& visit) {
    visit("gammas", gammas, Range{0.0, 0.8}, "Exponent of normalised |Gaussian curvature| that scales gradients, a level each.");
    visit("smoothing_rings", smoothing_rings, Range{0, 20}, "Rings over which |K| is averaged before use.");
    visit("clamp_ratio", clamp_ratio, Range{1.0, 1e6}, "|K| is clamped to [Kbar / ratio, ratio * Kbar].");
    visit("ear_damping", ear_damping, Range{0.0, 1.0}, "Multiplier of gamma on the ears.");
  }
};

/// Exaggerates a neutral face [Sela et al. 2015; Han et al. 2017, section 4.1]: every triangle's coordinate gradients are scaled
/// by w = (|K| / Kbar)^gamma, Kbar the area-weighted geometric mean of |K|, and the surface is rebuilt by a Poisson solve with
/// the regions eyes, mouth and neck_border fixed. Returns one face a gamma, in the order of options.gammas.
/// Promises: gamma 0 returns the input; a larger gamma moves more; see tests for the bounds.
std::vector<geometry::Points> Exaggerate(const FaceTemplate& face_template, const geometry::Points& face,
                                         const ExaggerationOptions& options);

}  // namespace daumier::faces
