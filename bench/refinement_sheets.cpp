// Not a benchmark: what the operations of refinement make of a face.
//   refinement_sheets FOLDER
// A sheet each: region (blue) and handles (red), the face before and after from the front, and before and after from another
// side; captions give the greatest displacement and the flipped triangles.
#include "core/error.h"
#include "geometry/flips.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "tests/support/refinement_subject.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>

namespace daumier::sketch {
namespace {

using testing::RefinementSubject;

constexpr View kFront{}, kRight{-90, 0}, kTurned{40, 0};

/// What a row shows.
struct RefinedFace {
  std::string name;
  RefinementState marked, refined;
  View view, second_view;
  CanvasPoints stroke = {};
};

std::vector<RefinedFace> RefinedFaces(const RefinementSubject& subject, const Refinement& refinement) {
  const render::Camera front = subject.Camera(kFront), right = subject.Camera(kRight), turned = subject.Camera(kTurned);
  const RefinementState start = refinement.Begin(subject.face_template.neutral);
  const Eigen::Vector2d cheek = subject.Cheek(kFront);
  std::vector<RefinedFace> faces;

  const RefinementState brushed = refinement.Brush(start, front, {cheek}, 30);
  faces.push_back({"cheek, roll 3", brushed, refinement.Roll(brushed, front, 3), kFront, kTurned});
  const RefinementState in_region =
      refinement.Brush(refinement.Region(start, front, RefinementSubject::Loop(cheek, 60, 75)), front, {cheek}, 30);
  faces.push_back({"cheek in a region, roll 3", in_region, refinement.Roll(in_region, front, 3), kFront, kTurned});
  faces.push_back({"the same, roll -3", in_region, refinement.Roll(in_region, front, -3), kFront, kTurned});

  const RefinementState filled = refinement.Brush(in_region, front, {cheek}, 200);
  const CanvasPoints raise = {cheek, cheek + Eigen::Vector2d(0, -8)};
  faces.push_back({"all of the region, up", filled, refinement.Translate(filled, front, raise), kFront, kTurned});

  const CanvasPoints jaw = RefinementSubject::Swollen(subject.Landmarks(4, 12, kFront), {0, 28});
  faces.push_back({"chin pulled", start, refinement.PullSilhouette(start, front, jaw), kFront, kRight, jaw});

  const CanvasPoints nose = RefinementSubject::Swollen(subject.Profile(3, -1.5, kRight), {14, -4});
  faces.push_back(
      {"nose pulled in profile", start, refinement.PullSilhouette(start, right, nose), kRight, kTurned, nose});
  const CanvasPoints chin = RefinementSubject::Swollen(subject.Profile(-4.5, -9, kRight), {12, 6});
  faces.push_back(
      {"chin pulled in profile", start, refinement.PullSilhouette(start, right, chin), kRight, kTurned, chin});

  const CanvasPoints brow = subject.Landmarks(22, 26, kFront);
  const Eigen::Vector2d middle = subject.Landmark(24, kFront);
  const CanvasPoints up = {middle, middle + Eigen::Vector2d(0, -10)};
  const RefinementState brow_region =
      refinement.Brush(refinement.Region(start, front, RefinementSubject::Loop(middle, 75, 50)), front, brow, 8);
  faces.push_back({"brow in a region, up", brow_region, refinement.Translate(brow_region, front, up), kFront, kTurned});
  const RefinementState brow_whole = refinement.Brush(start, front, brow, 8);
  faces.push_back({"brow, up", brow_whole, refinement.Translate(brow_whole, front, up), kFront, kTurned});

  const geometry::TriangleMesh mesh{start.vertices, subject.face_template.triangles};
  const std::vector<SurfaceLine> lines = VisibleSilhouettes(mesh, turned, VisibleSurface(mesh, turned));
  const auto length = [](const SurfaceLine& line) { return datasets::LengthOf(line.points); };
  CanvasPoints outline;  // Of the far cheek.
  for (const Eigen::Vector2d& point : std::ranges::max_element(lines, {}, length)->points)
    if (point.x() < 256 && point.y() > 250 && point.y() < 380) outline.push_back(point);
  const CanvasPoints bulge = RefinementSubject::Swollen(datasets::Resampled(outline, 60), {-14, 0});
  faces.push_back(
      {"outline pulled, turned", start, refinement.PullSilhouette(start, turned, bulge), kTurned, kFront, bulge});
  return faces;
}

void DrawLine(render::Image& image, const CanvasPoints& line) {
  for (const Eigen::Vector2d& point : line)
    render::FillRectangle(image, int(point.y()) - 1, int(point.x()) - 1, 2, 2, {200, 30, 30});
}

render::Image Shown(const RefinementSubject& subject, const geometry::Points& vertices, const View& view,
                    const std::vector<render::Rgb>& colours = {}) {
  return render::RenderMesh({.surface = {vertices, subject.face_template.triangles}, .vertex_colours = colours},
                            subject.Camera(view));
}

std::vector<render::Rgb> Marked(const RefinementState& state) {
  std::vector<render::Rgb> colours(size_t(state.vertices.rows()), {206, 190, 176});
  for (const int v : state.region->deformation.region()) colours[size_t(v)] = {150, 170, 210};
  for (const int v : state.handles) colours[size_t(v)] = {220, 60, 50};
  return colours;
}

void Run(const std::filesystem::path& folder) {
  const RefinementSubject subject;
  const Refinement refinement(subject.face_template);
  int number = 0;
  for (const RefinedFace& face : RefinedFaces(subject, refinement)) {
    const geometry::Points &before = face.marked.vertices, &after = face.refined.vertices;
    std::vector<render::SheetCell> cells{{Shown(subject, before, face.view, Marked(face.marked)), face.name}};
    for (const View& view : {face.view, face.second_view}) {
      cells.push_back({Shown(subject, before, view), "before"});
      cells.push_back(
          {Shown(subject, after, view),
           fmt::format("after: {:.1f} mm at most, {} flipped triangles",
                       faces::MillimetresPerCm(subject.face_template) * (after - before).rowwise().norm().maxCoeff(),
                       geometry::CountFlippedTriangles(before, after, subject.face_template.triangles))});
    }
    DrawLine(cells[0].image, face.stroke);
    DrawLine(cells[2].image, face.stroke);
    render::WriteImage(folder / fmt::format("{}.png", ++number), render::MakeSheet(cells, 5));
  }
}

}  // namespace
}  // namespace daumier::sketch

int main(int argc, char** argv) {
  try {
    DAUMIER_CHECK(argc == 2, "expected refinement_sheets FOLDER");
    daumier::sketch::Run(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "refinement_sheets: {}\n", error.what());
    return 1;
  }
}
