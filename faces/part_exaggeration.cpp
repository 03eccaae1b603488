#include "faces/part_exaggeration.h"

#include "core/error.h"
#include "faces/gradient_scaling.h"

#include <algorithm>

namespace daumier::faces {
namespace {

constexpr double kMaxDeviations = 2.0;

double DrawNormal(Rng& rng) {
  return std::clamp(rng.Normal(), -kMaxDeviations, kMaxDeviations);
}

/// Curvature at the borders of lids and lips is not stable [Han et al. 2017, section 4.1].
bool AnswersToCurvature(const std::string& part) {
  return part != "mouth" && !part.starts_with("eye_");
}

}  // namespace

PartStrengths DrawPartStrengths(const FaceParts& parts, double gamma, const PartExaggerationOptions& options,
                                Rng& rng) {
  const auto num_parts = static_cast<Eigen::Index>(parts.names.size());
  PartStrengths strengths{Eigen::VectorXd::Zero(num_parts), geometry::Points::Zero(num_parts, 3)};
  for (Eigen::Index p = 0; p < num_parts; ++p) {
    const Eigen::Index other = parts.mirror[p];
    const bool is_shared = other < p;  // Drawn with the part of the other side already.
    const double curvature = rng.Uniform(0.0, 2.0 * options.curvature) * gamma;
    if (AnswersToCurvature(parts.names[p])) strengths.gammas[p] = is_shared ? strengths.gammas[other] : curvature;
    for (int k = 0; k < 3; ++k) {
      const double stretch = options.stretch * gamma * DrawNormal(rng);
      strengths.log_stretches(p, k) =
          is_shared ? strengths.log_stretches(other, k) + options.asymmetry * stretch : stretch;
    }
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
  const Eigen::VectorXd exponent = CurvatureExponent(face_template, face, options);
  geometry::Points log_scales = parts.weights * strengths.log_stretches;
  log_scales.colwise() += (parts.weights * strengths.gammas).cwiseProduct(exponent);
  return GradientScaling({face, face_template.triangles}, face_template.annotation.regions.at("neck_border"))
      .RebuildWithoutFlips(log_scales, options.blend_rings);
}

}  // namespace daumier::faces
