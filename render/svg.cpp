#include "render/svg.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/svg_ink.h"
#include "render/svg_scene.h"

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>

namespace daumier::render {
namespace {

/// Share of the longer side of the sheet by which chords may leave a curve.
constexpr double kTolerance = 0.1 / kSketchCanvas;
/// A file that is not understood has many problems of the same kind.
constexpr size_t kMaxWarnings = 10;

/// Of a stroke with points.
std::string PathData(const std::filesystem::path& file, const Stroke& stroke) {
  std::string data;
  for (const auto& [x, y] : stroke.points) {
    DAUMIER_CHECK(std::isfinite(x) && std::isfinite(y), "{}: a point is ({}, {})", file.string(), x, y);
    data += fmt::format("{}{} {}", data.empty() ? 'M' : 'L', x, y);
  }
  // A lone moveto paints nothing; a closed one paints a dot.
  if (stroke.points.size() == 1) data += 'Z';
  return data;
}

}  // namespace

void WriteSvg(const std::filesystem::path& path, const std::vector<Stroke>& strokes,
              const std::vector<std::string>& kind_names) {
  std::vector<WeightedStroke> plain;
  for (const Stroke& stroke : strokes) plain.push_back({stroke, {}});
  WriteWeightedSvg(path, plain, kind_names);
}

void WriteWeightedSvg(const std::filesystem::path& path, const std::vector<WeightedStroke>& strokes,
                      const std::vector<std::string>& kind_names) {
  for (const auto& name : kind_names) {
    DAUMIER_CHECK(!name.empty() && name.find_first_of(" \t\r\n") == std::string::npos,
                  "{}: '{}' cannot be the name of a kind of line: it is empty or holds white space", path.string(),
                  name);
  }
  pugi::xml_document document;
  auto root = document.append_child("svg");
  root.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
  root.append_attribute("width") = kSketchCanvas;
  root.append_attribute("height") = kSketchCanvas;
  root.append_attribute("viewBox") = fmt::format("0 0 {0} {0}", kSketchCanvas).c_str();
  root.append_attribute("fill") = "none";
  root.append_attribute("stroke") = "black";
  root.append_attribute("stroke-width") = StrokeStyle{}.width;
  root.append_attribute("stroke-linecap") = "round";
  root.append_attribute("stroke-linejoin") = "round";
  for (const WeightedStroke& stroke : strokes) {
    DAUMIER_CHECK(stroke.kind >= 0 && stroke.kind < std::ssize(kind_names),
                  "{}: a stroke is of kind {}, but there are {} names", path.string(), stroke.kind, kind_names.size());
    for (const StrokePart& part : PartsByWidth(stroke)) {
      auto element = root.append_child("path");
      element.append_attribute("class") = kind_names[stroke.kind].c_str();
      element.append_attribute("d") = PathData(path, part.stroke).c_str();
      if (part.width != StrokeStyle{}.width)
        element.append_attribute("stroke-width") = fmt::format("{:g}", part.width).c_str();
    }
  }
  std::ostringstream text;
  document.save(text, "  ");
  WriteFileAtomically(path, text.str());
}

Drawing ReadSvg(const std::filesystem::path& path, const std::vector<std::string>& kind_names) {
  const SvgDocument document(path.string(), ReadFile(path));
  SvgScene scene = ReadSvgScene(document, kind_names, kTolerance);
  std::vector<Stroke> strokes = InkOfScene(scene);
  if (strokes.empty()) {
    throw Error(fmt::format("{}: the drawing holds no strokes{}", path.string(),
                            scene.problems.empty() ? "" : ". " + scene.problems.front()));
  }
  for (size_t i = 0; i < std::min(scene.problems.size(), kMaxWarnings); ++i) log::Warn("{}", scene.problems[i]);
  if (scene.problems.size() > kMaxWarnings) {
    log::Warn("{}: {} more problems of this kind", path.string(), scene.problems.size() - kMaxWarnings);
  }
  Drawing drawing{scene.width, scene.height, std::move(strokes)};
  if (drawing.width > 0 && drawing.height > 0) return drawing;
  for (const Stroke& stroke : drawing.strokes) {
    for (const auto& [x, y] : stroke.points) {
      drawing.width = std::max<double>(drawing.width, x);
      drawing.height = std::max<double>(drawing.height, y);
    }
  }
  return drawing;
}

}  // namespace daumier::render
