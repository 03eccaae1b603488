#include "datasets/read/sketch_variation.h"

namespace daumier::datasets {

AugmentedSketch VariedSketch(const SketchDatabase& sketches, int face, const SketchVariation& variation, uint64_t seed,
                             int64_t epoch) {
  const uint64_t index = static_cast<uint64_t>(epoch) << 32 | static_cast<uint32_t>(face);
  int view = 0;
  if (variation.all_views) {
    Rng rng = Stream(seed, "view", index);
    view = static_cast<int>(rng.Below(static_cast<uint64_t>(sketches.num_views())));
  }
  Rng rng = Stream(seed, "augmentation", index);
  AugmentedSketch sketch = Augment(sketches.strokes(face, view), variation.augmentation, rng);
  if (view < sketches.num_drawn_views()) {
    // Nobody labelled the strokes of a drawing: its curves are those of the exact view, and all of them are seen.
    sketch.moved = sketches.strokes(face, sketches.labelled_view(view));
    sketch.visible.clear();
  }
  if (!variation.wrinkles) {
    std::erase_if(sketch.strokes, [&](const render::Stroke& stroke) {
      return IsWrinkleKind(sketches.kinds()[static_cast<size_t>(stroke.kind)]);
    });
  }
  if (variation.styled.share > 0) {
    Rng of_style = Stream(seed, "styled sketch", index);
    if (of_style.Uniform() < variation.styled.share) {
      sketch.strokes = DrawFaceLines(ShapeOf(sketches, face, view), variation.styled, of_style);
      sketch.style = {};
    }
  }
  return sketch;
}

}  // namespace daumier::datasets
