#pragma once
#include "core/options.h"

namespace daumier::datasets {

// How often styles occur. Of alternatives the numbers are weights: each is drawn in proportion to its own. Others are
// probabilities.

inline constexpr Range kStyleWeight = {0, 100}, kStyleShare = {0, 1};

struct MouthStyles {
  double outline_and_middle = 4, outline = 1, middle = 2, upper_and_middle = 1;
  double lips_and_opening = 5, opening = 1.5;
  double teeth = 0.4, tongue = 0.15, opened = 0.15, closed = 0.25, none = 0;

  template <class V>
  void Visit(V&& visit) {
    visit("outline_and_middle", outline_and_middle, kStyleWeight, "Closed: both lips and the line between them.");
    visit("outline", outline, kStyleWeight, "Closed: both lips without a line between them.");
    visit("middle", middle, kStyleWeight, "Closed: the line between the lips alone.");
    visit("upper_and_middle", upper_and_middle, kStyleWeight, "Closed: the upper lip and the line between.");
    visit("lips_and_opening", lips_and_opening, kStyleWeight, "Open: both lips and the opening.");
    visit("opening", opening, kStyleWeight, "Open: the opening alone.");
    visit("teeth", teeth, kStyleShare, "Teeth in an open mouth.");
    visit("tongue", tongue, kStyleShare, "A tongue in an open mouth without teeth.");
    visit("opened", opened, kStyleShare, "A closed mouth is drawn open.");
    visit("closed", closed, kStyleShare, "An open mouth is drawn closed.");
    visit("none", none, kStyleShare, "No mouth.");
  }
};

struct EyeStyles {
  double almond = 6, upper_lid = 1, circle = 1, dot = 0.3, dash = 0.1;
  double iris = 0.8, pupil = 0.6, solid_iris = 0.15, lashes = 0.15, double_lid = 0.3, bags = 0.12;
  double closed = 0.1, wink = 0.07, one_missing = 0;

  template <class V>
  void Visit(V&& visit) {
    visit("almond", almond, kStyleWeight, "Both lids.");
    visit("upper_lid", upper_lid, kStyleWeight, "The upper lid and the iris.");
    visit("circle", circle, kStyleWeight, "A circle or an oval.");
    visit("dot", dot, kStyleWeight, "A dot.");
    visit("dash", dash, kStyleWeight, "A short straight line.");
    visit("iris", iris, kStyleShare, "An iris in an open eye.");
    visit("pupil", pupil, kStyleShare, "A pupil in an iris.");
    visit("solid_iris", solid_iris, kStyleShare, "The iris is a black disc.");
    visit("lashes", lashes, kStyleShare, "Lashes.");
    visit("double_lid", double_lid, kStyleShare, "The crease above the upper lid.");
    visit("bags", bags, kStyleShare, "Lines below the eyes.");
    visit("closed", closed, kStyleShare, "Both eyes are drawn closed, whatever the face's are.");
    visit("wink", wink, kStyleShare, "One eye is drawn closed.");
    visit("one_missing", one_missing, kStyleShare, "One eye is not drawn.");
  }
};

struct BrowStyles {
  double outline = 4, line = 2, fill = 1, strokes = 1;
  double none = 0.06;

  template <class V>
  void Visit(V&& visit) {
    visit("outline", outline, kStyleWeight, "Both edges.");
    visit("line", line, kStyleWeight, "One line.");
    visit("fill", fill, kStyleWeight, "A black area.");
    visit("strokes", strokes, kStyleWeight, "Short strokes like hairs.");
    visit("none", none, kStyleShare, "No brows.");
  }
};

struct NoseStyles {
  double one_side = 2, both_sides = 3, wings = 3, nostrils = 1, hook = 1, bridge = 0.5, round = 0.6, dot = 0;
  double none = 0.03;

  template <class V>
  void Visit(V&& visit) {
    visit("one_side", one_side, kStyleWeight, "One side of the bridge, and the base.");
    visit("both_sides", both_sides, kStyleWeight, "Both sides of the bridge, and the base.");
    visit("wings", wings, kStyleWeight, "Wings and base.");
    visit("nostrils", nostrils, kStyleWeight, "Two nostrils.");
    visit("hook", hook, kStyleWeight, "An L, a line down and to a side.");
    visit("bridge", bridge, kStyleWeight, "A line of the bridge alone.");
    visit("round", round, kStyleWeight, "A round or pointed outline.");
    visit("dot", dot, kStyleWeight, "A dot.");
    visit("none", none, kStyleShare, "No nose.");
  }
};

struct HeadStyles {
  double ears = 0.85, inner_ears = 0.6, wrinkles = 0.35, folds = 0.12, freckles = 0.03, cheeks = 0.03;
  double open_top = 0.1;

  template <class V>
  void Visit(V&& visit) {
    visit("ears", ears, kStyleShare, "Ears, where hair does not hide them.");
    visit("inner_ears", inner_ears, kStyleShare, "Lines inside the ears.");
    visit("wrinkles", wrinkles, kStyleShare, "The face's own suggestive contours.");
    visit("folds", folds, kStyleShare, "Lines of cheeks, forehead and chin.");
    visit("freckles", freckles, kStyleShare, "Freckles, moles, a beauty spot.");
    visit("cheeks", cheeks, kStyleShare, "Circles or hatching on the cheeks.");
    visit("open_top", open_top, kStyleShare, "Of a head without hair the jaw alone, open at the top.");
  }
};

struct HairStyles {
  double none = 1.2, short_cut = 4, long_cut = 4, swept = 2, spiky = 1, strokes = 1, curls = 1, tails = 0.6, bun = 0.6;
  double strands = 0.55, solid = 0.06, few = 0, beard = 0.08, moustache = 0.06, stubble = 0.06;

  template <class V>
  void Visit(V&& visit) {
    visit("none", none, kStyleWeight, "A bald head.");
    visit("short_cut", short_cut, kStyleWeight, "Short hair: a mass with a hairline.");
    visit("long_cut", long_cut, kStyleWeight, "Hair down to the chin or the shoulders.");
    visit("swept", swept, kStyleWeight, "A fringe to one side.");
    visit("spiky", spiky, kStyleWeight, "Spikes.");
    visit("strokes", strokes, kStyleWeight, "Short strokes round the crown.");
    visit("curls", curls, kStyleWeight, "Masses of scribbles at both sides.");
    visit("tails", tails, kStyleWeight, "Two tails or plaits.");
    visit("bun", bun, kStyleWeight, "Hair tied to a bun.");
    visit("few", few, kStyleWeight, "A few lines or loops on the crown or at its sides.");
    visit("strands", strands, kStyleShare, "Lines of strands inside a mass.");
    visit("solid", solid, kStyleShare, "A mass is black.");
    visit("beard", beard, kStyleShare, "A beard.");
    visit("moustache", moustache, kStyleShare, "A moustache.");
    visit("stubble", stubble, kStyleShare, "Short strokes along the jaw.");
  }
};

struct ExtraStyles {
  double hat = 0.06, glasses = 0.1, neck = 0.7, shoulders = 0.55, collar = 0.3, earrings = 0.06, hatching = 0.1;
  double page_marks = 0.08, construction = 0.05;

  template <class V>
  void Visit(V&& visit) {
    visit("hat", hat, kStyleShare, "A hat.");
    visit("glasses", glasses, kStyleShare, "Glasses.");
    visit("neck", neck, kStyleShare, "A neck.");
    visit("shoulders", shoulders, kStyleShare, "Shoulders, if there is a neck.");
    visit("collar", collar, kStyleShare, "A collar or neckline, if there are shoulders.");
    visit("earrings", earrings, kStyleShare, "Earrings.");
    visit("hatching", hatching, kStyleShare, "Hatched shade of cheeks, nose or neck.");
    visit("page_marks", page_marks, kStyleShare, "Frames, writing, specks.");
    visit("construction", construction, kStyleShare, "Lines that help to construct a face.");
  }
};

/// What is drawn, and how.
struct FeatureStyles {
  MouthStyles mouth;
  EyeStyles eyes;
  BrowStyles brows;
  NoseStyles nose;
  HeadStyles head;
  HairStyles hair;
  ExtraStyles extras;

  template <class V>
  void Visit(V&& visit) {
    visit("mouth", mouth, Table{}, "Mouths.");
    visit("eyes", eyes, Table{}, "Eyes.");
    visit("brows", brows, Table{}, "Brows.");
    visit("nose", nose, Table{}, "Noses.");
    visit("head", head, Table{}, "Outline, ears, skin.");
    visit("hair", hair, Table{}, "Hair.");
    visit("extras", extras, Table{}, "What is not the face.");
  }
};

/// Those of drawings in which every part is a sign: dots and circles, a curved line, a round head.
FeatureStyles DoodleFeatures();

/// How far a drawing differs from the face that it shows.
struct ProportionStyles {
  double parts = 0.06;
  double whole = 0.02;
  double doodle = 1;

  template <class V>
  void Visit(V&& visit) {
    visit("parts", parts, Range{0, 0.5},
          "Standard deviation of sizes of parts (logarithm), and of their places in eye spans.");
    visit("whole", whole, Range{0, 0.2}, "Smooth bending of the whole drawing, in heights of the head.");
    visit("doodle", doodle, kStyleShare,
          "How far doodles depart from the proportions of the face: 0 not at all, 1 as in doodles by people.");
  }
};

struct HandStyles {
  double width = 1.5, width_spread = 0.35;
  double tremor_px = 0.7, bend_px = 1.2;
  double double_strokes = 0.15, searching = 0.12, gaps = 0.1, overshoot = 0.35, polygons = 0.1;

  template <class V>
  void Visit(V&& visit) {
    visit("width", width, Range{0.5, 8}, "Median width of the pen, pixels of the 256 canvas.");
    visit("width_spread", width_spread, Range{0, 1}, "Standard deviation of its logarithm.");
    visit("tremor_px", tremor_px, Range{0, 8}, "Greatest tremor, root mean square along each axis.");
    visit("bend_px", bend_px, Range{0, 16}, "Greatest error of a whole line, root mean square along each axis.");
    visit("double_strokes", double_strokes, kStyleShare, "Drawings in which lines are drawn twice.");
    visit("searching", searching, kStyleShare, "Drawings of short overlapping strokes.");
    visit("gaps", gaps, kStyleShare, "Drawings of lines with gaps.");
    visit("overshoot", overshoot, kStyleShare, "Drawings whose lines begin too early or end too late.");
    visit("polygons", polygons, kStyleShare, "Drawings of few straight pieces.");
  }
};

struct PageStyles {
  double turn_degrees = 6, greatest_turn = 15, small = 0.12, cropped = 0.2, off_centre = 0.2, prefix = 0.25;

  template <class V>
  void Visit(V&& visit) {
    visit("turn_degrees", turn_degrees, Range{0, 45}, "Standard deviation of the turn of the drawing.");
    visit("greatest_turn", greatest_turn, Range{0, 90}, "Greatest turn, degrees.");
    visit("small", small, kStyleShare, "Drawings that take a small part of the canvas.");
    visit("cropped", cropped, kStyleShare, "Drawings whose hair and shoulders leave the canvas.");
    visit("off_centre", off_centre, kStyleShare, "Drawings out of the middle.");
    visit("prefix", prefix, kStyleShare, "Unfinished drawings: their first strokes alone.");
  }
};

struct StyleOptions {
  double doodles = 0.3, cartoons = 0.2, exact = 0.05;
  FeatureStyles features;
  FeatureStyles doodle_features = DoodleFeatures();
  ProportionStyles proportions;
  HandStyles hand;
  PageStyles page;

  template <class V>
  void Visit(V&& visit) {
    visit("doodles", doodles, kStyleShare, "Share of doodles, whose parts are signs.");
    visit("cartoons", cartoons, kStyleShare, "Share of cartoons: bold smooth lines, large parts.");
    visit("exact", exact, kStyleShare, "Share of drawings that have the face's exact lines.");
    visit("features", features, Table{}, "What is drawn, in all but doodles.");
    visit("doodle_features", doodle_features, Table{}, "What is drawn in doodles.");
    visit("proportions", proportions, Table{}, "Errors of sizes and places.");
    visit("hand", hand, Table{}, "How lines are drawn.");
    visit("page", page, Table{}, "Where the drawing is on the canvas.");
  }
};

}  // namespace daumier::datasets
