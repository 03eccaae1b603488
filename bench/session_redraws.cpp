// Not a benchmark: does the network help a person who redraws curves? The figures of docs/results/sketching.md.
//   session_redraws WEIGHTS FACES OUT [count]
// WEIGHTS: of sketches. FACES: a folder of faces of their topology that the network has not seen. From the mean neutral face, 1, 2,
// 4, 8 and all curves are replaced by those of each of `count` (200) neutral faces, the one that is farthest from its
// own first, as three hands draw them; the face that follows is compared with the true one. OUT/redraws.svg: errors by curves.
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/random.h"
#include "core/statistics.h"
#include "datasets/read/augmentation.h"
#include "faces/face_database.h"
#include "geometry/flips.h"
#include "geometry/operators.h"
#include "geometry/pinned_deformation.h"
#include "reports/curve_chart.h"
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

/// How lines are drawn that have to be those of a face.
struct NamedHand {
  const char* name;
  double deviation;   ///< By about how many pixels of 256 a line is missed: shifted, and bent by one wave.
  bool is_augmented;  ///< As in training: strokes are bent one by one and all together, and tremble.
};
constexpr NamedHand kHands[] = {{"exact", 0, false}, {"missed by 2 pixels", 2, false}, {"augmented", 0, true}};

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

CanvasPoints Missed(CanvasPoints line, double deviation, Rng& rng) {
  const Eigen::Vector2d shift(deviation * rng.Normal(), deviation * rng.Normal());
  const Eigen::Vector2d bend(deviation * rng.Normal(), deviation * rng.Normal());
  const double phase = rng.Uniform(0, 2 * M_PI);
  for (size_t i = 0; i < line.size(); ++i)
    line[i] += shift + std::sin(2 * M_PI * double(i) / double(line.size()) + phase) * bend;
  return line;
}

/// All that augmentation does to lines, but what leaves out, cuts or repeats them, or moves the whole sheet, on which a
/// person sees the other lines.
void AugmentLines(std::vector<CanvasPoints>& lines, Rng& rng) {
  std::vector<render::Stroke> strokes(lines.size());
  for (size_t i = 0; i < lines.size(); ++i)
    for (const Eigen::Vector2d& point : lines[i]) strokes[i].points.push_back({float(point.x()), float(point.y())});
  const datasets::AugmentationOptions options{
      .strength = 1, .removal = 0, .retrace = 0, .gaps = 0, .shift_px = 0, .scale = 0, .rotation_degrees = 0};
  const datasets::AugmentedSketch augmented = datasets::Augment(strokes, options, rng);
  for (size_t i = 0; i < lines.size(); ++i)
    for (size_t k = 0; k < lines[i].size(); ++k)
      lines[i][k] = {augmented.moved[i].points[k][0], augmented.moved[i].points[k][1]};
}

std::vector<CanvasPoints> DrawnBy(const NamedHand& hand, std::vector<CanvasPoints> lines, Rng& rng) {
  for (CanvasPoints& line : lines) line = Missed(line, hand.deviation, rng);
  if (hand.is_augmented && !lines.empty()) AugmentLines(lines, rng);
  return lines;
}

struct Measured {
  std::vector<Way> ways;
  std::vector<std::vector<Errors>> free;  ///< Of deformation alone, untouched lines free.
};

double MeanOf(const std::vector<Errors>& errors, double Errors::*value) {
  double sum = 0;
  for (const Errors& one : errors) sum += one.*value;
  return sum / double(errors.size());
}

class Redrawing {
 public:
  Redrawing(std::shared_ptr<const SketchPredictor> predictor, const std::string& faces, int count)
      : predictor_(std::move(predictor)),
        follower_(predictor_),
        face_template_(predictor_->run().face_template),
        of_mean_(follower_.CurvesOf(face_template_.neutral)) {
    const faces::FaceDatabase database(faces);
    for (const int index : ChosenFaces(database, count)) truths_.push_back(database.points(index));
    for (const geometry::Points& truth : truths_)
      untouched_.push_back(ErrorsOf(face_template_, face_template_.neutral, truth, face_template_.neutral).mm);
  }

  int num_faces() const { return int(truths_.size()); }
  double untouched_mm() const { return Mean(untouched_); }
  size_t NumCurves(size_t row) const { return std::min(size_t(kNumCurves[row]), of_mean_.curves.size()); }

  Measured Measure(const NamedHand& hand) const {
    const size_t num_rows = std::size(kNumCurves);
    Measured measured{MakeWays(), std::vector<std::vector<Errors>>(num_rows)};
    Rng rng = Stream(1, "redraws");
    for (const geometry::Points& truth : truths_) {
      const SessionLines of_truth = follower_.CurvesOf(truth);
      const std::vector<size_t> order = FarthestFirst(of_truth);
      SessionLines lines = of_mean_;
      for (size_t row = 0; row < num_rows; ++row) {
        Redraw(hand, of_truth, order, NumCurves(row), lines, rng);
        measured.free[row].push_back(ErrorsOf(face_template_, PulledByDrawn(*predictor_, face_template_.neutral, lines),
                                              truth, face_template_.neutral));
        for (Way& way : measured.ways) {
          const geometry::Points followed = way.follower.Follow(way.start, lines);
          way.errors[row].push_back(ErrorsOf(face_template_, followed, truth, face_template_.neutral));
          way.errors[row].back().curves_mm = CurveError(follower_, followed, lines);
        }
      }
    }
    return measured;
  }

 private:
  std::vector<Way> MakeWays() const {
    std::vector<Way> ways;
    for (const NamedWay& named : kWays) {
      CurveFollower of_way(predictor_, named.inference);
      FollowUpStart start = of_way.Begin(face_template_.neutral, named.untouched);
      ways.push_back(
          {named.name, std::move(of_way), std::move(start), std::vector<std::vector<Errors>>(std::size(kNumCurves))});
    }
    return ways;
  }
  std::vector<size_t> FarthestFirst(const SessionLines& of_truth) const {
    std::vector<size_t> order(of_mean_.curves.size());
    for (size_t c = 0; c < order.size(); ++c) order[c] = c;
    std::ranges::stable_sort(order, std::ranges::greater(),
                             [&](size_t c) { return DistanceOf(of_mean_.curves[c], of_truth.curves[c]); });
    return order;
  }
  /// Up to `count` curves, those that are not yet.
  static void Redraw(const NamedHand& hand, const SessionLines& of_truth, const std::vector<size_t>& order,
                     size_t count, SessionLines& lines, Rng& rng) {
    const auto first = size_t(lines.num_drawn);
    std::vector<CanvasPoints> targets;
    for (size_t i = first; i < count; ++i) targets.push_back(of_truth.curves[order[i]].points);
    targets = DrawnBy(hand, std::move(targets), rng);
    for (size_t i = first; i < count; ++i) {
      lines.curves[order[i]].points = targets[i - first];
      lines.curves[order[i]].drawn = ++lines.num_drawn;
    }
  }

  std::shared_ptr<const SketchPredictor> predictor_;
  CurveFollower follower_;
  const faces::FaceTemplate& face_template_;
  SessionLines of_mean_;
  std::vector<geometry::Points> truths_;
  std::vector<double> untouched_;
};

void PrintRows(const Redrawing& redrawing, const std::string& name, const std::vector<std::vector<Errors>>& by_row,
               const Way& rival) {
  for (size_t row = 0; row < by_row.size(); ++row) {
    const double mm = MeanOf(by_row[row], &Errors::mm);
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | {:.1f} |\n", name, redrawing.NumCurves(row), mm,
               mm / MeanOf(rival.errors[row], &Errors::mm), MeanOf(by_row[row], &Errors::depth_mm),
               MeanOf(by_row[row], &Errors::curves_mm), MeanOf(by_row[row], &Errors::flips));
  }
}

reports::ChartCurve CurveOf(const Redrawing& redrawing, const Way& way) {
  reports::ChartCurve curve{way.name, {}, {}};
  for (size_t row = 0; row < way.errors.size(); ++row) {
    curve.x.push_back(double(redrawing.NumCurves(row)));
    curve.y.push_back(MeanOf(way.errors[row], &Errors::mm));
  }
  return curve;
}

void Run(const std::string& weights, const std::string& faces_folder, const std::filesystem::path& out, int count) {
  auto opened = OpenSketchPredictor(weights, {}, {{"framing", "keep"}, {"refine", false}});
  const std::shared_ptr<const SketchPredictor> predictor(dynamic_cast<SketchPredictor*>(opened.release()));
  DAUMIER_CHECK(predictor != nullptr, "{}: no weights of sketches", weights);
  const Redrawing redrawing(predictor, faces_folder, count);
  fmt::print("{} faces; nothing redrawn: {:.2f} mm\n", redrawing.num_faces(), redrawing.untouched_mm());
  std::vector<reports::CurvePanel> panels;
  for (const NamedHand& hand : kHands) {
    const Measured measured = redrawing.Measure(hand);
    fmt::print(
        "\n{}:\n\n| way | curves redrawn | mm | ratio | depth, mm | drawn curves from lines, mm | flips a face |\n"
        "|---|---:|---:|---:|---:|---:|---:|\n",
        hand.name);
    reports::CurvePanel& panel = panels.emplace_back(reports::CurvePanel{hand.name, {}});
    for (const Way& way : measured.ways) {
      PrintRows(redrawing, way.name, way.errors, measured.ways.front());
      panel.curves.push_back(CurveOf(redrawing, way));
    }
    PrintRows(redrawing, "deformation alone, untouched lines free", measured.free, measured.ways.front());
    const double untouched = redrawing.untouched_mm();
    panel.curves.push_back(
        {"nothing redrawn", panel.curves.front().x, std::vector<double>(panel.curves.front().x.size(), untouched)});
  }
  std::filesystem::create_directories(out);
  WriteFileAtomically(out / "redraws.svg", reports::CurveChartSvg(panels, "Error of the face by redrawn curves",
                                                                  "curves redrawn", "mm on a face of 200 mm"));
}

}  // namespace
}  // namespace daumier::sketch

int main(int argc, char** argv) {
  try {
    DAUMIER_CHECK(argc == 4 || argc == 5, "expected session_redraws WEIGHTS FACES OUT [count]");
    daumier::sketch::Run(argv[1], argv[2], argv[3], argc > 4 ? std::stoi(argv[4]) : 200);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "session_redraws: {}\n", error.what());
    return 1;
  }
}
