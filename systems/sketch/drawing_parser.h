#pragma once
#include "core/options.h"
#include "faces/drawing_terms.h"
#include "render/framing.h"
#include "render/strokes.h"
#include "runtime/network_runner.h"
#include "systems/sketch/parser_network_options.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace daumier::sketch {

struct DrawingParserOptions {
  int rounds = 2;
  bool mirror = true;
  bool turn = true;

  template <class V>
  void Visit(V&& visit) {
    visit("rounds", rounds, Range{1, 4},
          "How often a drawing is parsed: first as a whole, then each time the part that holds the face, upright.");
    visit("mirror", mirror, Flag{}, "Average the parse with that of the mirror image.");
    visit("turn", turn, Flag{},
          "Where points are uncertain, also parse the drawing turned by 90, 180 and 270 degrees, and take what is "
          "clearly more certain.");
  }
};

/// What a drawing shows, in the pixels of its sheet.
struct ParsedDrawing {
  std::array<Eigen::Vector2d, faces::kNumFacePoints> points;   ///< By faces::FacePoint.
  std::array<double, faces::kNumFacePoints> confidences = {};  ///< 0..1: how well the place of a point is determined.
  std::array<double, faces::kNumMouthStates> mouth = {};       ///< Probabilities.
  std::array<std::array<double, faces::kNumEyeStates>, 2> eyes = {};  ///< Right, left.
  std::array<double, faces::kNumDrawnViews> view = {};
  std::vector<render::Stroke> strokes;                ///< As given, with points at most kLabelStep apart on the canvas.
  std::vector<std::vector<faces::LineLabel>> labels;  ///< Of each point of each stroke.
  render::Placement frame;                            ///< Sheet to canvas of the last round.

  /// Mean confidence of the landmarks: of faces by people that lie upright 0.69 to 0.97, of a house or a car below 0.6.
  double confidence() const;

  static constexpr double kLabelStep = 2;  ///< Pixels of the canvas of the first round.
};

/// Parses drawings of one face each by the network of a run or of shipped weights: points, labels of lines, states and
/// view. Of a closed mouth its lines decide (ReadMouthLines). Strokes are drawn in one width, as in its training. May be used from several threads.
class DrawingParser {
 public:
  DrawingParser(const ParserNetworkOptions& network_options, std::shared_ptr<const runtime::NetworkRunner> network,
                const DrawingParserOptions& options = {});

  /// strokes: in pixels of a sheet of any size. Points outside of the canvas of the last round have the labels of the one
  /// before. @throws Error as render::FrameDrawing: there is no line.
  ParsedDrawing Parse(const std::vector<render::Stroke>& strokes) const;

 private:
  /// All rounds, of which the first turns the whole drawing.
  ParsedDrawing ParseTurned(const std::vector<render::Stroke>& strokes, double turn_degrees) const;
  /// One round: everything but labels of points outside of the canvas.
  void ParseIn(const render::Placement& frame, ParsedDrawing& drawing) const;

  ParserNetworkOptions network_options_;
  std::shared_ptr<const runtime::NetworkRunner> network_;
  DrawingParserOptions options_;
};

/// The whole drawing on the canvas, turned by a multiple of 90 degrees, centred, its longer side kWholeShare of the canvas's.
/// @throws Error as render::FrameDrawing.
render::Placement FrameOfWhole(const std::vector<render::Stroke>& strokes, double turn_degrees = 0);
/// The upright face of parsed points on the canvas: turned so that the line of the eyes' centres is level; the box of the
/// points, and of a forehead above, centred, its longer side kFaceShare of the canvas's.
render::Placement FrameOfPoints(const std::array<Eigen::Vector2d, faces::kNumFacePoints>& points);

inline constexpr double kWholeShare = 0.9, kFaceShare = 0.62;

/// ParsedDrawing::confidence below which other turns are tried, and what they need to have, alone and more than the upright
/// drawing. Of 1,310 styled drawings 11 % are below the first; no upright drawing by people reaches both when it is turned.
inline constexpr double kUncertainParse = 0.8, kCertainTurn = 0.66, kMoreCertain = 0.1;

}  // namespace daumier::sketch
