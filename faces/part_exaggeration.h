#pragma once
#include "core/random.h"
#include "faces/exaggeration.h"
#include "faces/face_parts.h"

namespace daumier::faces {

struct PartExaggerationOptions {
  double curvature = 1.0;
  double stretch = 1.2;
  double asymmetry = 0.25;
  int blend_rings = 8;

  template <class V>
  void Visit(V&& visit) {
    visit(
        "curvature", curvature, Range{0.0, 5.0},
        "Mean exponent of curvature of a part, in multiples of the level's gamma; drawn uniformly from 0 to twice it.");
    visit(
        "stretch", stretch, Range{0.0, 5.0},
        "Standard deviation of the logarithm of a part's width, height and depth, in multiples of the level's gamma.");
    visit("asymmetry", asymmetry, Range{0.0, 1.0}, "How far left and right differ, as a share of that deviation.");
    visit("blend_rings", blend_rings, Range{0, 40}, "Rings over which parts pass into each other.");
  }
};

/// How strongly each of P parts is exaggerated, and in which direction.
struct PartStrengths {
  Eigen::VectorXd gammas;          ///< P: exponent of curvature.
  geometry::Points log_stretches;  ///< P x 3: logarithm of the scale of width, height and depth.
};

/// Random strengths of a level. Width, height and depth of a part are stretched by exp(N(0, stretch * gamma)), cut at
/// two deviations; its exponent of curvature is uniform in [0, 2 * curvature * gamma], and 0 on eyes and mouth; left
/// and right parts share their strengths and differ by asymmetry. gamma 0 gives strengths of 0.
PartStrengths DrawPartStrengths(const FaceParts& parts, double gamma, const PartExaggerationOptions& options, Rng& rng);

/// Exaggerates each part of a neutral face (V x 3, cm) by its own strength: the surface is rebuilt by
/// GradientScaling::RebuildWithoutFlips from gradients whose coordinate k is scaled by
///   exp(sum_p weight_p (gamma_p e + log_stretch_pk)),  e the face's CurvatureExponent,
/// with the neck's border where it was; eyes and mouth are carried along.
/// Promises: strengths of 0 return the input; strengths that are equal on left and right keep a symmetric face
/// symmetric; a part that is stretched grows in that direction.
/// @throws Error if `face` has another number of vertices, or the strengths another number of parts.
geometry::Points ExaggerateParts(const FaceTemplate& face_template, const FaceParts& parts,
                                 const geometry::Points& face, const PartStrengths& strengths,
                                 const ExaggerationOptions& options);

}  // namespace daumier::faces
