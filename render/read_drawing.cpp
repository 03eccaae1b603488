#include "render/read_drawing.h"

#include "core/error.h"
#include "render/line_drawing.h"
#include "render/quickdraw.h"
#include "render/svg.h"

#include <algorithm>
#include <cctype>

namespace daumier::render {

std::vector<Drawing> ReadDrawings(const std::filesystem::path& path, const std::vector<std::string>& kind_names) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  if (suffix == ".svg" || suffix == ".svgz") return {ReadSvg(path, kind_names)};
  if (suffix == ".ndjson") return ReadQuickDraw(path);
  const Image picture = ReadImage(path);
  try {
    return {TraceLineDrawing(picture).drawing};
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace daumier::render
