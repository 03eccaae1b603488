#include "systems/portrait/alignment_measurement.h"

#include "core/error.h"
#include "core/stopwatch.h"
#include "geometry/flips.h"
#include "geometry/self_intersections.h"

#include <cmath>
#include <limits>
#include <utility>

namespace daumier::portrait {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

PortraitAlignmentOptions WithLaplacian(PortraitAlignmentOptions options, const std::string& laplacian) {
  options.fine.laplacian = laplacian;
  return options;
}

/// Lambda 1 for all landmarks, at the template's vertices.
PortraitAlignmentOptions AsPrinted() {
  PortraitAlignmentOptions options{.adjust = "none"};
  options.fine = {.contour = "fixed", .hidden = 1, .keep_order = false};
  return options;
}

}  // namespace

std::string NameOf(AlignmentMethod method) {
  static const std::array<std::string, kNumAlignmentMethods> names = {"mean face, pose fitted",
                                                                      "coarse",
                                                                      "coarse, pose fitted",
                                                                      "Adjust Exp",
                                                                      "Adjust Id+Exp",
                                                                      "fine, as printed",
                                                                      "fine, uniform",
                                                                      "fine, cotangent",
                                                                      "Adjust Id+Exp, pose fitted"};
  return names[size_t(method)];
}

AlignmentMeasurement::AlignmentMeasurement(const faces::MorphableModel& model, const PortraitAlignmentOptions& options)
    : model_(model),
      landmark_model_(model),
      fine_(model, WithLaplacian(options, "uniform")),
      cotangent_(model, WithLaplacian(options, "cotangent")),
      printed_(model, AsPrinted()),
      painter_(model),
      measure_(model.face_template) {}

AlignedPortrait AlignmentMeasurement::Fit(AlignmentMethod method, const AlignmentSubject& subject,
                                          std::span<const float> weights) const {
  switch (method) {
    case AlignmentMethod::kFineAsPrinted:
      return printed_.Align(subject.coefficients, subject.landmarks, weights);
    case AlignmentMethod::kFine:
      return fine_.Align(subject.coefficients, subject.landmarks, weights);
    case AlignmentMethod::kFineCotangent:
      return cotangent_.Align(subject.coefficients, subject.landmarks, weights);
    default:
      break;
  }
  const fitting::PicturePoints landmarks = LandmarkPoints(subject.landmarks);
  const Eigen::VectorXd of_landmarks = Eigen::Map<const Eigen::VectorXf>(weights.data(), 68).cast<double>();
  Eigen::VectorXf x = Eigen::Map<const Eigen::VectorXf>(subject.coefficients.data(), faces::kNumCoefficients);
  const auto adjust = [&](fitting::PortraitAdjustment adjustment) {
    x = fitting::AdjustPortrait(landmark_model_, x, landmarks, of_landmarks, adjustment).coefficients;
  };
  if (method == AlignmentMethod::kMeanFace) {
    const Eigen::VectorXf fitted =
        fitting::FitPortrait(landmark_model_, landmarks, of_landmarks, {.freedom = fitting::PortraitFreedom::kPose})
            .coefficients;
    x.head(faces::kAlbedoSlot.first).setZero();
    x.tail<6>() = fitted.tail<6>();
  }
  if (method == AlignmentMethod::kPose || method == AlignmentMethod::kAdjustIdExpPose)
    adjust(fitting::PortraitAdjustment::kPose);
  if (method == AlignmentMethod::kAdjustExp) adjust(fitting::PortraitAdjustment::kExpression);
  if (method == AlignmentMethod::kAdjustIdExp || method == AlignmentMethod::kAdjustIdExpPose)
    adjust(fitting::PortraitAdjustment::kIdentityAndExpression);
  AlignedPortrait face;
  face.coefficients.assign(x.begin(), x.end());
  face.vertices = faces::Reconstruct(model_, face.coefficients).vertices;
  return face;
}

std::array<double, 68> AlignmentMeasurement::Distances(const AlignedPortrait& face,
                                                       const AlignmentSubject& subject) const {
  const fitting::PortraitPose pose = PoseOfCoefficients(face.coefficients);
  const std::array<int, 68> anchors =
      subject.on_silhouette ? fine_.fine().Anchors(face.vertices, pose) : model_.face_template.annotation.landmarks;
  const std::vector<float> pixels = CropPixels(face.vertices, anchors, pose);
  std::array<double, 68> distances{};
  for (size_t k = 0; k < 68; ++k)
    distances[k] = std::hypot(double(pixels[2 * k]) - double(subject.truth[2 * k]),
                              double(pixels[2 * k + 1]) - double(subject.truth[2 * k + 1]));
  return distances;
}

AlignmentErrors AlignmentMeasurement::Measure(AlignmentMethod method, const AlignmentSubject& subject) const {
  DAUMIER_CHECK(subject.truth.size() == 136, "{}: {} numbers of true landmarks, expected 136", subject.name,
                subject.truth.size());
  AlignmentErrors errors;
  errors.interocular_px = InterocularDistance(subject.truth);
  std::vector<float> weights = subject.confidences;
  if (weights.empty()) weights.assign(68, 1.0F);
  const Stopwatch stopwatch;
  const AlignedPortrait face = Fit(method, subject, weights);
  errors.ms = 1000 * stopwatch.seconds();
  errors.used_px = Distances(face, subject);
  const auto leave_out = [&](auto is_out, std::array<double, 68>& into) {
    std::vector<float> kept = weights;
    for (int k = 0; k < 68; ++k) {
      if (is_out(k)) kept[size_t(k)] = 0;
    }
    const std::array<double, 68> distances = Distances(Fit(method, subject, kept), subject);
    for (int k = 0; k < 68; ++k) {
      if (is_out(k)) into[size_t(k)] = distances[size_t(k)];
    }
  };
  if (method == AlignmentMethod::kCoarse) {
    errors.alternate_px = errors.left_out_px = errors.used_px;
  } else {
    for (const int odd : {0, 1}) leave_out([&](int k) { return k % 2 == odd; }, errors.alternate_px);
    for (const LandmarkPart& part : kLandmarkParts)
      leave_out([&](int k) { return k >= part.begin && k < part.end; }, errors.left_out_px);
  }
  const faces::ColouredFace coarse = faces::Reconstruct(model_, subject.coefficients);
  errors.colours = kUnknown;
  if (!subject.shown.empty())
    errors.colours = PhotometricError(painter_.Paint({face.vertices, coarse.albedo}, face.coefficients), subject.crop,
                                      subject.shown);
  errors.error_mm = subject.vertices ? measure_.SimilarityErrorMm(face.vertices, *subject.vertices) : kUnknown;
  const geometry::Triangles& triangles = model_.face_template.triangles;
  errors.flips = geometry::CountFlippedTriangles(coarse.vertices, face.vertices, triangles);
  errors.intersections = int(geometry::SelfIntersections({face.vertices, triangles}).size());
  return errors;
}

}  // namespace daumier::portrait
