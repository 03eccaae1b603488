#include "faces/part_exaggeration.h"

#include "core/error.h"
#include "faces/gradient_scaling.h"
#include "geometry/alignment.h"
#include "geometry/flips.h"

#include <algorithm>

namespace daumier::faces {
namespace {

constexpr double kMaxDeviations = 2.0;

double DrawNormal(Rng& rng) {
  return std::clamp(rng.Normal(), -kMaxDeviations, kMaxDeviations);
}

/// Curvature at the borders of lids and lips is not stable [Han et al. 2017, section 4.1].
bool DependsOnCurvature(const std::string& part) {
  return part != "mouth" && !part.starts_with("eye_");
}

/// `stretched` moved by the bumps. Where triangles of `face` would flip, the bumps around them are halved, again and
/// again.
geometry::Points WithBumps(const geometry::Points& face, const geometry::Triangles& triangles,
                           const geometry::Points& stretched, std::vector<GaussianBump> bumps) {
  constexpr int kMaxRounds = 8;
  constexpr double kReach = 2.0;  // Radii within which a bump has a part in a flip.
  geometry::Points result;
  for (int round = 0; round <= kMaxRounds; ++round) {
    result = stretched;
    for (const GaussianBump& bump : bumps) {
      const Eigen::ArrayXd squared = (face.rowwise() - face.row(bump.vertex)).rowwise().squaredNorm();
      result += (-0.5 / (bump.radius * bump.radius) * squared).exp().matrix() * bump.offset.transpose();
    }
    const std::vector<int> flipped = geometry::FlippedTriangles(face, result, triangles);
    if (flipped.empty()) break;
    for (GaussianBump& bump : bumps) {
      const auto is_near = [&](int f) {
        return (face.row(triangles(f, 0)) - face.row(bump.vertex)).norm() < kReach * bump.radius;
      };
      if (std::any_of(flipped.begin(), flipped.end(), is_near)) bump.offset *= 0.5;
    }
  }
  return result;
}

}  // namespace

PartStrengths DrawPartStrengths(const FaceTemplate& face_template, const FaceParts& parts, double gamma,
                                const PartExaggerationOptions& options, Rng& rng) {
  const auto num_parts = static_cast<Eigen::Index>(parts.names.size());
  PartStrengths strengths{Eigen::VectorXd::Zero(num_parts), geometry::Points::Zero(num_parts, 3), {}};
  for (Eigen::Index p = 0; p < num_parts; ++p) {
    const Eigen::Index other = parts.mirror[p];
    const bool is_shared = other < p;  // Drawn with the part of the other side already.
    const double curvature = rng.Uniform(0.0, 2.0 * options.curvature) * gamma;
    if (DependsOnCurvature(parts.names[p])) strengths.gammas[p] = is_shared ? strengths.gammas[other] : curvature;
    for (int k = 0; k < 3; ++k) {
      const double stretch = options.stretch * gamma * DrawNormal(rng);
      strengths.log_stretches(p, k) =
          is_shared ? strengths.log_stretches(other, k) + options.asymmetry * stretch : stretch;
    }
  }
  for (int i = 0; i < options.num_lumps; ++i) {
    GaussianBump bump{.vertex = static_cast<int>(rng.Below(face_template.num_vertices())),
                      .radius = rng.Uniform(options.lump_radius / 3, options.lump_radius),
                      .offset = {}};
    for (double& offset : bump.offset) offset = options.lump_offset * gamma * bump.radius * DrawNormal(rng);
    strengths.bumps.push_back(bump);
    if (i % 2 == 1 || face_template.annotation.mirror.empty()) continue;
    bump.vertex = face_template.annotation.mirror[bump.vertex];
    bump.offset.x() *= -1;
    strengths.bumps.push_back(bump);
  }
  return strengths;
}

geometry::Points ExaggerateParts(const FaceTemplate& face_template, const FaceParts& parts,
                                 const geometry::Points& face, const PartStrengths& strengths,
                                 const ExaggerationOptions& options) {
  const auto num_parts = static_cast<Eigen::Index>(parts.names.size());
  DAUMIER_CHECK(strengths.gammas.size() == num_parts && strengths.log_stretches.rows() == num_parts,
                "strengths of {} and {} parts, the face has {}", strengths.gammas.size(),
                strengths.log_stretches.rows(), num_parts);
  constexpr const char* kPurpose = "an exaggeration of parts";
  const Eigen::VectorXd exponent = CurvatureExponent(face_template, face, options);
  geometry::Points log_scales = parts.weights * strengths.log_stretches;
  log_scales.colwise() += (parts.weights * strengths.gammas).cwiseProduct(exponent);
  const geometry::Points stretched =
      GradientScaling({face, face_template.triangles}, RegionFor(face_template.annotation, "neck_border", kPurpose))
          .RebuildWithoutFlips(log_scales, options.blend_rings);
  const geometry::Points result = WithBumps(face, face_template.triangles, stretched, strengths.bumps);
  Eigen::VectorXd in_face = Eigen::VectorXd::Zero(face.rows());
  for (const int v : RegionFor(face_template.annotation, "face", kPurpose)) in_face[v] = 1;
  return geometry::AlignSimilarity(result, face, in_face).Apply(result);
}

}  // namespace daumier::faces
