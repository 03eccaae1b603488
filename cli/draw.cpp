#include "cli/verb.h"
#include "core/error.h"
#include "core/options.h"
#include "core/output_place.h"
#include "faces/import/mesh_folder.h"
#include "render/contour_drawing.h"
#include "render/mesh_drawing.h"
#include "render/svg.h"

#include <fmt/core.h>

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, render::AxisDirection>& AxisDirections() {
  using enum render::AxisDirection;
  static const std::map<std::string, render::AxisDirection> directions = {
      {"x", kX}, {"-x", kMinusX}, {"y", kY}, {"-y", kMinusY}, {"z", kZ}, {"-z", kMinusZ}};
  return directions;
}

struct DrawArguments {
  fs::path mesh, out;
  std::string up, front;
  bool force = false;
  double yaw = 0, pitch = 0, distance = 0;
  int size = 1024;
  ConfigArguments config;
};

render::MeshView ViewOf(const DrawArguments& arguments) {
  // CLI::Range lets NaN through.
  if (!std::isfinite(arguments.yaw) || !std::isfinite(arguments.pitch) || !std::isfinite(arguments.distance)) {
    throw UsageError(fmt::format("--yaw {}, --pitch {}, --distance {}: expected numbers", arguments.yaw,
                                 arguments.pitch, arguments.distance));
  }
  for (const auto& [option, degrees] : {std::pair("--yaw", arguments.yaw), {"--pitch", arguments.pitch}}) {
    if (std::abs(degrees) > 360)
      throw UsageError(fmt::format("{} {}: expected degrees from -360 to 360", option, degrees));
  }
  render::MeshView view{.yaw_degrees = arguments.yaw, .pitch_degrees = arguments.pitch};
  if (!arguments.up.empty()) view.up = AxisDirections().at(arguments.up);
  if (!arguments.front.empty()) view.front = AxisDirections().at(arguments.front);
  if (arguments.distance > 0) view.distance = arguments.distance;
  return view;
}

void Draw(const DrawArguments& arguments) {
  const auto options = ParseOptions<render::ContourOptions>(arguments.config.Load(), "options of draw");
  const std::string suffix = arguments.out.extension().string();
  if (suffix != ".svg" && suffix != ".png")
    throw UsageError(fmt::format("--out {}: expected a name that ends in .svg or .png", arguments.out.string()));
  const render::MeshView view = ViewOf(arguments);
  const bool may_replace = arguments.force || render::IsContourDrawing(arguments.out);
  CheckOutputFile(arguments.out, may_replace ? ExistingFile::kReplaced : ExistingFile::kKept, {arguments.mesh});
  const auto strokes = render::DrawMesh(faces::ReadMesh(arguments.mesh), view, options, arguments.mesh.string());
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
            command.add_option("mesh", arguments->mesh, "OBJ or PLY mesh; --up names its upward axis")->required();
            command.add_option("overrides", arguments->config.overrides, "key=value");
            command.add_option("-o,--out", arguments->out, "FILE.svg or FILE.png")->required();
            command
                .add_option(
                    "--up", arguments->up,
                    "The mesh's axis that points upwards: z for Blender, CAD and most scanners, -y for cameras; "
                    "by default y")
                ->check(CLI::IsMember(AxisDirections()));
            command
                .add_option(
                    "--front", arguments->front,
                    "The mesh's axis along which the face looks; by default z with --up y, x or -x; -y with --up z; "
                    "-z with --up -y; y with --up -z")
                ->check(CLI::IsMember(AxisDirections()));
            command.add_flag("--force", arguments->force,
                             "Overwrite any existing file; an SVG that `draw` wrote is overwritten without this flag");
            command.add_option("--yaw", arguments->yaw,
                               "Degrees by which the camera moves to the face's own left: 90 shows its left side");
            command.add_option("--pitch", arguments->pitch, "Degrees by which the camera moves up");
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
