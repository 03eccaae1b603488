#include "systems/sketch/input_drawing.h"

#include "core/error.h"
#include "render/line_drawing.h"
#include "render/read_drawing.h"

namespace daumier::sketch {

render::Drawing DrawingOf(const systems::Input& input) {
  if (const auto* drawing = std::get_if<render::Drawing>(&input)) return *drawing;
  if (const auto* image = std::get_if<render::Image>(&input)) return render::TraceLineDrawing(*image).drawing;
  throw Error("a mesh is no input of this run (expected a drawing or an image of one). Draw it first: daumier draw");
}

std::vector<systems::Input> ReadDrawingInputs(const std::filesystem::path& file) {
  std::vector<systems::Input> inputs;
  for (render::Drawing& drawing : render::ReadDrawings(file)) inputs.emplace_back(std::move(drawing));
  return inputs;
}

std::vector<std::string> DrawingExtensions() {
  return {".svg", ".svgz", ".ndjson", ".png",  ".jpg",  ".jpeg",  ".webp",      ".bmp",
          ".tif", ".tiff", ".gif",    ".heic", ".xopp", ".inkml", ".excalidraw"};
}

}  // namespace daumier::sketch
