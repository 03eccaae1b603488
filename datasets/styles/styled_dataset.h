#pragma once
#include "core/sample_batch.h"
#include "datasets/styles/draw_in_style.h"
#include "datasets/styles/drawing_raster.h"

#include <cstdint>
#include <span>
#include <vector>

namespace daumier::datasets {

/// Sizes of what a parser of drawings reads and learns.
struct StyledSides {
  int picture = 256;  ///< R
  int map = 64;       ///< M of the heat maps, whose cells are the unit of the points.
  int labels = 128;   ///< L
};

/// Which drawings it reads.
struct StyledReading {
  double turned = 0.3;        ///< Share of turned views where a database has them.
  double mirrored = 0.5;      ///< Share of mirror images.
  double as_drawn = 0;        ///< Share of pictures with the drawing's own pens and black areas; all others are traced.
  double traced_width = 1.5;  ///< Pixels of the 256 canvas.
  StyleOptions styles;

  template <class V>
  void Visit(V&& visit) {
    visit("turned", turned, Range{0, 1}, "Share of views that are turned, where a folder of sketches has some.");
    visit("mirrored", mirrored, Range{0, 1}, "Share of mirror images.");
    visit("as_drawn", as_drawn, Range{0, 1},
          "Share of pictures with the drawing's own pens and black areas; others show all lines in one width, as "
          "drawings are traced.");
    visit("traced_width", traced_width, Range{0.5, 8}, "Width of traced lines, pixels of the 256 canvas.");
    visit("styles", styles, Table{}, "Styles.");
  }
};

/// Faces of a folder of sketches.
struct StyledSource {
  SketchDatabase sketches;
  std::vector<int> faces;
};

/// The class of a state that a drawing does not show, and of a cell without ink (losses::kNoLabel).
inline constexpr int64_t kUnknownClass = -100;
/// The states of a drawing in their order, and the number of classes of each.
inline constexpr std::array<std::string_view, 4> kDrawingStateNames = {"mouth", "eye_right", "eye_left", "view"};
inline constexpr std::array<int, 4> kDrawingStateClasses = {faces::kNumMouthStates, faces::kNumEyeStates,
                                                            faces::kNumEyeStates, faces::kNumDrawnViews};

/// Drawings of stored faces in styles, another one in each epoch, made by all cores when they are read. A sample is a
/// function of the reading, the seed, its index and the epoch alone.
class StyledDataset {
 public:
  /// Samples are the faces of the sources, one source after the other. @throws Error if a source has no facts, or no
  /// such face.
  StyledDataset(std::vector<StyledSource> sources, const StyledReading& reading, uint64_t seed,
                const StyledSides& sides = {});

  int size() const { return first_.back(); }
  /// The source and the face of a sample. @throws Error if there is no such sample.
  struct Origin {
    int source, face;
  };
  Origin origin(int sample) const;
  StyledDrawing Drawing(int sample, int64_t epoch) const;

  /// Of B samples:
  ///   pictures  B x 1 x R x R, ink = 1, paper = 0
  ///   points    B x 26 x 2, by FacePoint, cells of an M x M map: the canvas's pixels times M / 256
  ///   weights   B x 26: 1 where the drawing shows the point, 0 elsewhere
  ///   labels    B x L x L indices: LineLabel, kUnknownClass where there is no ink (RasteriseLabels)
  ///   states    B x 4 indices: as kDrawingStateNames, kUnknownClass where the drawing does not show it
  /// May be called from several threads. @throws Error if a sample is not one of 0..size()-1.
  SampleBatch Get(std::span<const int> samples, int64_t epoch) const;

 private:
  std::vector<StyledSource> sources_;
  StyledReading reading_;
  StyledSides sides_;
  uint64_t seed_;
  std::vector<int> first_ = {0};  ///< The first sample of each source, then the number of all.
};

}  // namespace daumier::datasets
