#include "studio/turntable.h"

#include "core/evenly_spaced.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "reports/face_surface.h"

#include <fmt/format.h>

#include <utility>

namespace daumier::studio {

void WriteTurntable(const std::filesystem::path& folder, const faces::FaceTemplate& face_template,
                    const geometry::Points& face, const TurntableOptions& options, const Task& task) {
  constexpr int64_t kMostOnSheet = 12;
  constexpr double kMargin = 1.25;  // The head turns about its middle, and is deeper than wide.
  const faces::FinishedHead head = reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral);
  const render::RenderInput input = reports::InputOf(head, face);
  const render::Frame frame = render::FrameOf(face, kMargin);
  std::vector<render::SheetCell> cells;
  for (int i = 0; i < options.frames; ++i) {
    task.ThrowIfCancelled("stopped after {} of {} pictures", i, options.frames);
    const double yaw = 360.0 * i / options.frames;
    const render::Camera camera = render::TurnedCamera(frame.centre, frame.half_height, options.size, yaw);
    render::Image picture = render::ToRgb(render::RenderMesh(input, camera));
    render::WriteImage(folder / fmt::format("turn_{:03}.png", i + 1), picture);
    cells.push_back({std::move(picture), fmt::format("{:.0f}", yaw)});
  }
  render::WriteImage(folder / "turntable.png", render::MakeSheet(EvenlySpaced(cells, kMostOnSheet), 6));
}

}  // namespace daumier::studio
