#include "studio/sketch_state_json.h"

#include <algorithm>
#include <cmath>

namespace daumier::studio {
namespace {

/// Numbers of the page have as many digits as a screen shows.
double Rounded(double number) {
  constexpr double kSteps = 100;
  return std::round(number * kSteps) / kSteps;
}

Json LineOf(const render::WeightedStroke& stroke, const char* kind) {
  Json line = {{"kind", kind}, {"points", Json::array()}, {"width", 0}};
  for (const auto& [x, y] : stroke.points) line["points"].push_back({Rounded(x), Rounded(y)});
  if (stroke.widths.empty()) return line;
  line["width"] = Rounded(*std::ranges::max_element(stroke.widths));
  for (const float width : stroke.widths) line["widths"].push_back(Rounded(width));
  return line;
}

Json LinesOf(const sketch::SketchState& state) {
  const std::vector<render::WeightedStroke> strokes = sketch::SketchSession::OnSheet(state);
  const bool has_curves = state.is_follow_up() || state.is_refinement();
  const size_t num_curves = has_curves ? strokes.size() - state.lines.wrinkles.size() : 0;
  Json lines = Json::array();
  for (size_t i = 0; i < strokes.size(); ++i)
    lines.push_back(LineOf(strokes[i], !has_curves ? "stroke" : i < num_curves ? "curve" : "wrinkle"));
  return lines;
}

Json OpenEndsOf(const sketch::SketchState& state) {
  const render::Placement sheet_from_canvas = render::Inverse(state.frame);
  Json all = Json::array();
  for (const sketch::SessionCurve& curve : state.lines.curves) {
    const std::optional<sketch::GapEnds> found = sketch::EndsOfGap(curve);
    if (!found) continue;
    Json ends = Json::array();
    for (const Eigen::Vector2d& end : {found->first, found->last}) {
      const Eigen::Vector2d point = render::ToCanvas(sheet_from_canvas, end);
      ends.push_back({Rounded(point.x()), Rounded(point.y())});
    }
    all.push_back(std::move(ends));
  }
  return all;
}

}  // namespace

Json SketchStateJson(const sketch::SketchState& state) {
  Json json = {{"mode", state.is_refinement()  ? "refine"
                        : state.is_follow_up() ? "follow_up"
                                               : "draw"},
               {"has_face", state.vertices.rows() > 0},
               {"lines", LinesOf(state)},
               {"open_ends", OpenEndsOf(state)},
               {"snap_reach", Rounded(sketch::kSnapReach / state.frame.scale)},
               {"eraser_reach", Rounded(sketch::kEraserReach / state.frame.scale)},
               {"handles", Json::array()},
               {"region", Json::array()},
               {"warnings", state.warnings},
               {"drawn_parts", state.drawn_parts}};
  if (!state.is_refinement()) return json;
  json["handles"] = state.refinement->handles;
  if (!state.refinement->region->is_whole) json["region"] = state.refinement->region->deformation.region();
  return json;
}

}  // namespace daumier::studio
