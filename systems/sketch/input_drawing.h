#pragma once
#include "render/drawing.h"
#include "systems/predictor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::sketch {

/// A drawing, or an image traced to one (render::TraceLineDrawing). @throws Error if it is a mesh, or as TraceLineDrawing.
render::Drawing DrawingOf(const systems::Input& input);

/// The drawings of a file as inputs. @throws Error as render::ReadDrawings.
std::vector<systems::Input> ReadDrawingInputs(const std::filesystem::path& file);

/// Of files that hold drawings: ".svg", in lower case.
std::vector<std::string> DrawingExtensions();

}  // namespace daumier::sketch
