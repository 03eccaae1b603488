#pragma once
#include "core/random.h"
#include "faces/exaggeration.h"
#include "faces/face_parts.h"

namespace daumier::faces {

struct PartExaggerationOptions {
  double curvature = 0.5;
  double stretch = 0.5;
  double asymmetry = 0.4;
  int num_lumps = 120;
  double lump_radius = 2.2;
  double lump_offset = 0.9;
  int blend_rings = 8;

  template <class V>
  void Visit(V&& visit) {
    visit("curvature", curvature, Range{0.0, 5.0},
          "Mean exponent of curvature of a part, in multiples of the level's gamma; drawn uniformly from 0 to twice "
          "this.");
    visit(
        "stretch", stretch, Range{0.0, 5.0},
        "Standard deviation of the logarithm of a part's width, height and depth, in multiples of the level's gamma.");
    visit(
        "asymmetry", asymmetry, Range{0.0, 1.0},
        "Standard deviation of the difference between the stretches of left and right parts, as a share of `stretch`.");
    visit(
        "num_lumps", num_lumps, Range{0, 200},
        "Number of bumps and hollows at random places of the head; every second one is also placed on the other side.");
    visit("lump_radius", lump_radius, Range{0.3, 20.0}, "Largest radius of a bump, cm; the smallest is a third of it.");
    visit("lump_offset", lump_offset, Range{0.0, 5.0},
          "Standard deviation of the shift of a bump along each axis, in multiples of its radius and of the level's "
          "gamma.");
    visit("blend_rings", blend_rings, Range{0, 40}, "Rings over which neighbouring parts blend.");
  }
};

/// A bump, hollow or shift that no part names: what lies at distance d of a vertex is moved by
/// exp(-d^2 / 2 radius^2) offset. A warp of space: layers that lie over each other, as lids and nostrils, move
/// together.
struct GaussianBump {
  int vertex;
  double radius;             ///< cm
  geometry::Vector3 offset;  ///< cm
};

/// How strongly each of P parts is exaggerated, and in which direction.
struct PartStrengths {
  Eigen::VectorXd gammas;          ///< P: exponent of curvature.
  geometry::Points log_stretches;  ///< P x 3: logarithm of the scale of width, height and depth.
  std::vector<GaussianBump> bumps;
};

/// Random strengths of a level. Width, height and depth of a part are stretched by exp(N(0, stretch * gamma)), cut at
/// two deviations; its exponent of curvature is uniform in [0, 2 * curvature * gamma], and 0 on eyes and mouth; left
/// and right parts share their strengths and differ by asymmetry. Bumps lie at random vertices, half of
/// them also mirrored, with a radius uniform in a third of lump_radius to all of it, and offsets of N(0, lump_offset *
/// gamma * radius) cut at two deviations. gamma 0 gives strengths of 0.
PartStrengths DrawPartStrengths(const FaceTemplate& face_template, const FaceParts& parts, double gamma,
                                const PartExaggerationOptions& options, Rng& rng);

/// Exaggerates each part of a neutral face (V x 3, cm) by its own strength: the surface is rebuilt by
/// GradientScaling::RebuildWithoutFlips from gradients whose coordinate k is scaled by
///   exp(sum_p weight_p (gamma_p e + log_stretch_pk)),  e the face's CurvatureExponent,
/// then moved by the bumps (distances measured on the input; bumps around a triangle that would flip are halved, at
/// most eight times) and similarity-aligned to the face it came from over the region `face`. Eyes and mouth are carried
/// along.
/// Promises: strengths of 0 return the input; strengths that are equal on left and right keep a symmetric face
/// symmetric; a part that is stretched grows in that direction against the others.
/// @throws Error if `face` has another number of vertices, or the strengths another number of parts.
geometry::Points ExaggerateParts(const FaceTemplate& face_template, const FaceParts& parts,
                                 const geometry::Points& face, const PartStrengths& strengths,
                                 const ExaggerationOptions& options);

}  // namespace daumier::faces
