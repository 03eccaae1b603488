#include "render/quickdraw.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/log.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace daumier::render {
namespace {

/// Coordinates of the simplified drawings are 0, ..., 255.
constexpr double kSimplifiedSide = 256.0;

std::vector<float> Coordinates(const Json& list) {
  DAUMIER_CHECK(list.is_array(), "coordinates must be a list of numbers");
  std::vector<float> values;
  for (const auto& value : list) {
    DAUMIER_CHECK(value.is_number(), "coordinates must be numbers, found {}", value.dump());
    values.push_back(value.get<float>());
    DAUMIER_CHECK(std::isfinite(values.back()), "the coordinate {} is not finite", value.dump());
  }
  return values;
}

Drawing DrawingOf(const Json& json) {
  DAUMIER_CHECK(json.is_object() && json.contains("drawing") && json["drawing"].is_array(),
                "expected an object with a list \"drawing\"");
  Drawing drawing{kSimplifiedSide, kSimplifiedSide, {}};
  for (const auto& entry : json["drawing"]) {
    DAUMIER_CHECK(entry.is_array() && (entry.size() == 2 || entry.size() == 3),
                  "a stroke must be [[x...], [y...]] or [[x...], [y...], [t...]]");
    const auto xs = Coordinates(entry[0]), ys = Coordinates(entry[1]);
    DAUMIER_CHECK(xs.size() == ys.size(), "a stroke has {} x but {} y", xs.size(), ys.size());
    if (xs.empty()) continue;
    Stroke stroke;
    for (size_t i = 0; i < xs.size(); ++i) {
      stroke.points.push_back({xs[i], ys[i]});
      drawing.width = std::max<double>(drawing.width, xs[i]);
      drawing.height = std::max<double>(drawing.height, ys[i]);
    }
    drawing.strokes.push_back(std::move(stroke));
  }
  DAUMIER_CHECK(!drawing.strokes.empty(), "the drawing holds no strokes");
  return drawing;
}

}  // namespace

std::vector<Drawing> ReadQuickDraw(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  std::vector<Drawing> drawings;
  std::vector<std::string> faults;
  std::string_view rest = bytes;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    try {
      drawings.push_back(DrawingOf(ParseJson(line, "a drawing")));
    } catch (const std::exception& error) {
      faults.push_back(fmt::format("{}:{}: {}", path.string(), line_number, error.what()));
    }
  }
  if (drawings.empty() && !faults.empty()) throw Error(faults.front());
  for (const std::string& fault : faults) log::Warn("{}; the line is skipped", fault);
  DAUMIER_CHECK(!drawings.empty(), "{}: the file holds no drawings", path.string());
  return drawings;
}

}  // namespace daumier::render
