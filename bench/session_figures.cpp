// Figures 9 and 11 of [Han et al. 2017] for a recorded session, from its last state in follow-up mode:
//   session_figures WEIGHTS SESSION.json OUT
// OUT/figure_9.png: the lines; the face with inference; the template deformed by the lines alone. OUT/figure_11.png: the face
// without and with its wrinkle lines, and their signed distance along the normal, mm.
#include "core/error.h"
#include "geometry/normals.h"
#include "render/heat_map.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"
#include "reports/face_pictures.h"
#include "reports/face_surface.h"
#include "systems/sketch/session_file.h"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <memory>

namespace daumier::sketch {
namespace {

constexpr int kSide = 420;

struct Drawer {
  const faces::FinishedHead head;
  const render::Frame frame;

  render::Image Front(const geometry::Points& face) const {
    return render::RenderMesh(reports::InputOf(head, face),
                              render::FrontalCamera(frame.centre, frame.half_height, kSide));
  }
  render::Image Distances(const geometry::Points& face, const Eigen::VectorXd& values) const {
    const double largest = std::max(0.1, values.cwiseAbs().maxCoeff());
    const render::ValueRange range{-largest, largest};
    render::Image image =
        render::RenderHeatMap(reports::InputOf(head, face), head.Values(values), range,
                              render::FrontalCamera(frame.centre, frame.half_height, kSide), render::ColourMap::kTurbo);
    render::DrawColourBar(image, range, "mm", render::ColourMap::kTurbo);
    return image;
  }
};

/// Of each vertex |q - p| with the sign of (q - p) . n, n the normal at p.
Eigen::VectorXd SignedDistances(const geometry::TriangleMesh& from, const geometry::Points& to) {
  const geometry::Points moves = to - from.vertices, normals = geometry::VertexNormals(from);
  const Eigen::VectorXd along = (moves.array() * normals.array()).rowwise().sum();
  return moves.rowwise().norm().array() * along.array().sign();
}

void Run(const std::string& weights, const std::filesystem::path& session_file, const std::filesystem::path& out) {
  const SessionScript script = ReadSession(session_file);
  std::shared_ptr<const systems::Predictor> opened = OpenSketchPredictor(weights, {});
  const auto predictor = std::dynamic_pointer_cast<const SketchPredictor>(opened);
  DAUMIER_CHECK(predictor != nullptr, "{}: no weights of sketches", weights);
  const faces::FaceTemplate& face_template = predictor->run().face_template;
  SketchSession session(predictor, script.width, script.height);
  DAUMIER_CHECK(script.begin.empty() || script.begin == "mean", "{} begins with a face of a file, expected \"mean\"",
                session_file.string());
  if (!script.begin.empty()) session.FollowUp();
  std::shared_ptr<const SketchState> last;
  Replay(script, session, [&](const ReplayedEvent& event) {
    if (event.state->is_follow_up()) last = event.state;
  });
  DAUMIER_CHECK(last != nullptr, "{} has no state in follow-up mode", session_file.string());

  const CurveFollower alone(predictor, Inference::kNone), follower(predictor);
  const geometry::Points deformed = alone.Follow(alone.Begin(face_template.neutral, Untouched::kStay), last->lines);
  SessionLines without = last->lines;
  without.wrinkles.clear();
  const geometry::Points plain = follower.Follow(*last->start, without),
                         wrinkled = follower.Follow(*last->start, last->lines);
  const Drawer drawer{reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral),
                      reports::FrameOfFaces({plain, wrinkled, deformed})};
  std::filesystem::create_directories(out);
  const render::Image lines = render::DrawnWithCurves(StrokesOf(last->lines), {}, kSide);
  render::WriteImage(out / "figure_9.png", render::MakeSheet({{lines, "lines"},
                                                              {drawer.Front(last->vertices), "with inference"},
                                                              {drawer.Front(deformed), "the template, deformed alone"}},
                                                             3));
  const Eigen::VectorXd distances =
      faces::MillimetresPerCm(face_template) * SignedDistances(faces::SurfaceMesh(face_template, plain), wrinkled);
  render::WriteImage(out / "figure_11.png",
                     render::MakeSheet({{lines, fmt::format("{} wrinkle lines", last->lines.wrinkles.size())},
                                        {drawer.Front(plain), "without wrinkle lines"},
                                        {drawer.Front(wrinkled), "with them"},
                                        {drawer.Distances(plain, distances), "signed distance along the normal"}},
                                       4));
  fmt::print("{} wrinkle lines move vertices by {:.2f} mm on average, {:.2f} at most\n", last->lines.wrinkles.size(),
             distances.cwiseAbs().mean(), distances.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace daumier::sketch

int main(int argc, char** argv) {
  try {
    DAUMIER_CHECK(argc == 4, "expected session_figures WEIGHTS SESSION.json OUT");
    daumier::sketch::Run(argv[1], argv[2], argv[3]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "session_figures: {}\n", error.what());
    return 1;
  }
}
