// Not a benchmark: does the network help a person who redraws curves? The figures of docs/results/sketching.md.
//   session_redraws WEIGHTS FACES [count [deviation]]
// WEIGHTS: of sketches. FACES: a folder of faces of their topology that the network has not seen. From the mean neutral face, 1, 2,
// 4, 8 and all curves are replaced by those of each of `count` (200) neutral faces, the one that is farthest from its
// own first; the face that follows is compared with the true one. deviation: by how many pixels of 256 a line is missed.
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/median_time.h"
#include "core/random.h"
#include "core/statistics.h"
#include "core/stopwatch.h"
#include "faces/face_database.h"
#include "geometry/flips.h"
#include "geometry/operators.h"
#include "geometry/pinned_deformation.h"
#include "systems/sketch/curve_follower.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <vector>

namespace daumier::sketch {
namespace {

constexpr int kNumCurves[] = {1, 2, 4, 8, 1000};

/// Ways to make a face of redrawn curves.
struct NamedWay {
  const char* name;
  Inference inference;
  Untouched untouched;
};
constexpr NamedWay kWays[] = {{"deformation alone", Inference::kNone, Untouched::kStay},
                              {"network", Inference::kNetwork, Untouched::kStay},
                              {"network, untouched lines follow", Inference::kNetwork, Untouched::kFollow},
                              {"faces", Inference::kFaces, Untouched::kStay},
                              {"faces, untouched lines follow", Inference::kFaces, Untouched::kFollow}};

struct Errors {
  double mm = 0, depth_mm = 0, curves_mm = 0, flips = 0;
};

struct Way {
  std::string name;
  CurveFollower follower;
  FollowUpStart start;
  std::vector<std::vector<Errors>> errors;  ///< By row, of each face.
};

double DistanceOf(const SessionCurve& a, const SessionCurve& b) {
  double sum = 0;
  for (size_t i = 0; i < a.points.size(); ++i) sum += (a.points[i] - b.points[i]).norm();
  return sum / double(a.points.size());
}

/// Mean over the vertices of the region `face`.
Errors ErrorsOf(const faces::FaceTemplate& face_template, const geometry::Points& face, const geometry::Points& truth,
                const geometry::Points& before) {
  const std::vector<int>& region = RegionFor(face_template.annotation, "face", "errors");
  const geometry::Points difference = face(region, Eigen::all) - truth(region, Eigen::all);
  const double mm = faces::MillimetresPerCm(face_template);
  return {mm * difference.rowwise().norm().mean(), mm * difference.col(2).cwiseAbs().mean(), 0,
          double(geometry::CountFlippedTriangles(before, face, face_template.triangles, region))};
}

/// Mean distance of redrawn lines and the projected curves, mm.
double CurveError(const CurveFollower& follower, const geometry::Points& face, const SessionLines& lines) {
  const SessionLines projected = follower.CurvesOf(face);
  double sum = 0;
  size_t count = 0;
  for (size_t c = 0; c < lines.curves.size(); ++c) {
    if (lines.curves[c].drawn == 0) continue;
    sum += DistanceOf(projected.curves[c], lines.curves[c]) * double(lines.curves[c].points.size());
    count += lines.curves[c].points.size();
  }
  return sum / double(count) / follower.predictor().curves().camera.scale *
         faces::MillimetresPerCm(follower.predictor().run().face_template);
}

std::vector<int> ChosenFaces(const faces::FaceDatabase& database, int count) {
  std::vector<int> neutral;
  for (int face = 0; face < database.num_grid_faces(); ++face)
    if (database.id(face).expression == 0) neutral.push_back(face);
  return EvenlySpaced(neutral, count);
}

/// Rival: deformation of a face by redrawn curves alone, every other vertex free; factorised for each set of curves.
geometry::Points PulledByDrawn(const SketchPredictor& predictor, const geometry::Points& face,
                               const SessionLines& lines) {
  const fitting::ProjectedCurves& curves = predictor.curves();
  const faces::FaceTemplate& face_template = predictor.run().face_template;
  const geometry::Points seen = render::Project(curves.camera, face);
  std::vector<int> pins;
  std::vector<Eigen::RowVector3d> moves;
  size_t point = 0;
  for (const SessionCurve& curve : lines.curves) {
    for (const Eigen::Vector2d& target : curve.points) {
      const int vertex = curves.vertices[point++];
      if (curve.drawn == 0 || std::ranges::count(pins, vertex) > 0) continue;
      Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
      in_camera.head<2>() = (target - seen.row(vertex).head<2>().transpose()) / curves.camera.scale;
      pins.push_back(vertex);
      moves.push_back((curves.camera.camera_from_world.transpose() * in_camera).transpose());
    }
  }
  geometry::Points of_pins(std::ssize(moves), 3);
  for (size_t i = 0; i < moves.size(); ++i) of_pins.row(Eigen::Index(i)) = moves[i];
  const geometry::PinnedDeformation deformation(
      geometry::UniformLaplacian(face_template.triangles, face_template.num_vertices()), std::move(pins));
  return face + deformation.Solve(of_pins);
}

/// The line as a person draws it, who misses it by about `deviation` pixels: shifted, and bent by one wave.
CanvasPoints Missed(CanvasPoints line, double deviation, Rng& rng) {
  const Eigen::Vector2d shift(deviation * rng.Normal(), deviation * rng.Normal());
  const Eigen::Vector2d bend(deviation * rng.Normal(), deviation * rng.Normal());
  const double phase = rng.Uniform(0, 2 * M_PI);
  for (size_t i = 0; i < line.size(); ++i)
    line[i] += shift + std::sin(2 * M_PI * double(i) / double(line.size()) + phase) * bend;
  return line;
}

void Run(const std::string& weights, const std::string& faces_folder, int count, double deviation) {
  auto opened = OpenSketchPredictor(weights, {}, {{"framing", "keep"}, {"refine", false}});
  const std::shared_ptr<const SketchPredictor> predictor(dynamic_cast<SketchPredictor*>(opened.release()));
  DAUMIER_CHECK(predictor != nullptr, "{}: no weights of sketches", weights);
  const faces::FaceTemplate& face_template = predictor->run().face_template;
  const Stopwatch watch;
  const CurveFollower follower(predictor);
  fmt::print("first factorisation: {:.0f} ms\n", 1e3 * watch.seconds());
  const faces::FaceDatabase database(faces_folder);
  const geometry::Points& mean = face_template.neutral;
  const SessionLines of_mean = follower.CurvesOf(mean);

  const size_t num_rows = std::size(kNumCurves);
  std::vector<Way> ways;
  for (const NamedWay& named : kWays) {
    CurveFollower of_way(predictor, named.inference);
    FollowUpStart start = of_way.Begin(mean, named.untouched);
    ways.push_back({named.name, std::move(of_way), std::move(start), std::vector<std::vector<Errors>>(num_rows)});
    const Way& way = ways.back();
    SessionLines edited = of_mean;
    edited.curves.front().drawn = 1;
    fmt::print("{}: {:.1f} ms an edit\n", way.name, MedianMs([&] { way.follower.Follow(way.start, edited); }));
  }

  std::vector<double> untouched;
  std::vector<std::vector<Errors>> free(num_rows);
  Rng rng = Stream(1, "redraws");
  for (const int index : ChosenFaces(database, count)) {
    const geometry::Points truth = database.points(index);
    const SessionLines of_truth = follower.CurvesOf(truth);
    std::vector<size_t> order(of_mean.curves.size());
    for (size_t c = 0; c < order.size(); ++c) order[c] = c;
    std::ranges::stable_sort(order, std::ranges::greater(),
                             [&](size_t c) { return DistanceOf(of_mean.curves[c], of_truth.curves[c]); });
    untouched.push_back(ErrorsOf(face_template, mean, truth, mean).mm);
    SessionLines lines = of_mean;
    size_t num_drawn = 0;
    for (size_t row = 0; row < num_rows; ++row) {
      for (; num_drawn < std::min(order.size(), size_t(kNumCurves[row])); ++num_drawn) {
        SessionCurve& curve = lines.curves[order[num_drawn]];
        curve.points = Missed(of_truth.curves[order[num_drawn]].points, deviation, rng);
        curve.drawn = ++lines.num_drawn;
      }
      free[row].push_back(ErrorsOf(face_template, PulledByDrawn(*predictor, mean, lines), truth, mean));
      for (Way& way : ways) {
        const geometry::Points followed = way.follower.Follow(way.start, lines);
        way.errors[row].push_back(ErrorsOf(face_template, followed, truth, mean));
        way.errors[row].back().curves_mm = CurveError(follower, followed, lines);
      }
    }
  }
  const auto mean_of = [](const std::vector<Errors>& errors, double Errors::*value) {
    double sum = 0;
    for (const Errors& one : errors) sum += one.*value;
    return sum / double(errors.size());
  };
  fmt::print("{} faces; nothing redrawn: {:.2f} mm\n\n", untouched.size(), Mean(untouched));
  fmt::print(
      "| way | curves redrawn | mm | ratio | depth, mm | drawn curves from lines, mm | flips a face |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n");
  const auto print = [&](const std::string& name, const std::vector<std::vector<Errors>>& by_row) {
    for (size_t row = 0; row < num_rows; ++row) {
      const double mm = mean_of(by_row[row], &Errors::mm);
      fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {:.1f} |\n", name,
                 std::min(size_t(kNumCurves[row]), of_mean.curves.size()), mm,
                 mm / mean_of(ways.front().errors[row], &Errors::mm), mean_of(by_row[row], &Errors::depth_mm),
                 mean_of(by_row[row], &Errors::curves_mm), mean_of(by_row[row], &Errors::flips));
    }
  };
  for (const Way& way : ways) print(way.name, way.errors);
  print("deformation alone, untouched lines free", free);
}

}  // namespace
}  // namespace daumier::sketch

int main(int argc, char** argv) {
  try {
    DAUMIER_CHECK(argc >= 3 && argc <= 5, "expected session_redraws WEIGHTS FACES [count [deviation]]");
    daumier::sketch::Run(argv[1], argv[2], argc > 3 ? std::stoi(argv[3]) : 200, argc > 4 ? std::stod(argv[4]) : 0);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "session_redraws: {}\n", error.what());
    return 1;
  }
}
