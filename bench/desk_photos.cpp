// The two halves of tools/desk_photos that the program has no verb for: 24 photographs of a drawing on a desk, and the
// table of how far their faces are from the clean drawing's face.
//   desk_photos make DRAWING OUT       DRAWING is a picture or an SVG; OUT/clean.png and OUT/DESK_BORDER_TILT.png
//   desk_photos compare RUN PREDICTED  PREDICTED is the folder that `daumier predict RUN OUT/*.png` wrote
#include "core/error.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "render/read_drawing.h"
#include "systems/sketch/run_folder.h"
#include "tests/support/desk_photo.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

/// Side of the clean picture of an SVG, and the width of its lines, in pixels of the 256 canvas.
constexpr int kCleanSide = 480;
constexpr double kCleanPen = 2.4;
/// Largest mean distance between the vertices of two faces that are the same but for noise, and the share of photos
/// that must be as near.
constexpr double kRightMm = 1.0;
constexpr int kNumRight = 22;

struct Photo {
  std::string name;
  testing::DeskPhotoOptions options;
};

std::vector<Photo> Photos() {
  std::vector<Photo> photos;
  for (const auto& [desk, desk_name] : {std::pair{testing::Desk::kDark, "dark"}, {testing::Desk::kGrey, "grey"}}) {
    for (const int border : {5, 12, 20, 30}) {
      for (const int tilt : {0, 3, 10}) {
        photos.push_back({fmt::format("{}_{:02}_{:02}", desk_name, border, tilt),
                          {.desk = desk, .border = 0.01 * border, .tilt = double(tilt), .seed = photos.size()}});
      }
    }
  }
  return photos;
}

render::Image CleanPicture(const fs::path& path) {
  if (path.extension() != ".svg") return render::ReadImage(path);
  const render::Drawing drawing = render::ReadDrawings(path)[0];
  const auto scale = static_cast<float>(render::kSketchCanvas / std::max(drawing.width, drawing.height));
  std::vector<render::Stroke> strokes = drawing.strokes;
  for (auto& stroke : strokes) {
    for (auto& [x, y] : stroke.points) {
      x *= scale;
      y *= scale;
    }
  }
  return render::RasteriseStrokes(strokes, kCleanSide, {.width = kCleanPen});
}

int Make(const fs::path& drawing, const fs::path& out) {
  const render::Image clean = CleanPicture(drawing);
  fs::create_directories(out);
  render::WriteImage(out / "clean.png", clean);
  for (const Photo& photo : Photos()) {
    render::WriteImage(out / (photo.name + ".png"), testing::DeskPhoto(clean, photo.options));
  }
  return 0;
}

int Compare(const fs::path& run, const fs::path& predicted) {
  const double mm_per_cm = faces::MillimetresPerCm(sketch::ReadSketchRunFolder(run).face_template);
  const geometry::Points clean = geometry::ReadObj(predicted / "clean.obj").vertices;
  int num_right = 0;
  std::printf("%-12s %8s\n", "photo", "mm");
  for (const Photo& photo : Photos()) {
    const geometry::Points face = geometry::ReadObj(predicted / (photo.name + ".obj")).vertices;
    DAUMIER_CHECK(face.rows() == clean.rows(), "{}: {} vertices, expected the {} of clean.obj", photo.name, face.rows(),
                  clean.rows());
    const double mm = mm_per_cm * (face - clean).rowwise().norm().mean();
    num_right += mm <= kRightMm;
    std::printf("%-12s %8.2f%s\n", photo.name.c_str(), mm, mm <= kRightMm ? "" : "  wrong");
  }
  std::printf("%d of %zu within %.1f mm, expected %d\n", num_right, Photos().size(), kRightMm, kNumRight);
  return num_right >= kNumRight ? 0 : 1;
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    if (arguments.size() == 3 && arguments[0] == "make") return daumier::Make(arguments[1], arguments[2]);
    if (arguments.size() == 3 && arguments[0] == "compare") return daumier::Compare(arguments[1], arguments[2]);
    std::fputs("usage: desk_photos make DRAWING OUT | desk_photos compare RUN PREDICTED\n", stderr);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
