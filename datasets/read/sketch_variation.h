#pragma once
#include "core/options.h"
#include "datasets/read/augmentation.h"
#include "datasets/read/sketch_database.h"
#include "datasets/styles/face_lines.h"

#include <cstdint>

namespace daumier::datasets {

/// The sketch of a face that a network reads.
struct SketchVariation {
  bool wrinkles = true;
  bool all_views = false;
  AugmentationOptions augmentation;
  StyledShare styled;

  template <class V>
  void Visit(V&& visit) {
    visit("wrinkles", wrinkles, Flag{}, "Show suggestive contours and the outer contour of the lips.");
    visit("all_views", all_views, Flag{},
          "true: read all views of a face, another one in each epoch; false: read only the exact view.");
    visit("augmentation", augmentation, Table{}, "Augmented sketches; off at strength 0.");
    visit("styled", styled, Table{}, "Sketches drawn in styles of people, which are not augmented; off at share 0.");
  }

  /// Whether the sketch is another one in each epoch.
  bool varies(const SketchDatabase& sketches) const {
    return augmentation.strength > 0 || styled.share > 0 || (all_views && sketches.num_views() > 1);
  }
};

/// The sketch of a face in an epoch, a function of its arguments alone. Its `moved` and `visible` are of all strokes of
/// the database, its `strokes` are without wrinkles if they are not wanted. Of a styled sketch `strokes` alone are styled.
/// @throws Error if there is no such face, or as ShapeOf if styled sketches are wanted.
AugmentedSketch VariedSketch(const SketchDatabase& sketches, int face, const SketchVariation& variation, uint64_t seed,
                             int64_t epoch);

}  // namespace daumier::datasets
