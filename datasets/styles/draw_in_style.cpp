#include "datasets/styles/draw_in_style.h"

#include "core/error.h"
#include "datasets/styles/beard_lines.h"
#include "datasets/styles/brow_lines.h"
#include "datasets/styles/bust_lines.h"
#include "datasets/styles/drawing_order.h"
#include "datasets/styles/eye_lines.h"
#include "datasets/styles/glasses_lines.h"
#include "datasets/styles/hair_lines.h"
#include "datasets/styles/hat_lines.h"
#include "datasets/styles/head_lines.h"
#include "datasets/styles/mouth_lines.h"
#include "datasets/styles/nose_lines.h"
#include "datasets/styles/page_lines.h"
#include "datasets/styles/pen_hand.h"
#include "datasets/styles/proportions.h"
#include "datasets/styles/sheet_layout.h"
#include "render/strokes.h"

#include <algorithm>
#include <set>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

/// Eye span, pixels, of a drawing whose head fills the canvas.
constexpr double kFullUnit = 75;
/// Parts of the face with which a drawing shows its view.
constexpr size_t kPartsOfView = 3;

DrawingCharacter DrawCharacter(const FaceShape& shape, const StyleOptions& options, Rng& rng) {
  const double draw = rng.Uniform();
  if (draw < options.doodles)
    return shape.view == faces::DrawnView::kFront ? DrawingCharacter::kDoodle : DrawingCharacter::kCareful;
  if (draw < options.doodles + options.cartoons) return DrawingCharacter::kCartoon;
  return draw < options.doodles + options.cartoons + options.exact ? DrawingCharacter::kExact
                                                                   : DrawingCharacter::kCareful;
}

/// The features of exact drawings: the lines that stored sketches have.
FeatureStyles ExactFeatures() {
  FeatureStyles exact;
  exact.mouth = {.outline_and_middle = 1,
                 .outline = 0,
                 .middle = 0,
                 .upper_and_middle = 0,
                 .lips_and_opening = 1,
                 .opening = 0,
                 .teeth = 0,
                 .tongue = 0,
                 .opened = 0,
                 .closed = 0};
  exact.eyes = {.almond = 1,
                .upper_lid = 0,
                .circle = 0,
                .dot = 0,
                .dash = 0,
                .iris = 0,
                .lashes = 0,
                .double_lid = 0,
                .bags = 0,
                .closed = 0,
                .wink = 0};
  exact.brows = {.outline = 1, .line = 0, .fill = 0, .strokes = 0, .none = 0};
  exact.nose = {
      .one_side = 0, .both_sides = 1, .wings = 0, .nostrils = 0, .hook = 0, .bridge = 0, .round = 0, .none = 0};
  exact.head = {.ears = 1, .inner_ears = 1, .wrinkles = 1, .folds = 0, .freckles = 0, .cheeks = 0, .open_top = 0};
  exact.hair = {.none = 1,
                .short_cut = 0,
                .long_cut = 0,
                .swept = 0,
                .spiky = 0,
                .strokes = 0,
                .curls = 0,
                .tails = 0,
                .bun = 0,
                .beard = 0,
                .moustache = 0,
                .stubble = 0};
  exact.extras = {.hat = 0,
                  .glasses = 0,
                  .neck = 0,
                  .shoulders = 0,
                  .collar = 0,
                  .earrings = 0,
                  .hatching = 0,
                  .page_marks = 0,
                  .construction = 0};
  return exact;
}

/// All lines on the sheet: what lies in front removes what it hides.
void DrawParts(const DrawingContext& drawing) {
  const HairChoice hair = ChooseHair(drawing);
  DrawBust(drawing);
  if (!hair.hides_ears) DrawEars(drawing);
  DrawEarrings(drawing);
  DrawOutline(drawing, hair.border);
  DrawEyes(drawing);
  DrawBrows(drawing);
  DrawNose(drawing);
  DrawMouth(drawing);
  DrawSkin(drawing);
  DrawHatching(drawing);
  DrawBeard(drawing);
  DrawGlasses(drawing);
  DrawHair(drawing, hair);
  DrawHat(drawing);
  DrawConstruction(drawing);
  DrawPageMarks(drawing);
}

FaceShape ShapeToDraw(const FaceShape& shape, const ProportionStyles& proportions, DrawingCharacter character,
                      Rng& rng) {
  if (character == DrawingCharacter::kExact) return shape;
  if (character == DrawingCharacter::kDoodle) return DoodleShape(shape, proportions.doodle * rng.Uniform(0.5, 1), rng);
  return WithErrors(shape, proportions.parts, character, rng);
}

HandHabits HabitsOf(DrawingCharacter character, const HandStyles& styles, double size, Rng& rng) {
  HandHabits habits = DrawHabits(styles, character == DrawingCharacter::kExact, size, rng);
  if (character == DrawingCharacter::kCartoon) {
    habits.width *= rng.Uniform(1, 2.2);
    habits.tremor *= 0.3;
    habits.searching = habits.doubled = habits.polygon = 0;
  }
  if (character == DrawingCharacter::kDoodle) {
    habits.bend *= 1.5;
    habits.searching *= 0.2;
    if (Happens(0.6, rng)) habits.polygon = rng.Uniform(0.8, 2.2);  // As Quick, Draw! stores strokes.
    if (habits.overshoot == 0 && Happens(0.5, rng)) habits.overshoot = rng.Uniform(1, 6);
    if (Happens(0.2, rng)) habits.overshoot = rng.Uniform(5, 14);
  }
  return habits;
}

/// The strokes of all lines, and what they show.
class DrawingMaker {
 public:
  DrawingMaker(const LineSheet& sheet, faces::DrawnView view, const render::Placement& pose) : sheet_(sheet) {
    drawing_.pose = pose;
    drawing_.view.value = view;
  }

  void AddLine(const StyledLine& line, const HandHabits& habits, Rng& rng) {
    const size_t first = drawing_.strokes.size();
    for (StyledStroke& stroke : DrawByHand(line, habits, rng)) drawing_.strokes.push_back(std::move(stroke));
    if (drawing_.strokes.size() == first) return;
    const auto count = static_cast<int>(drawing_.strokes.size());
    for (const LineAnchor& anchor : line.anchors) ShowPoint(anchor.point, line.points[size_t(anchor.index)], first);
    if (line.part == DrawnPart::kMouth && sheet_.mouth) drawing_.mouth = {*sheet_.mouth, count};
    for (size_t side = 0; side < 2; ++side) {
      if (line.part != EyePart(side)) continue;
      if (sheet_.eyes[side]) drawing_.eyes[side] = {*sheet_.eyes[side], count};
      if (sheet_.eye_centres[side]) ShowCentre(side, *sheet_.eye_centres[side], static_cast<int>(first) + 1);
    }
    using enum DrawnPart;
    if (line.part == kOutline || line.part == kEyeRight || line.part == kEyeLeft || line.part == kNose ||
        line.part == kMouth)
      parts_.insert(line.part);
    if (parts_.size() >= kPartsOfView && !drawing_.view.is_shown()) drawing_.view.num_strokes = count;
  }

  StyledDrawing Take() && {
    if (!drawing_.view.is_shown()) drawing_.view = {};
    return std::move(drawing_);
  }

 private:
  /// At the place of the first of a line's strokes that comes near to the point.
  void ShowPoint(faces::FacePoint point, const Vector2d& at, size_t first) {
    auto& shown = drawing_.points[size_t(point)];
    if (shown.is_shown()) return;
    for (size_t i = first; i < drawing_.strokes.size(); ++i) {
      Polyline stroke;
      for (const auto& p : drawing_.strokes[i].points) stroke.emplace_back(p[0], p[1]);
      const Vector2d place = AtShare(stroke, ShareNearest(stroke, at));
      if ((place - at).norm() > StyledDrawing::kLandmarkTolerance) continue;
      shown = {{static_cast<float>(place.x()), static_cast<float>(place.y())}, static_cast<int>(i) + 1};
      return;
    }
  }
  void ShowCentre(size_t side, const Vector2d& at, int num_strokes) {
    auto& shown =
        drawing_.points[size_t(side == 0 ? faces::FacePoint::kEyeRightCentre : faces::FacePoint::kEyeLeftCentre)];
    const bool is_on_canvas = at.minCoeff() >= 0 && at.maxCoeff() <= render::kSketchCanvas;
    if (!shown.is_shown() && is_on_canvas)
      shown = {{static_cast<float>(at.x()), static_cast<float>(at.y())}, num_strokes};
  }

  const LineSheet& sheet_;
  StyledDrawing drawing_;
  std::set<DrawnPart> parts_;
};

}  // namespace

StyledDrawing DrawInStyle(const FaceShape& shape, const StyleOptions& options, Rng& rng) {
  const DrawingCharacter character = DrawCharacter(shape, options, rng);
  const FeatureStyles styles = character == DrawingCharacter::kExact    ? ExactFeatures()
                               : character == DrawingCharacter::kDoodle ? options.doodle_features
                                                                        : options.features;
  const FaceShape drawn = ShapeToDraw(shape, options.proportions, character, rng);
  LineSheet sheet;
  DrawParts({drawn, styles, character, rng, sheet});
  DAUMIER_CHECK(!sheet.lines.empty(), "a styled drawing without lines: the styles leave out all of a face");
  if (character != DrawingCharacter::kExact) sheet.Move(SmoothBend(drawn, options.proportions.whole, rng));
  const render::Placement pose = DrawSheetPose(sheet, options.page, rng);
  sheet.Move([&](const Vector2d& p) { return render::ToCanvas(pose, p); });
  const HandHabits habits = HabitsOf(character, options.hand, pose.scale * drawn.unit / kFullUnit, rng);
  BendLines(sheet, habits.bend, rng);
  SortAsDrawn(sheet, rng);
  DrawingMaker maker(sheet, drawn.view, pose);
  for (const StyledLine& line : sheet.lines) maker.AddLine(line, habits, rng);
  StyledDrawing drawing = std::move(maker).Take();
  DAUMIER_CHECK(!drawing.strokes.empty(), "a styled drawing of {} lines has none on the canvas", sheet.lines.size());
  if (drawn.view == faces::DrawnView::kProfile && Happens(0.5, rng)) drawing = Mirrored(std::move(drawing));
  if (!Happens(options.page.prefix, rng)) return drawing;
  const int num_strokes = 1 + static_cast<int>(rng.Below(drawing.strokes.size()));
  return FirstStrokes(std::move(drawing), num_strokes);
}

}  // namespace daumier::datasets
