#pragma once
#include "core/options.h"
#include "faces/morphable_model.h"
#include "fitting/fine_alignment.h"
#include "fitting/portrait_fit.h"

#include <span>
#include <vector>

namespace daumier::portrait {

struct PortraitAlignmentOptions {
  std::string adjust = "all";
  double deviation_px = 2;
  double trust = 0.5;
  fitting::FineAlignmentOptions fine;

  template <class V>
  void Visit(V&& visit) {
    visit(
        "adjust", adjust, Choices{{"none", "pose", "all"}},
        "What of the network's coefficients is fitted to the landmarks first, so that the deformation need not make up "
        "for it. none: nothing, as printed; pose; all: pose, identity and expression, with a prior about the "
        "network's.");
    visit("deviation_px", deviation_px, Range{1e-3, 1e3}, "With all: deviation of landmarks from the 3DMM, pixels.");
    visit("trust", trust, Range{1e-3, 100},
          "With all: deviation of identity and expression from the network's, as a share of the model's own.");
    visit("fine", fine, Table{}, "The deformation.");
  }
};

/// A portrait's face before and after its alignment, in the frame of the 3DMM.
struct AlignedPortrait {
  std::vector<float> coefficients;  ///< 239, of the coarse face in the pose of the fine one.
  geometry::Points vertices;        ///< V x 3, cm: the fine face.
  std::vector<int> anchors;         ///< 68: the vertices used for the landmarks.
  std::vector<float> coarse,
      landmarks;  ///< 68 x 2, pixels of the crop: of the coarse face in its own pose, and of the fine one.
};

/// The fine stage of a portrait by the landmarks of its crop: coefficients, then Laplacian deformation
/// (fitting::FineAlignment).
/// Const and thread-safe.
class PortraitAligner {
 public:
  /// Keeps a reference to the model. @throws Error as fitting::FineAlignment.
  explicit PortraitAligner(const faces::MorphableModel& model, const PortraitAlignmentOptions& options = {});

  /// coefficients: 239; landmarks: 68 x 2, pixels of the crop; confidences: 68, or none for ones. A landmark of
  /// confidence 0 is ignored. @throws Error if a size differs, or as AdjustPortrait and FineAlignment::Align.
  AlignedPortrait Align(std::span<const float> coefficients, std::span<const float> landmarks,
                        std::span<const float> confidences = {}) const;

  const PortraitAlignmentOptions& options() const { return options_; }
  const fitting::FineAlignment& fine() const { return fine_; }

 private:
  const faces::MorphableModel& model_;
  const PortraitAlignmentOptions options_;
  const fitting::LandmarkModel landmark_model_;
  const fitting::FineAlignment fine_;
};

/// 68 x 2 numbers (x0 y0 ...) as points. @throws Error if there are not 136.
fitting::PicturePoints LandmarkPoints(std::span<const float> landmarks);
/// Where vertices of a posed face are in the crop, x0 y0 ...
std::vector<float> CropPixels(const geometry::Points& vertices, std::span<const int> chosen,
                              const fitting::PortraitPose& pose);

}  // namespace daumier::portrait
