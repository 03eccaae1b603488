#include "datasets/styles/style_options.h"

namespace daumier::datasets {

FeatureStyles DoodleFeatures() {
  FeatureStyles doodle;
  doodle.mouth = {.outline_and_middle = 0.4,
                  .outline = 0.3,
                  .middle = 8,
                  .upper_and_middle = 0,
                  .lips_and_opening = 0.5,
                  .opening = 5,
                  .teeth = 0.35,
                  .tongue = 0.2,
                  .opened = 0.2,
                  .closed = 0.25,
                  .none = 0.03};
  doodle.eyes = {.almond = 0.8,
                 .upper_lid = 0.2,
                 .circle = 4,
                 .dot = 3.5,
                 .dash = 2.5,
                 .iris = 0.35,
                 .pupil = 0.25,
                 .solid_iris = 0.5,
                 .lashes = 0.05,
                 .double_lid = 0.02,
                 .bags = 0.01,
                 .closed = 0.05,
                 .wink = 0.03,
                 .one_missing = 0.01};
  doodle.brows = {.outline = 0.3, .line = 6, .fill = 0.2, .strokes = 0.2, .none = 0.75};
  doodle.nose = {.one_side = 0.3,
                 .both_sides = 0.2,
                 .wings = 0.4,
                 .nostrils = 1,
                 .hook = 4,
                 .bridge = 2,
                 .round = 2.5,
                 .dot = 1.5,
                 .none = 0.5};
  doodle.head = {
      .ears = 0.2, .inner_ears = 0.1, .wrinkles = 0, .folds = 0.02, .freckles = 0.02, .cheeks = 0.04, .open_top = 0.08};
  doodle.hair = {.none = 6,
                 .short_cut = 0.5,
                 .long_cut = 1,
                 .swept = 0.2,
                 .spiky = 0.8,
                 .strokes = 0.4,
                 .curls = 0.5,
                 .tails = 0.3,
                 .bun = 0.15,
                 .strands = 0.2,
                 .solid = 0,
                 .few = 3,
                 .beard = 0.02,
                 .moustache = 0.03,
                 .stubble = 0.01};
  doodle.extras = {.hat = 0.04,
                   .glasses = 0.05,
                   .neck = 0.1,
                   .shoulders = 0.3,
                   .collar = 0.1,
                   .earrings = 0.02,
                   .hatching = 0.01,
                   .page_marks = 0.04,
                   .construction = 0.01};
  return doodle;
}

}  // namespace daumier::datasets
