#include "studio/hand_drawing.h"

#include "core/error.h"
#include "core/files.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace daumier::studio {
namespace {

Eigen::AlignedBox2d BoxOf(const HandDrawing& drawing) {
  Eigen::AlignedBox2d box;
  for (const PenStroke& stroke : drawing.strokes)
    for (const auto& [x, y] : stroke.points) box.extend(Eigen::Vector2d(x, y));
  return box;
}

Eigen::AlignedBox2d BoxOf(const std::vector<render::Stroke>& strokes) {
  Eigen::AlignedBox2d box;
  for (const render::Stroke& stroke : strokes)
    for (const auto& [x, y] : stroke.points) box.extend(Eigen::Vector2d(x, y));
  return box;
}

void CheckStroke(const PenStroke& stroke, size_t index, const std::string& where) {
  const auto all_in = [](const std::vector<double>& values, double least, double greatest) {
    return std::ranges::all_of(values, [&](double value) { return value >= least && value <= greatest; });
  };
  const size_t count = stroke.points.size();
  DAUMIER_CHECK(count > 0 && stroke.times_ms.size() == count && stroke.pressures.size() == count,
                "{}: stroke {} has {} points, {} times and {} pressures, expected as many of each and at least one",
                where, index, count, stroke.times_ms.size(), stroke.pressures.size());
  for (const auto& [x, y] : stroke.points)
    DAUMIER_CHECK(std::abs(x - HandDrawing::kSheet / 2) <= 1.5 * HandDrawing::kSheet &&
                      std::abs(y - HandDrawing::kSheet / 2) <= 1.5 * HandDrawing::kSheet,
                  "{}: stroke {} has the point ({}, {}), expected at most a sheet of {} pixels away from it", where,
                  index, x, y, HandDrawing::kSheet);
  constexpr double kDay = 24.0 * 3600 * 1000;
  DAUMIER_CHECK(all_in(stroke.times_ms, 0, kDay) && std::ranges::is_sorted(stroke.times_ms),
                "{}: the times of stroke {} are not ascending milliseconds of a day", where, index);
  DAUMIER_CHECK(all_in(stroke.pressures, 0, 1), "{}: a pressure of stroke {} is not from 0 to 1", where, index);
}

void CheckDrawing(const HandDrawing& drawing, const std::string& where) {
  size_t num_points = 0;
  for (size_t i = 0; i < drawing.strokes.size(); ++i) {
    CheckStroke(drawing.strokes[i], i, where);
    num_points += drawing.strokes[i].points.size();
  }
  DAUMIER_CHECK(drawing.strokes.size() <= HandDrawing::kMostStrokes && num_points <= HandDrawing::kMostPoints,
                "{}: {} strokes of {} points, expected at most {} of {}", where, drawing.strokes.size(), num_points,
                HandDrawing::kMostStrokes, HandDrawing::kMostPoints);
  DAUMIER_CHECK(num_points > 1 && BoxOf(drawing).sizes().y() > 1,
                "{}: nothing is drawn (expected lines of some height)", where);
  DAUMIER_CHECK(drawing.width > 0 && drawing.width <= 64, "{}: the pen is {} wide, expected 0 to 64 pixels", where,
                drawing.width);
  DAUMIER_CHECK(drawing.seconds >= 0 && drawing.seconds <= 24.0 * 3600, "{}: seconds is {}, expected those of a day",
                where, drawing.seconds);
}

}  // namespace

Json HandDrawingToJson(const HandDrawing& drawing) {
  Json strokes = Json::array();
  for (const PenStroke& stroke : drawing.strokes)
    strokes.push_back({{"points", stroke.points}, {"times_ms", stroke.times_ms}, {"pressures", stroke.pressures}});
  return {{"format_version", HandDrawing::kVersion},
          {"person", drawing.person},
          {"face", drawing.face},
          {"sheet", {HandDrawing::kSheet, HandDrawing::kSheet}},
          {"width", drawing.width},
          {"seconds", drawing.seconds},
          {"strokes", std::move(strokes)}};
}

HandDrawing HandDrawingFromJson(const Json& json, const std::string& where) {
  HandDrawing drawing;
  try {
    const int version = json.at("format_version").get<int>();
    DAUMIER_CHECK(version == HandDrawing::kVersion,
                  "{}: a drawing of version {}, expected {}. Read it with the version of Daumier that wrote it", where,
                  version, HandDrawing::kVersion);
    drawing.person = json.at("person").get<std::string>();
    drawing.face = json.at("face").get<std::string>();
    drawing.width = json.at("width").get<double>();
    drawing.seconds = json.at("seconds").get<double>();
    const auto sheet = json.at("sheet").get<std::array<double, 2>>();
    DAUMIER_CHECK(sheet[0] == HandDrawing::kSheet && sheet[1] == HandDrawing::kSheet,
                  "{}: the sheet is {} x {}, expected {} a side", where, sheet[0], sheet[1], HandDrawing::kSheet);
    for (const Json& stroke : json.at("strokes"))
      drawing.strokes.push_back({stroke.at("points").get<std::vector<std::array<double, 2>>>(),
                                 stroke.at("times_ms").get<std::vector<double>>(),
                                 stroke.at("pressures").get<std::vector<double>>()});
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", where, TextOf(error)));
  }
  CheckDrawing(drawing, where);
  return drawing;
}

std::vector<render::Stroke> OnCanvas(const HandDrawing& drawing, const std::vector<render::Stroke>& exact, int kind) {
  const Eigen::AlignedBox2d from = BoxOf(drawing), to = BoxOf(exact);
  DAUMIER_CHECK(!from.isEmpty() && !to.isEmpty() && from.sizes().y() > 0,
                "a drawing without lines cannot be brought onto the canvas");
  const double scale = to.sizes().y() / from.sizes().y();
  const Eigen::Vector2d shift = to.center() - scale * from.center();
  std::vector<render::Stroke> strokes;
  for (const PenStroke& stroke : drawing.strokes) {
    render::Stroke& moved = strokes.emplace_back(render::Stroke{kind, {}});
    for (const auto& [x, y] : stroke.points)
      moved.points.push_back({float(scale * x + shift.x()), float(scale * y + shift.y())});
  }
  return strokes;
}

void WriteSvg(const std::filesystem::path& file, const HandDrawing& drawing) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\" viewBox=\"0 0 {0} {0}\" fill=\"none\" "
      "stroke=\"#000\" stroke-width=\"{1}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
      HandDrawing::kSheet, drawing.width);
  for (const PenStroke& stroke : drawing.strokes) {
    text += "<path d=\"M";
    for (size_t i = 0; i < stroke.points.size(); ++i)
      text += fmt::format("{}{} {}", i == 0 ? "" : " ", stroke.points[i][0], stroke.points[i][1]);
    // A dot is a line to where it is.
    if (stroke.points.size() == 1) text += fmt::format(" {} {}", stroke.points[0][0], stroke.points[0][1]);
    text += "\"/>\n";
  }
  WriteFileAtomically(file, text + "</svg>\n");
}

}  // namespace daumier::studio
