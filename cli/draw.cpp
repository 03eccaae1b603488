#include "cli/verb.h"
#include "core/error.h"
#include "core/options.h"
#include "core/output_place.h"
#include "faces/import/mesh_folder.h"
#include "geometry/triangulate.h"
#include "render/contour_drawing.h"
#include "render/contour_strokes.h"
#include "render/svg.h"

#include <fmt/core.h>

#include <memory>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct DrawArguments {
  fs::path mesh, out;
  bool force = false;
  double yaw = 0, pitch = 0, distance = 0;
  int size = 1024;
  ConfigArguments config;
};

void Draw(const DrawArguments& arguments) {
  const auto options = ParseOptions<render::ContourOptions>(arguments.config.Load(), "options of draw");
  const std::string suffix = arguments.out.extension().string();
  if (suffix != ".svg" && suffix != ".png")
    throw UsageError(fmt::format("--out {}: expected a name that ends in .svg or .png", arguments.out.string()));
  const bool may_replace = arguments.force || render::IsContourDrawing(arguments.out);
  CheckOutputFile(arguments.out, may_replace ? ExistingFile::kReplaced : ExistingFile::kKept, {arguments.mesh});
  const geometry::PolygonMesh polygons = faces::ReadMesh(arguments.mesh);
  const geometry::TriangleMesh mesh{polygons.vertices, geometry::Triangulate(polygons)};
  const render::Frame frame = render::FrameOf(mesh.vertices);
  render::Camera camera =
      render::TurnedCamera(frame.centre, frame.half_height, render::kSketchCanvas, arguments.yaw, arguments.pitch);
  if (arguments.distance > 0) camera = render::WithPerspective(camera, arguments.distance * 2 * frame.half_height);
  const auto strokes = render::DrawContours(mesh, camera, options);
  if (suffix == ".svg") {
    render::WriteSvg(arguments.out, strokes, render::ContourKinds());
  } else {
    render::WriteImage(arguments.out, render::RasteriseStrokes(strokes, arguments.size));
  }
  fmt::print("drawing: {} ({} lines)\n", arguments.out.string(), strokes.size());
}

}  // namespace

Verb DrawVerb() {
  return {"draw", "A line drawing of a mesh: occluding and suggestive contours, borders",
          [](CLI::App& command) {
            auto arguments = std::make_shared<DrawArguments>();
            command.add_option("mesh", arguments->mesh, "OBJ or PLY mesh, y up, facing +z")->required();
            command.add_option("overrides", arguments->config.overrides, "key=value");
            command.add_option("--out", arguments->out, "FILE.svg or FILE.png")->required();
            command.add_flag("--force", arguments->force,
                             "Overwrite --out, whatever it is; an SVG of an earlier `draw` is overwritten without it");
            command.add_option("--yaw", arguments->yaw, "Degrees to the face's own left; -90: its right side");
            command.add_option("--pitch", arguments->pitch, "Degrees upwards");
            command
                .add_option("--distance", arguments->distance,
                            "Distance of the perspective camera in heights of the mesh; 0: orthographic")
                ->check(CLI::Range(0.0, 1e4));
            command.add_option("--size", arguments->size, "Pixels a side of a PNG")
                ->check(CLI::Range(16, 8192))
                ->capture_default_str();
            command.footer("Options:\n" + HelpText<render::ContourOptions>());
            return [arguments] { Draw(*arguments); };
          },
          /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli
