#include "systems/portrait/portrait_alignment.h"

#include "core/error.h"
#include "systems/portrait/portrait_picture.h"

#include <algorithm>

namespace daumier::portrait {

fitting::PicturePoints LandmarkPoints(std::span<const float> landmarks) {
  DAUMIER_CHECK(landmarks.size() == 136, "{} numbers of landmarks, expected 136", landmarks.size());
  return Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>>(landmarks.data(), 68, 2)
      .cast<double>();
}

std::vector<float> CropPixels(const geometry::Points& vertices, std::span<const int> chosen,
                              const fitting::PortraitPose& pose) {
  geometry::Points points(Eigen::Index(chosen.size()), 3);
  for (size_t i = 0; i < chosen.size(); ++i) points.row(Eigen::Index(i)) = vertices.row(chosen[i]);
  const fitting::PicturePoints pixels = fitting::Projected(fitting::Posed(points, pose));
  return {pixels.data(), pixels.data() + pixels.size()};
}

PortraitAligner::PortraitAligner(const faces::MorphableModel& model, const PortraitAlignmentOptions& options)
    : model_(model), options_(options), landmark_model_(model), fine_(model.face_template, options.fine) {}

AlignedPortrait PortraitAligner::Align(std::span<const float> coefficients, std::span<const float> landmarks,
                                       std::span<const float> confidences) const {
  const fitting::PicturePoints points = LandmarkPoints(landmarks);
  DAUMIER_CHECK(confidences.empty() || confidences.size() == 68, "{} confidences of landmarks, expected 68",
                confidences.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(68);
  if (!confidences.empty()) weights = Eigen::Map<const Eigen::VectorXf>(confidences.data(), 68).cast<double>();
  fitting::PortraitPose pose = PoseOfCoefficients(coefficients);
  const geometry::Points coarse = faces::Reconstruct(model_, coefficients).vertices;
  const auto as_list = [](const std::array<int, 68>& anchors) {
    return std::vector<int>(anchors.begin(), anchors.end());
  };
  AlignedPortrait aligned;
  aligned.coarse = CropPixels(coarse, as_list(fine_.Anchors(coarse, pose)), pose);
  aligned.coefficients.assign(coefficients.begin(), coefficients.end());
  geometry::Points start = coarse;
  if (options_.adjust != "none") {
    const bool all = options_.adjust == "all";
    const fitting::PortraitFitOptions fit{.deviation_px = all ? options_.deviation_px : 1,
                                          .identity_deviation = options_.trust,
                                          .expression_deviation = 0.5 * options_.trust,
                                          .about_start = true};
    const Eigen::VectorXf found =
        fitting::AdjustPortrait(
            landmark_model_, Eigen::Map<const Eigen::VectorXf>(coefficients.data(), faces::kNumCoefficients), points,
            weights, all ? fitting::PortraitAdjustment::kAll : fitting::PortraitAdjustment::kPose, fit)
            .coefficients;
    aligned.coefficients.assign(found.begin(), found.end());
    pose = PoseOfCoefficients(aligned.coefficients);
    if (all) start = faces::Reconstruct(model_, aligned.coefficients).vertices;
  }
  const fitting::AlignedFace face = fine_.Align(start, pose, points, weights);
  aligned.vertices = face.vertices;
  aligned.anchors = as_list(face.anchors);
  aligned.landmarks = CropPixels(face.vertices, aligned.anchors, pose);
  return aligned;
}

}  // namespace daumier::portrait
