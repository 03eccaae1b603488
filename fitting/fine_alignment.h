#pragma once
#include "core/options.h"
#include "faces/face_model.h"
#include "fitting/contour_paths.h"
#include "fitting/opening_moves.h"
#include "fitting/portrait_view.h"
#include "geometry/laplacian_anchors.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace daumier::fitting {

struct FineAlignmentOptions {
  std::string laplacian = "uniform";
  std::string contour = "slide";
  double eyes = 1, brows = 1, nose = 1, mouth = 1, jaw = 1;
  double hidden = 0.05;
  int slides = 3;
  bool keep_order = true;

  template <class V>
  void Visit(V&& visit) {
    visit("laplacian", laplacian, Choices{{"uniform", "cotangent"}},
          "Which Laplacian coordinates are kept. uniform: a vertex less the mean of its neighbours, as printed, "
          "factorised "
          "once for all faces; cotangent: less their cotangent-weighted mean, factorised for each face.");
    visit("contour", contour, Choices{{"slide", "fixed"}},
          "Where the jaw's landmarks are. slide: on the silhouette of the posed face, anywhere on the line through the "
          "given ones; fixed: at the template's own vertices.");
    visit("eyes", eyes, Range{0, 1e6}, "Weight (lambda) of the landmarks of the eyes.");
    visit("brows", brows, Range{0, 1e6}, "Of the brows.");
    visit("nose", nose, Range{0, 1e6}, "Of the nose.");
    visit("mouth", mouth, Range{0, 1e6}, "Of the mouth.");
    visit("jaw", jaw, Range{0, 1e6}, "Of the jaw.");
    visit("hidden", hidden, Range{0, 1},
          "Part of its weight that a landmark has which is turned away from the viewer.");
    visit("slides", slides, Range{0, 20},
          "How often the jaw's landmarks move on to the nearest place of the given line.");
    visit("keep_order", keep_order, Flag{}, "Whether upper lids and lips stay above lower ones.");
  }
};

/// A face aligned to landmarks of its picture.
struct AlignedFace {
  geometry::Points vertices;             ///< V x 3, cm, in the frame of the coarse face.
  std::array<int, 68> anchors{};         ///< The vertex used for each landmark.
  Eigen::VectorXd weights;               ///< 68: w_k.
  double rms_before_px = 0, rms_px = 0;  ///< Weighted root mean square distance of anchors from landmarks.
};

/// Fine alignment of a posed face to landmarks of its picture by Laplacian deformation [Pan et al. 2024, eq. 9 to 11],
///   min_v sum_i |L(v_i) - L(v0_i)|^2 + sum_k w_k |v_k - p_k|^2,   p_k = R^T (unproject(q_k, depth of v0_k) - t),
/// L by geometry::LaplacianAnchors, w_k the weight of the landmark's part times its confidence, of which only `hidden`
/// is left where the surface about it is turned away. With contour = "slide" the anchor of a jaw landmark is the
/// outermost vertex in the picture on a path from the template's vertex inwards, and its target the place nearest to it
/// on the line of given jaw landmarks, between the neighbours of its own. With keep_order targets of upper lids and lips
/// are never below those of the lower ones, and what still crosses is uncrossed by OpeningMover.
/// All of the template is prepared once: columns of the inverse for each vertex that can be an anchor. Const and
/// thread-safe.
class FineAlignment {
 public:
  /// @throws Error as geometry::LaplacianAnchors.
  explicit FineAlignment(const faces::FaceTemplate& face_template, const FineAlignmentOptions& options = {});

  /// coarse: V x 3, cm; landmarks: 68 x 2, pixels of the view; confidences: 68 in 0 .. 1, or empty for ones. A landmark of
  /// confidence 0 is ignored and may be anything. Landmarks where they are already leave the face as it is, but for lids
  /// and lips that cross. @throws Error if a size differs, a confidence is negative, none counts, or, with the cotangent
  /// Laplacian, a triangle has no area.
  AlignedFace Align(const geometry::Points& coarse, const PortraitPose& pose, const PicturePoints& landmarks,
                    const Eigen::VectorXd& confidences = {}, const PortraitView& view = {}) const;

  /// The vertices of landmarks of a posed face: of the jaw those on its silhouette if contour is "slide".
  std::array<int, 68> Anchors(const geometry::Points& vertices, const PortraitPose& pose,
                              const PortraitView& view = {}) const;

  const FineAlignmentOptions& options() const { return options_; }

 private:
  Eigen::VectorXd Weights(const geometry::Points& coarse, const PortraitPose& pose,
                          const Eigen::VectorXd& confidences) const;

  const FineAlignmentOptions options_;
  const geometry::Triangles triangles_;
  const std::array<int, 68> landmarks_;
  const ContourPaths contour_paths_;
  std::vector<std::vector<int>> surroundings_;  ///< 68: triangles about each landmark.
  const OpeningMover openings_;
  std::vector<int> column_of_;  ///< V: the anchor that a vertex can be, or -1.
  std::unique_ptr<const geometry::LaplacianAnchors> uniform_;
};

}  // namespace daumier::fitting
