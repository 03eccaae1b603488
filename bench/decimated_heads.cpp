// How far heads of fewer triangles (rig::Decimated) are from the full ones, and those of plain edge collapses by the neutral pose alone:
//   decimated_heads SOURCE PATH [PERSONS [PICTURE [TARGETS]]]
// SOURCE is ict or makehuman, PATH as source.path. The heads are PERSONS (3) random persons and as many caricatures of level 4 (seed 1).
// The distance from vertices of skin and lid rims of the full head to the decimated surface, mm at 200 mm from chin to hairline: of all
// in the neutral pose, mean and greatest; and of those that a target moves by more than 1 mm in the pose of that target at weight 1, mean
// and greatest, of these median and worst over the targets. *Folds*: edges between triangles that turn by more than 120 degrees against
// each other, less those of the full head, at most over the poses. PICTURE: the first person at all sizes. TARGETS: also a row a target.
#include "bench/expression_subject.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "geometry/normals.h"
#include "geometry/topology.h"
#include "geometry/triangle_tree.h"
#include "render/sheet.h"
#include "reports/rigged_head.h"
#include "rig/decimated_head.h"
#include "rig/head_pose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

namespace daumier {
namespace {

struct PoseError {
  double mean = 0, greatest = 0;
  int num_folded = 0;
};

geometry::TriangleMesh PosedMesh(const rig::RiggedHead& head, int target) {
  geometry::TriangleMesh mesh{head.mesh.vertices, head.mesh.triangles};
  if (target < 0) return mesh;
  const Eigen::VectorXd offset = head.targets.offsets.col(target).cast<double>();
  Eigen::Map<Eigen::VectorXd>(mesh.vertices.data(), mesh.vertices.size()) += offset;
  return mesh;
}

int NumFolds(const geometry::TriangleMesh& mesh) {
  const geometry::Points normals = geometry::TriangleNormals(mesh);
  std::map<std::pair<int, int>, int> open;
  int num_folds = 0;
  for (int f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [entry, is_new] =
          open.try_emplace(std::minmax({mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)}), f);
      if (!is_new && normals.row(f).dot(normals.row(entry->second)) < -0.5) ++num_folds;
    }
  return num_folds;
}

PoseError ErrorOf(const rig::RiggedHead& full, const rig::RiggedHead& fewer, int target, double mm) {
  const geometry::TriangleMesh truth = PosedMesh(full, target), mesh = PosedMesh(fewer, target);
  const geometry::TriangleTree tree(mesh);
  std::vector<bool> is_used(size_t(truth.vertices.rows()), false);
  for (Eigen::Index f = 0; f < truth.triangles.rows(); ++f) {
    const faces::HeadMaterial material = full.materials[size_t(f)];
    if (material != faces::HeadMaterial::kSkin && material != faces::HeadMaterial::kLidRim) continue;
    for (const int v : truth.triangles.row(f)) is_used[size_t(v)] = true;
  }
  PoseError error;
  int count = 0;
  for (Eigen::Index v = 0; v < truth.vertices.rows(); ++v) {
    if (!is_used[size_t(v)]) continue;
    const double distance = mm * tree.Closest(truth.vertices.row(v)).distance;
    if (target >= 0 && mm * full.targets.offsets.col(target).segment<3>(3 * v).norm() < 1) continue;
    error.greatest = std::max(error.greatest, distance);
    error.mean += distance;
    ++count;
  }
  error.mean /= std::max(count, 1);
  error.num_folded = NumFolds(mesh) - NumFolds(truth);
  return error;
}

double MedianOf(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

void Measure(const std::string& name, const rig::RiggedHead& head, double mm, bool all_rows) {
  for (const int num_triangles : {8000, 4000, 2000}) {
    for (const auto poses : {rig::DecimatedPoses::kAll, rig::DecimatedPoses::kNeutral}) {
      const Stopwatch watch;
      const rig::DecimatedHead fewer = rig::Decimated(head, num_triangles, poses);
      const double seconds = watch.seconds();
      const int num_targets = head.targets.num_targets();
      std::vector<PoseError> errors(size_t(num_targets) + 1);
      OnAllCores(num_targets + 1, [&](int64_t i) { errors[size_t(i)] = ErrorOf(head, fewer.head, int(i) - 1, mm); });
      std::vector<double> means, greatest;
      int num_folded = errors[0].num_folded;
      for (size_t t = 1; t < errors.size(); ++t) {
        means.push_back(errors[t].mean);
        greatest.push_back(errors[t].greatest);
        num_folded = std::max(num_folded, errors[t].num_folded);
      }
      const auto worst = std::ranges::max_element(greatest) - greatest.begin();
      fmt::print(
          "{:<14} {:>6} {:>6} {:<8} {:6.3f} {:6.3f}  {:6.3f} {:6.3f}  {:6.3f} {:6.3f} {:<18} {:5.1f} {:>5} {:5.2f}\n",
          name, fewer.num_triangles_before, fewer.num_triangles, poses == rig::DecimatedPoses::kAll ? "all" : "neutral",
          errors[0].mean, errors[0].greatest, MedianOf(means), std::ranges::max(means), MedianOf(greatest),
          std::ranges::max(greatest), head.targets.names[size_t(worst)], 100 * fewer.greatest_peak_loss, num_folded,
          seconds);
      if (!all_rows) continue;
      for (int t = 0; t < num_targets; ++t)
        fmt::print("  {:<24} {:6.3f} {:6.3f} {:>5}\n", head.targets.names[size_t(t)], errors[size_t(t) + 1].mean,
                   errors[size_t(t) + 1].greatest, errors[size_t(t) + 1].num_folded);
    }
  }
}

/// A row a size: the head, with open mouth, closed eyes and a smile.
void WritePicture(const std::string& file, const rig::RiggedHead& head) {
  std::vector<render::SheetCell> cells;
  std::vector<std::string> rows;
  const auto add = [&](const std::string& name, const rig::RiggedHead& shown) {
    rows.push_back(name);
    const reports::RiggedHeadPictures pictures(shown);
    const auto draw = [&](std::initializer_list<std::pair<std::string_view, float>> weights, double yaw) {
      cells.push_back({pictures.Draw(rig::PoseNamed(shown.targets.names, weights), 260, yaw)});
    };
    draw({}, 0);
    draw({}, 60);
    draw({{"jawOpen", 1.0f}}, -20);
    draw({{"eyeBlinkLeft", 1.0f}, {"eyeBlinkRight", 1.0f}}, 0);
    draw({{"mouthSmileLeft", 1.0f}, {"mouthSmileRight", 1.0f}}, 20);
  };
  add(fmt::format("{}", rig::NumTriangles(head)), head);
  for (const int num_triangles : {8000, 4000, 2000})
    add(fmt::format("{}", num_triangles), rig::Decimated(head, num_triangles).head);
  add("2000, neutral", rig::Decimated(head, 2000, rig::DecimatedPoses::kNeutral).head);
  render::WriteImage(file, render::MakeSheet(cells, 5,
                                             {.column_titles = {"neutral", "", "jawOpen", "eyeBlink*", "mouthSmile*"},
                                              .row_titles = rows}));
}

int Run(const std::vector<std::string>& words) {
  if (words.size() < 2) throw UsageError("decimated_heads SOURCE PATH [PERSONS [PICTURE [TARGETS]]]");
  const ExpressionSubject subject({.name = words[0], .path = words[1]});
  const int num_persons = words.size() > 2 ? std::stoi(words[2]) : 3;
  const bool all_rows = words.size() > 4;
  fmt::print("{:<14} {:>6} {:>6} {:<8} {:>6} {:>6}  {:>6} {:>6}  {:>6} {:>6} {:<18} {:>5} {:>5} {:>5}\n", "mm",
             "before", "after", "poses", "mean", "most", "moved", "worst", "most", "worst", "worst target", "peak%",
             "folds", "s");
  const double mm = faces::MillimetresPerCm(subject.model().face_template);
  for (int i = 0; i < num_persons; ++i) {
    for (const bool is_caricature : {false, true}) {
      const geometry::Points face = is_caricature ? subject.Caricature(i) : subject.Person(i);
      const rig::RiggedHead head = subject.head_rig().On(face, subject.expressions().On(face));
      if (i == 0 && !is_caricature && words.size() > 3) WritePicture(words[3], head);
      Measure(fmt::format("{} {}", is_caricature ? "caricature" : "person", i), head, mm, all_rows);
    }
  }
  return 0;
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  try {
    return daumier::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
