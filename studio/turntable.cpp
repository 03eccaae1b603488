#include "studio/turntable.h"

#include "core/evenly_spaced.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/sheet.h"

#include <fmt/format.h>

#include <utility>

namespace daumier::studio {

void WriteTurntable(const std::filesystem::path& folder, const std::function<render::Image(double yaw_degrees)>& draw,
                    const TurntableOptions& options, const Task& task) {
  constexpr int64_t kMostOnSheet = 12;
  std::vector<render::SheetCell> cells;
  for (int i = 0; i < options.frames; ++i) {
    task.ThrowIfCancelled("stopped after {} of {} pictures", i, options.frames);
    const double yaw = 360.0 * i / options.frames;
    render::Image picture = render::ToRgb(draw(yaw));
    render::WriteImage(folder / fmt::format("turn_{:03}.png", i + 1), picture);
    cells.push_back({std::move(picture), fmt::format("{:.0f}", yaw)});
  }
  render::WriteImage(folder / "turntable.png", render::MakeSheet(EvenlySpaced(cells, kMostOnSheet), 6));
}

void WriteTurntable(const std::filesystem::path& folder, const DisplayHead& display, const geometry::Points& face,
                    const TurntableOptions& options, const Task& task) {
  constexpr double kMargin = 1.25;  // The head turns about its middle, and is deeper than wide.
  const render::RenderInput input = display.Picture(face);
  const render::Frame frame = render::FrameOf(face, kMargin);
  const auto draw = [&](double yaw) {
    return render::RenderMesh(input, render::TurnedCamera(frame.centre, frame.half_height, options.size, yaw));
  };
  WriteTurntable(folder, draw, options, task);
}

}  // namespace daumier::studio
