// Not a benchmark: the table of docs/results/edit.md on landmarks of pictures.
//   edit_landmarks PICTURES OUT MODEL... [deviation=SHARE] [registered=FACES]
// PICTURES: a folder of NAME.jpg with NAME.txt, 68 landmarks each. MODEL: as `daumier edit MODEL`. OUT: a folder for
// table.md and a picture of each fit by the first model. FACES: a database of the meshes NAME.obj
// (daumier register): the mean distance of the face region from it after a similarity.
#include "core/error.h"
#include "core/files.h"
#include "core/stopwatch.h"
#include "eval/mesh_score.h"
#include "faces/landmark_parts.h"
#include "fitting/code_landmarks.h"
#include "fitting/mesh_code.h"
#include "geometry/flips.h"
#include "geometry/self_intersections.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "reports/face_pictures.h"
#include "reports/face_surface.h"
#include "systems/deform/open_code_model.h"
#include "systems/portrait/landmark_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

struct Subject {
  std::string name;
  fs::path picture;
  fitting::PicturePoints landmarks;  ///< 68 x 2
  double eye_px = 0;                 ///< Distance of the outer eye corners in the picture.
  geometry::Points mesh = {};        ///< Registered onto the template; empty: not given.
};

/// Mean distance of the face region from the subject's mesh after a similarity, mm.
double MeshDistance(const Subject& subject, const fitting::CodeModel& model, const Eigen::VectorXd& code) {
  return eval::ScoreMesh(subject.name, model.Vertices(code), subject.mesh, model.face_template()).aligned;
}

void AddMeshes(const fs::path& folder, std::vector<Subject>& subjects) {
  const faces::FaceDatabase database(folder);
  const auto meshes = database.manifest().details.value("meshes", std::vector<std::string>{});
  for (Subject& subject : subjects) {
    const auto found = std::ranges::find(meshes, subject.name);
    DAUMIER_CHECK(found != meshes.end(), "{} has no mesh '{}'", folder.string(), subject.name);
    subject.mesh = database.points(database.index({int(found - meshes.begin()), 0, 0}));
  }
}

std::vector<Subject> ReadSubjects(const fs::path& folder) {
  std::vector<Subject> subjects;
  for (const auto& entry : fs::directory_iterator(folder)) {
    fs::path file = entry.path();
    if (file.extension() != ".jpg") continue;
    const std::vector<float> numbers = portrait::ReadLandmarks(fs::path(file).replace_extension(".txt"));
    Subject subject{file.stem().string(), file,
                    Eigen::Map<const Eigen::Matrix<float, 68, 2, Eigen::RowMajor>>(numbers.data()).cast<double>()};
    subject.eye_px = (subject.landmarks.row(36) - subject.landmarks.row(45)).norm();
    subjects.push_back(std::move(subject));
  }
  std::ranges::sort(subjects, {}, [](const Subject& subject) { return std::stoi(subject.name); });
  DAUMIER_CHECK(!subjects.empty(), "{} has no NAME.jpg", folder.string());
  return subjects;
}

/// Which landmarks a fit is given, and which are scored.
struct Trial {
  std::string name;
  std::function<bool(int)> is_given, is_scored;
};

std::vector<Trial> Trials() {
  const auto all = [](int) { return true; };
  std::vector<Trial> trials = {
      {"all, fitted", all, all},
      {"even, odd held out", [](int k) { return k % 2 == 0; }, [](int k) { return k % 2 == 1; }},
      {"odd, even held out", [](int k) { return k % 2 == 1; }, [](int k) { return k % 2 == 0; }},
  };
  int begin = 0;
  for (const faces::LandmarkPart& part : faces::kLandmarkParts) {
    const auto is_in = [begin, end = part.end](int k) { return k >= begin && k < end; };
    trials.push_back({fmt::format("without {}", part.name), [is_in](int k) { return !is_in(k); }, is_in});
    begin = part.end;
  }
  return trials;
}

struct TrialResult {
  double mean = 0, worst = 0;  ///< Of pictures, share of the eye distance.
  std::string worst_name;
  double ms = 0, radius = 0;
  int num_unusual = 0;
  double flips = 0, intersections = 0;
  double mesh_mm = 0, worst_mesh_mm = 0;  ///< MeshDistance.
};

/// Scores of a model in a trial; `each` gets every fit.
TrialResult Measure(const fitting::CodeModel& model, const std::vector<Subject>& subjects, const Trial& trial,
                    fitting::CodeLandmarkOptions options,
                    const std::function<void(const Subject&, const fitting::CodeLandmarkFit&)>& each = {}) {
  const fitting::ContourPaths contour(model.face_template());
  TrialResult result;
  for (const Subject& subject : subjects) {
    fitting::PicturePoints given = subject.landmarks;
    for (int k = 0; k < 68; ++k)
      if (!trial.is_given(k)) given.row(k).setConstant(std::numeric_limits<double>::quiet_NaN());
    const Stopwatch watch;
    const fitting::CodeLandmarkFit fit =
        fitting::FitCodeToLandmarks(model, contour, fitting::PicturedLandmarks(model.face_template(), given), options);
    result.ms += 1e3 * watch.seconds() / double(subjects.size());
    const fitting::PicturePoints shown = fitting::ShownLandmarks(model, contour, fit.code, fit.view);
    double sum = 0;
    int count = 0;
    for (int k = 0; k < 68; ++k) {
      if (!trial.is_scored(k)) continue;
      sum += (shown.row(k) - subject.landmarks.row(k)).norm() / subject.eye_px;
      ++count;
    }
    const double error = sum / count;
    result.mean += error / double(subjects.size());
    if (error > result.worst) result.worst = error, result.worst_name = subject.name;
    result.radius += fit.code.norm() / double(subjects.size());
    result.num_unusual += fit.is_usual ? 0 : 1;
    if (subject.mesh.rows() > 0) {
      const double distance = MeshDistance(subject, model, fit.code);
      result.mesh_mm += distance / double(subjects.size());
      result.worst_mesh_mm = std::max(result.worst_mesh_mm, distance);
    }
    if (each) {
      each(subject, fit);
      const faces::FaceTemplate& face_template = model.face_template();
      const geometry::Points vertices = model.Vertices(fit.code);
      result.flips += geometry::CountFlippedTriangles(face_template.neutral, vertices, face_template.triangles) /
                      double(subjects.size());
      result.intersections +=
          double(geometry::SelfIntersections({vertices, face_template.triangles}).size()) / double(subjects.size());
    }
  }
  return result;
}

/// The picture with its landmarks (green) and those of the fit (red), and the face from the front and the side.
render::Image PictureOf(const fitting::CodeModel& model, const faces::FinishedHead& head, const Subject& subject,
                        const fitting::CodeLandmarkFit& fit) {
  constexpr int kHeight = 300;
  const fitting::PicturePoints shown =
      fitting::ShownLandmarks(model, fitting::ContourPaths(model.face_template()), fit.code, fit.view);
  render::Image image = render::ToRgb(render::ReadImage(subject.picture));
  const double factor = double(kHeight) / image.height;
  image = render::Resize(image, kHeight, int(std::lround(factor * image.width)));
  const auto dot = [&](const Eigen::RowVector2d& at, int radius, const render::Rgb& colour) {
    render::FillRectangle(image, int(factor * at.y()) - radius, int(factor * at.x()) - radius, 2 * radius + 1,
                          2 * radius + 1, colour);
  };
  for (int k = 0; k < 68; ++k) {
    dot(subject.landmarks.row(k), 2, {40, 190, 60});
    dot(shown.row(k), 1, {220, 40, 40});
  }
  const geometry::Points vertices = model.Vertices(fit.code);
  const render::Frame frame = reports::FrameOfFaces({vertices});
  return render::MakeSheet(
      {{image, subject.name}, {reports::FrontView(head, vertices, frame)}, {reports::SideView(head, vertices, frame)}},
      3, {.gap = 2});
}

/// How near the model comes to the meshes by the codes of these.
std::string NearestFaces(const OpenedModel& opened, const std::vector<Subject>& subjects) {
  double mean = 0, worst = 0;
  for (const Subject& subject : subjects) {
    const double distance = MeshDistance(subject, *opened.model, fitting::CodeOfMesh(*opened.model, subject.mesh).code);
    mean += distance / double(subjects.size());
    worst = std::max(worst, distance);
  }
  return fmt::format("{}, {}: codes of the meshes themselves {:.2f} mm (worst {:.2f})\n", opened.name, opened.kind,
                     mean, worst);
}

void Run(const fs::path& pictures, const fs::path& out, const std::vector<fs::path>& folders, double deviation,
         const fs::path& registered) {
  std::vector<Subject> subjects = ReadSubjects(pictures);
  if (!registered.empty()) AddMeshes(registered, subjects);
  MakeDirectory(out);
  std::string table =
      "| model | given | mean, % | worst, % | picture | ms | code's length | beyond usual | flips | intersections | "
      "to the mesh, mm | worst, mm |\n"
      "|---|---|---:|---:|---|---:|---:|---:|---:|---:|---:|---:|\n";
  for (size_t f = 0; f < folders.size(); ++f) {
    const OpenedModel opened = OpenCodeModel(folders[f]);
    const fitting::CodeModel& model = *opened.model;
    const faces::FaceTemplate& face_template = model.face_template();
    const faces::FinishedHead head = reports::HeadOf(reports::SurfaceOf(face_template), face_template.neutral);
    for (const bool adjusts_code : {false, true}) {
      for (const Trial& trial : Trials()) {
        if (!adjusts_code && f > 0) continue;
        const bool is_first = trial.name.starts_with("all");
        const auto each = [&](const Subject& subject, const fitting::CodeLandmarkFit& fit) {
          if (f == 0 && adjusts_code)
            render::WriteImage(out / (subject.name + ".png"), PictureOf(model, head, subject, fit));
        };
        const TrialResult result =
            Measure(model, subjects, trial, {.deviation = deviation, .adjusts_code = adjusts_code},
                    is_first ? each : std::function<void(const Subject&, const fitting::CodeLandmarkFit&)>());
        const std::string row = fmt::format(
            "| {} | {} | {:.2f} | {:.2f} | {} | {:.1f} | {:.1f} of {:.1f} | {} | {:.1f} | {:.1f} | {:.2f} | "
            "{:.2f} |\n",
            adjusts_code ? opened.name + ", " + opened.kind : "mean face, view alone", trial.name, 100 * result.mean,
            100 * result.worst, result.worst_name, result.ms, result.radius, model.usual_radius(), result.num_unusual,
            result.flips, result.intersections, result.mesh_mm, result.worst_mesh_mm);
        fmt::print("{}", row);
        std::fflush(stdout);
        table += row;
      }
    }
    if (registered.empty()) continue;
    const std::string nearest = NearestFaces(opened, subjects);
    fmt::print("{}", nearest);
    table += nearest;
  }
  WriteFileAtomically(out / "table.md", table);
}

}  // namespace
}  // namespace daumier::deform

int main(int argc, char** argv) {
  try {
    std::vector<std::filesystem::path> folders;
    std::filesystem::path registered;
    double deviation = daumier::fitting::CodeLandmarkOptions().deviation;
    for (int i = 3; i < argc; ++i) {
      const std::string word = argv[i];
      if (word.starts_with("deviation=")) {
        deviation = std::stod(word.substr(word.find('=') + 1));
      } else if (word.starts_with("registered=")) {
        registered = word.substr(word.find('=') + 1);
      } else {
        folders.emplace_back(word);
      }
    }
    if (folders.empty())
      throw daumier::UsageError("edit_landmarks PICTURES OUT MODEL... [deviation=SHARE] [registered=FACES]");
    daumier::deform::Run(argv[1], argv[2], folders, deviation, registered);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "edit_landmarks: {}\n", error.what());
    return 1;
  }
}
