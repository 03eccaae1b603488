// Not a benchmark: twenty edits in a row. The figures of docs/results/sketching.md.
//   session_edits WEIGHTS FACES [count [seed]]
// WEIGHTS: of sketches. FACES: a folder of faces of their topology that the network has not seen, of which `count` (40)
// neutral ones are taken. Each edit erases a part of a curve and draws it again: where the face has it, from the mean
// face, exactly or missed; or anywhere, from the face itself.
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/random.h"
#include "core/statistics.h"
#include "core/stopwatch.h"
#include "faces/face_database.h"
#include "geometry/flips.h"
#include "systems/sketch/curve_follower.h"

#include <fmt/core.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace daumier::sketch {
namespace {

constexpr int kNumEdits = 20;

/// How a person edits. Deviations are pixels of 256.
struct EditCase {
  const char* name;
  bool is_towards_face;  ///< From the mean face; else from the face, to anywhere.
  double deviation;
};
constexpr EditCase kEditCases[] = {{"towards another face, exactly", true, 0},
                                   {"towards another face, missed by 1 pixel", true, 1},
                                   {"the same, by 2 pixels", true, 2},
                                   {"of a face, anywhere, by 1 pixel", false, 1},
                                   {"of a face, anywhere, by 3 pixels", false, 3}};

struct EditFigures {
  std::vector<double> flips, folds, agreement_mm, curve_mm, near_mm, near_before_mm, ms;
  int edits = 0, unflipped = 0, wrinkles = 0;
};

/// An interior edge by its triangles.
using TrianglePairs = std::vector<std::pair<int, int>>;

TrianglePairs NeighbouringTriangles(const geometry::Triangles& triangles) {
  std::map<std::pair<int, int>, int> first_of;
  TrianglePairs pairs;
  for (int f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto edge = std::minmax({triangles(f, k), triangles(f, (k + 1) % 3)});
      const auto [known, is_new] = first_of.emplace(std::pair(edge.first, edge.second), f);
      if (!is_new) pairs.emplace_back(known->second, f);
    }
  return pairs;
}

/// The pairs that include less than 30 degrees.
std::vector<size_t> FoldedPairs(const TrianglePairs& pairs, const geometry::Triangles& triangles,
                                const geometry::Points& points) {
  std::vector<Eigen::Vector3d> normals;
  for (const auto& corner : triangles.rowwise()) {
    const Eigen::Vector3d a = points.row(corner[0]), b = points.row(corner[1]), c = points.row(corner[2]);
    normals.push_back((b - a).cross(c - a).normalized());
  }
  std::vector<size_t> folded;
  for (size_t i = 0; i < pairs.size(); ++i)
    if (normals[size_t(pairs[i].first)].dot(normals[size_t(pairs[i].second)]) < -std::cos(M_PI / 6))
      folded.push_back(i);
  return folded;
}

template <class T>
size_t CountNotIn(const std::vector<T>& all, const std::vector<T>& known) {
  return size_t(std::ranges::count_if(all, [&](T one) { return !std::ranges::binary_search(known, one); }));
}

class EditMeasurement {
 public:
  explicit EditMeasurement(std::shared_ptr<const SketchPredictor> predictor)
      : follower_(predictor),
        exact_(predictor, Inference::kFaces, Agreement::kExact),
        face_template_(predictor->run().face_template),
        mm_(faces::MillimetresPerCm(face_template_)),
        pairs_(NeighbouringTriangles(face_template_.triangles)) {
    const std::vector<int>& on_curve = predictor->curves().vertices;
    const geometry::Points& mean = face_template_.neutral;
    for (int v = 0; v < mean.rows(); ++v) {
      if (std::ranges::count(on_curve, v) > 0) continue;
      if (((mean(on_curve, Eigen::all).rowwise() - mean.row(v)).rowwise().norm().minCoeff()) * mm_ <= 20)
        near_.push_back(v);
    }
  }

  size_t num_near() const { return near_.size(); }

  void Measure(const EditCase& edit_case, bool is_exact, const geometry::Points& truth, Rng& rng,
               EditFigures& figures) const {
    const CurveFollower& follower = is_exact ? exact_ : follower_;
    const FollowUpStart start = edit_case.is_towards_face ? follower.Begin(face_template_.neutral, Untouched::kFollow)
                                                          : follower.Begin(truth, Untouched::kStay);
    const SessionLines of_truth = follower.CurvesOf(truth);
    SessionLines lines = follower.CurvesOf(start.vertices);
    geometry::Points face;
    for (int edit = 0; edit < kNumEdits; ++edit) {
      if (!RedrawPart(edit_case, of_truth, lines, rng)) {
        ++figures.wrinkles;
        continue;
      }
      const Stopwatch watch;
      face = follower.Follow(start, lines);
      figures.ms.push_back(1e3 * watch.seconds());
      if (start.untouched == Untouched::kFollow) follower.MoveUntouched(face, lines);
      figures.flips.push_back(double(NewFlips(start, face, follower.Inferred(start, lines))));
      ++figures.edits;
      figures.unflipped += figures.flips.back() == 0;
    }
    if (face.rows() == 0) return;
    figures.folds.push_back(
        double(CountNotIn(FoldedPairs(pairs_, face_template_.triangles, face), Known(start, lines))));
    const SessionLines projected = follower.CurvesOf(face);
    for (size_t c = 0; c < lines.curves.size(); ++c) {
      if (lines.curves[c].drawn == 0) continue;
      for (size_t i = 0; i < lines.curves[c].points.size(); ++i)
        figures.agreement_mm.push_back((projected.curves[c].points[i] - lines.curves[c].points[i]).norm() /
                                       follower.predictor().curves().camera.scale * mm_);
    }
    const auto error = [&](const std::vector<int>& of, const geometry::Points& from) {
      return mm_ * (from(of, Eigen::all) - truth(of, Eigen::all)).rowwise().norm().mean();
    };
    figures.curve_mm.push_back(error(follower.predictor().curves().vertices, face));
    figures.near_mm.push_back(error(near_, face));
    figures.near_before_mm.push_back(error(near_, start.vertices));
  }

 private:
  /// Folded pairs that the start has, or the inferred face.
  std::vector<size_t> Known(const FollowUpStart& start, const SessionLines& lines) const {
    std::vector<size_t> known = FoldedPairs(pairs_, face_template_.triangles, start.vertices);
    const std::vector<size_t> inferred =
        FoldedPairs(pairs_, face_template_.triangles, follower_.Inferred(start, lines));
    known.insert(known.end(), inferred.begin(), inferred.end());
    std::ranges::sort(known);
    return known;
  }

  /// Triangles that are turned over from the start, and not by the inference.
  size_t NewFlips(const FollowUpStart& start, const geometry::Points& face, const geometry::Points& inferred) const {
    const auto flipped = [&](const geometry::Points& after) {
      return geometry::FlippedTriangles(start.vertices, after, face_template_.triangles);
    };
    return CountNotIn(flipped(face), flipped(inferred));
  }

  /// Erases a part of a random curve, a fifth of it to all, and draws it. False if the stroke fills no gap.
  bool RedrawPart(const EditCase& edit_case, const SessionLines& of_truth, SessionLines& lines, Rng& rng) const {
    const size_t c = size_t(rng.Below(lines.curves.size()));
    SessionCurve& curve = lines.curves[c];
    const size_t n = curve.points.size();
    const size_t count = std::clamp(size_t(rng.Uniform(0.2, 1) * double(n)), size_t(2), n);
    size_t first = size_t(rng.Below(n - count + 1)), last = first + count - 1;
    if (curve.closed && (first == 0 || last + 1 == n)) first = 0, last = n - 1;
    curve.gap = CurveGap{first, last};
    const CanvasPoints& from = edit_case.is_towards_face ? of_truth.curves[c].points : curve.points;
    CanvasPoints part(from.begin() + ptrdiff_t(first), from.begin() + ptrdiff_t(last) + 1);
    const double deviation = edit_case.deviation;
    const Eigen::Vector2d shift(deviation * rng.Normal(), deviation * rng.Normal());
    const Eigen::Vector2d bend(deviation * rng.Normal(), deviation * rng.Normal());
    const double phase = rng.Uniform(0, 2 * M_PI);
    for (size_t i = 0; i < part.size(); ++i)
      part[i] += shift + std::sin(2 * M_PI * double(i) / double(part.size()) + phase) * bend;
    if (datasets::LengthOf(part) >= 1 && Draw(lines, part)) return true;
    lines.wrinkles.clear();
    curve.gap.reset();
    return false;
  }

  CurveFollower follower_, exact_;
  const faces::FaceTemplate& face_template_;
  double mm_;
  TrianglePairs pairs_;
  std::vector<int> near_;  ///< Vertices within 20 mm of a curve of the mean face, on none.
};

void PrintEdits(const std::string& name, const EditFigures& figures) {
  fmt::print(
      "| {} | {} | {:.1f} | {:.0f} | {:.1f} | {:.1f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | "
      "{:.1f} |\n",
      name, figures.edits, Mean(figures.flips), *std::ranges::max_element(figures.flips),
      100.0 * figures.unflipped / figures.edits, Mean(figures.folds), Mean(figures.agreement_mm),
      Percentile(figures.agreement_mm, 95), Mean(figures.curve_mm), Mean(figures.near_before_mm), Mean(figures.near_mm),
      Median(figures.ms), Percentile(figures.ms, 95), *std::ranges::max_element(figures.ms));
}

void RunEdits(const std::string& weights, const std::string& faces_folder, int count, uint64_t seed) {
  auto opened = OpenSketchPredictor(weights, {}, {{"framing", "keep"}, {"refine", false}});
  const std::shared_ptr<const SketchPredictor> predictor(dynamic_cast<SketchPredictor*>(opened.release()));
  DAUMIER_CHECK(predictor != nullptr, "{}: no weights of sketches", weights);
  const EditMeasurement measurement(predictor);
  const faces::FaceDatabase database(faces_folder);
  std::vector<int> neutral;
  for (int face = 0; face < database.num_grid_faces(); ++face)
    if (database.id(face).expression == 0) neutral.push_back(face);
  const std::vector<int> chosen = EvenlySpaced(neutral, count);
  fmt::print("{} faces, {} edits of each; {} vertices within 20 mm of a curve and on none\n\n", chosen.size(),
             kNumEdits, measurement.num_near());
  fmt::print(
      "| edits | number | flips, mean | most | none, % | folds | agreement, mm | 95 % | curves, mm | near before | "
      "near, mm | ms | 95 % | most |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const EditCase& edit_case : kEditCases) {
    for (const bool is_exact : {true, false}) {
      EditFigures figures;
      Rng rng = Stream(seed, "edits");
      for (const int index : chosen) measurement.Measure(edit_case, is_exact, database.points(index), rng, figures);
      PrintEdits(fmt::format("{}{}", edit_case.name, is_exact ? ", curves exactly at their lines" : ""), figures);
    }
  }
}

}  // namespace
}  // namespace daumier::sketch

int main(int argc, char** argv) {
  try {
    DAUMIER_CHECK(argc >= 3 && argc <= 5, "expected session_edits WEIGHTS FACES [count [seed]]");
    daumier::sketch::RunEdits(argv[1], argv[2], argc > 3 ? std::stoi(argv[3]) : 40,
                              argc > 4 ? std::stoull(argv[4]) : 1);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "session_edits: {}\n", error.what());
    return 1;
  }
}
