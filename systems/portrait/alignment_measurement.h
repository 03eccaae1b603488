#pragma once
#include "faces/morphable_model.h"
#include "geometry/mesh.h"
#include "render/image.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/portrait_alignment.h"
#include "systems/portrait/portrait_measures.h"
#include "systems/portrait/portrait_picture.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::portrait {

/// Ways to a face of a portrait: what tables 1 and 2 of [Pan et al. 2024] compare, and variants of the fine stage.
enum class AlignmentMethod {
  kMeanFace,         ///< In its best pose.
  kCoarse,           ///< As the network has it.
  kPose,             ///< The coarse face in its best pose.
  kAdjustExp,        ///< Coarse, with the expression that fits best.
  kAdjustIdExp,      ///< And the identity.
  kFineAsPrinted,    ///< Coarse pose, uniform Laplacian, landmarks at fixed vertices.
  kFine,             ///< As the options say.
  kFineCotangent,    ///< The same with the cotangent Laplacian.
  kAdjustIdExpPose,  ///< kAdjustIdExp from the best pose of the coarse face: what kFine has of it, too.
};
inline constexpr int kNumAlignmentMethods = 9;
std::string NameOf(AlignmentMethod method);

/// A portrait on which methods are measured, in its crop.
struct AlignmentSubject {
  std::string name;
  int person = 0;
  render::Image crop;
  std::vector<float> shown;         ///< 224 x 224: FaceMask of the crop; empty: no colours are measured.
  std::vector<float> coefficients;  ///< 239: the coarse face.
  std::vector<float> landmarks;     ///< 68 x 2, pixels of the crop: what faces are fitted to.
  std::vector<float> confidences;   ///< 68, or empty.
  std::vector<float> truth;         ///< 68 x 2: what they are measured on.
  bool on_silhouette = false;       ///< Whether the truth has the jaw where it is seen, not at vertices of a template.
  std::optional<geometry::Points> vertices = {};  ///< The true face, V x 3.
};

/// Errors of one method on one portrait.
struct AlignmentErrors {
  std::array<double, 68> used_px{};       ///< Fitted to all landmarks: distances to the truth, pixels.
  std::array<double, 68> alternate_px{};  ///< Of each landmark by a fit to every other one that leaves it out.
  std::array<double, 68> left_out_px{};   ///< By a fit that leaves its whole part out.
  double interocular_px = 0;              ///< Of the truth.
  double colours = 0;                     ///< PhotometricError, of 3; NaN where it is not measured.
  double error_mm = 0;                    ///< ShapeMeasure::SimilarityErrorMm; NaN where the truth is not known.
  int flips = 0, intersections = 0;  ///< Triangles flipped against the coarse face, and pairs that pierce each other.
  double ms = 0;                     ///< Of the fit to all landmarks.
};

/// Measures methods on portraits.
class AlignmentMeasurement {
 public:
  /// Keeps a reference to the model. @throws Error as PortraitAligner.
  explicit AlignmentMeasurement(const faces::MorphableModel& model, const PortraitAlignmentOptions& options = {});

  /// The face that a method makes of a portrait with those landmarks that have a weight (68). Coarse faces and mean faces
  /// have the model's own vertices. @throws Error as FitPortrait, AdjustPortrait and PortraitAligner::Align.
  AlignedPortrait Fit(AlignmentMethod method, const AlignmentSubject& subject, std::span<const float> weights) const;
  /// @throws Error as Fit.
  AlignmentErrors Measure(AlignmentMethod method, const AlignmentSubject& subject) const;

  const FacePainter& painter() const { return painter_; }

 private:
  std::array<double, 68> Distances(const AlignedPortrait& face, const AlignmentSubject& subject) const;

  const faces::MorphableModel& model_;
  const fitting::LandmarkModel landmark_model_;
  const PortraitAligner fine_, cotangent_, printed_;
  const FacePainter painter_;
  const ShapeMeasure measure_;
};

/// A method on several portraits.
struct AlignmentRow {
  AlignmentMethod method;
  std::vector<AlignmentErrors> errors;  ///< One a portrait.
};

}  // namespace daumier::portrait
