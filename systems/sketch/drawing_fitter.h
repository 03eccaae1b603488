#pragma once
#include "fitting/labelled_fit.h"
#include "systems/sketch/drawing_parser.h"
#include "systems/sketch/run_folder.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace daumier::sketch {

struct DrawingFitOptions {
  double prior_share = 0.6;
  double least_support = 1;
  double half_trust = 3;
  fitting::LabelledFitOptions solver = {};

  template <class V>
  void Visit(V&& visit) {
    visit("prior_share", prior_share, Range{1e-3, 10},
          "Deviation of a fitted face from the network's, as a share of that of faces.");
    visit("least_support", least_support, Range{0, 1},
          "Share of its confidence that a point keeps where no line of the drawing can show it.");
    visit("half_trust", half_trust, Range{0, 6},
          "Number of drawn features of the six of a face (two eyes, brows, nose, mouth, contour) at which the fitted "
          "face counts as much as the neutral face of the template. 0: the fitted face counts alone.");
    visit("solver", solver, Table{}, "The solver.");
  }
};

/// A parsed drawing on a canvas, as a fit reads it. Of a confidence the share least_support + (1 - least_support) *
/// SupportOf(drawing) is kept.
fitting::LabelledDrawing ToLabelled(const ParsedDrawing& drawing, const render::Placement& canvas_from_sheet,
                                    double least_support = 1);

/// How many of the six features of a face a drawing shows: right eye, left eye, brows, nose, mouth and contour, each as far as
/// its best point is shown (SupportOf).
double NumFeatures(const ParsedDrawing& drawing);
/// The probability that a parse of n features is right: n^8 / (n^8 + h^8), 1 where h is 0. Of few lines a parser often reads
/// a part as the whole.
double TrustOf(double num_features, double half_trust);

/// The upright face of a drawing, and where the drawing lies.
struct FittedFace {
  std::vector<float> vertices;  ///< 3V, cm.
  render::Placement frame;      ///< Sheet to canvas: there the camera sees the face, unless its head was turned.
};

/// Faces of a run in the frame of drawings by people: where a parsed drawing lies on the canvas of the sketches' camera, and
/// the face that fits it. May be used from several threads.
class DrawingFitter {
 public:
  /// @throws Error if the run has no normal distribution of faces, or as fitting::LabelledFitter.
  DrawingFitter(const SketchRunFolder& run, std::shared_ptr<const DrawingParser> parser,
                const DrawingFitOptions& options = {});

  ParsedDrawing Parse(const std::vector<render::Stroke>& strokes) const { return parser_->Parse(strokes); }
  /// Sheet to canvas, by the points and the mean face (fitting::FindFaceFrame), or the face of these vertices (3V, cm).
  /// @throws Error if no point is found.
  render::Placement FrameOf(const ParsedDrawing& drawing) const { return FrameOn(drawing, mean_projected_); }
  render::Placement FrameOf(const ParsedDrawing& drawing, std::span<const float> vertices) const;
  /// The face on the canvas of the camera, from the vertices (3V, cm) that a network predicts. frame: FrameOf. Vertices are
  /// the mean over what the parse may be, right (TrustOf) or not: trust * fitted face + (1 - trust) * neutral face of the
  /// template. The mean of all faces, whose mouth is a little open, is not what people expect of a mouth they have not drawn.
  fitting::LabelledFit Fit(const ParsedDrawing& drawing, const render::Placement& frame,
                           std::span<const float> predicted) const;
  /// Parse, FrameOf, Fit.
  FittedFace FittedTo(const std::vector<render::Stroke>& sketch, std::span<const float> predicted) const;

 private:
  render::Placement FrameOn(const ParsedDrawing& drawing, const Eigen::MatrixX2d& projected) const;

  std::shared_ptr<const DrawingParser> parser_;
  DrawingFitOptions options_;
  fitting::LabelledFitter fitter_;
  faces::FacePointVertices points_;
  render::Camera camera_;
  Eigen::VectorXf resting_face_;     ///< 3V, cm: the neutral face of the template.
  Eigen::MatrixX2d mean_projected_;  ///< The mean face, V x 2, on the canvas.
};

}  // namespace daumier::sketch
