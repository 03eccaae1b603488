#include "datasets/styles/brow_lines.h"

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using enum faces::FacePoint;

constexpr int kLastOfBrow = BrowShape::kPoints - 1;

std::vector<LineAnchor> EndsOf(size_t side, int last) {
  if (side == 0) return {{kBrowRightOuter, 0}, {kBrowRightInner, last}};
  return {{kBrowLeftOuter, 0}, {kBrowLeftInner, last}};
}

void DrawHairs(const DrawingContext& drawing, const BrowShape& brow, size_t side, int count, double lean) {
  for (int i = 0; i < count; ++i) {
    const double share = double(i) / (count - 1);
    const double tip = std::clamp(share - lean * drawing.Uniform(0.5, 1.2), 0.0, 1.0);
    const Vector2d root = AtShare(brow.lower, share), end = AtShare(brow.upper, tip);
    StyledLine& hair = drawing.sheet.AddMark(DrawnPart::kBrows, faces::LineLabel::kBrow, {root, (root + end) / 2, end});
    if (i == 0) hair.anchors.push_back({EndsOf(side, 0)[0].point, 1});
    if (i == count - 1) hair.anchors.push_back({EndsOf(side, 0)[1].point, 1});
  }
}

}  // namespace

void DrawBrows(const DrawingContext& drawing) {
  const BrowStyles& styles = drawing.styles.brows;
  if (drawing.Happens(styles.none)) return;
  const size_t kind = DrawByWeight<4>({styles.outline, styles.line, styles.fill, styles.strokes}, drawing.rng);
  const double between = drawing.Uniform(0.1, 0.6), width = drawing.Happens(0.3) ? drawing.Uniform(1.3, 2.2) : 1;
  const int num_hairs = drawing.Count(6, 14);
  const double lean = drawing.Uniform(0.03, 0.15);
  const bool is_open = drawing.Happens(0.3);
  for (size_t side = 0; side < 2; ++side) {
    const BrowShape& brow = drawing.shape.brows[side];
    if (!brow.is_seen()) continue;
    const Polyline lower = Reversed(brow.lower);
    Polyline loop = brow.upper;
    loop.insert(loop.end(), lower.begin() + 1, lower.end());
    switch (kind) {
      case 0:
        if (is_open) {  // Not joined at the outer end.
          std::vector<LineAnchor> ends = EndsOf(side, kLastOfBrow);
          drawing.sheet.Add(DrawnPart::kBrows, faces::LineLabel::kBrow, brow.upper, ends);
          drawing.sheet.Add(DrawnPart::kBrows, faces::LineLabel::kBrow,
                            Part(brow.lower, drawing.Uniform(0, 0.2), 1, 9));
        } else {
          drawing.sheet.Add(DrawnPart::kBrows, faces::LineLabel::kBrow, loop, EndsOf(side, kLastOfBrow));
        }
        break;
      case 1:
        drawing.sheet
            .Add(DrawnPart::kBrows, faces::LineLabel::kBrow, Mixed(brow.upper, brow.lower, between),
                 EndsOf(side, kLastOfBrow))
            .width = width;
        break;
      case 2: {
        StyledLine& area =
            drawing.sheet.Add(DrawnPart::kBrows, faces::LineLabel::kBrow, loop, EndsOf(side, kLastOfBrow));
        area.filled = true;
        area.care = LineCare::kShort;
        break;
      }
      default:
        DrawHairs(drawing, brow, side, num_hairs, lean);
    }
  }
}

}  // namespace daumier::datasets
