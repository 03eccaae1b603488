// Errors of heads of other topologies that are rigged, where the truth is known:
//   rig_transfer SOURCE PATH [PERSONS [OTHER_SOURCE OTHER_PATH]]
// SOURCE is ict or makehuman, PATH as source.path. The heads are PERSONS (3) random persons of that source (seed 1), with
// other vertices: shuffled and split, subdivided, decimated to a half and to a fifth. The template is registered onto each by
// its landmarks; targets are carried by rig::ForeignRig, and plainly from the nearest vertex of the registered template.
// The truth is rig::ExpressionTargets of the person. A row a head: median over the targets of the mean error (of vertices
// that move by more than 0.1 mm) and of the greatest one, and vertices that were taken for the other side of their slit,
// without those around its corners, where sides meet (testing::SidesApart). Two more heads of each person have sealed lips, a
// strip of triangles from lip to lip, and are subdivided: as they are, and cut (ForeignRig::Open). Then a row a target, over
// the heads with open lips. With another source: the sides on its mean head.
#include "bench/expression_subject.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "datasets/build/registered_faces.h"
#include "geometry/nearest.h"
#include "rig/arkit_names.h"
#include "rig/foreign_head.h"
#include "tests/support/other_topology.h"
#include "tests/support/sealed_slit.h"
#include "tests/support/sides_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace daumier {
namespace {

enum class Lips { kOpen, kSealed, kCut };

/// How far carried targets are from the truth, mm.
struct TransferError {
  std::vector<double> mean, greatest;  ///< Over vertices that move by more than 0.1 mm; one a target that has any.
  std::vector<std::string> names;      ///< Of these targets.
  int num_wrong = 0;
  std::string worst;
};

double MedianOf(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

/// sides: of the vertices; places halfway between two sides of a slit have no truth.
TransferError ErrorsOf(const rig::MorphTargets& truth, const testing::OtherTopology& other,
                       const std::vector<rig::FaceSide>& sides, const Eigen::MatrixXf& carried, double mm) {
  constexpr double kMoves = 0.01;  // cm
  TransferError error;
  double worst = 0;
  for (Eigen::Index t = 0; t < carried.cols(); ++t) {
    double sum = 0, greatest = 0;
    int count = 0;
    for (size_t v = 0; v < other.sources.size(); ++v) {
      const auto [a, b] = other.sources[v];
      if (sides[size_t(a)] != rig::FaceSide::kNone && sides[size_t(a)] == rig::OppositeSide(sides[size_t(b)])) continue;
      const Eigen::Vector3f expected =
          0.5f * (truth.offsets.col(t).segment<3>(3 * a) + truth.offsets.col(t).segment<3>(3 * b));
      const double off = (carried.col(t).segment<3>(3 * Eigen::Index(v)) - expected).norm();
      greatest = std::max(greatest, off);
      if (expected.norm() < kMoves) continue;
      sum += off;
      ++count;
    }
    if (count == 0) continue;
    error.mean.push_back(mm * sum / count);
    error.greatest.push_back(mm * greatest);
    error.names.push_back(truth.names[size_t(t)]);
    if (mm * greatest > worst) {
      worst = mm * greatest;
      error.worst = truth.names[size_t(t)];
    }
  }
  return error;
}

class TransferBench {
 public:
  explicit TransferBench(const faces::SourceOptions& source)
      : subject_(source),
        rig_(subject_.model()),
        slits_(rig::SlitsOf(subject_.expressions().contact())),
        sides_(rig::SidesOfTemplate({face().neutral, face().triangles}, slits_)),
        true_sides_(testing::SidesApart({face().neutral, face().triangles}, slits_, sides_)) {}

  void Measure(const std::string& name, int person, const testing::OtherTopology& other, Lips lips = Lips::kOpen) {
    const geometry::Points neutral = subject_.Person(person);
    const rig::MorphTargets truth = subject_.expressions().On(neutral);
    const geometry::TriangleMesh head{other.Vertices(neutral), other.triangles};
    datasets::LandmarkedMesh mesh{.name = name, .landmark_file = name, .mesh = head, .landmarks = {}, .shifted = {}};
    for (size_t l = 0; l < mesh.landmarks.size(); ++l)
      mesh.landmarks[l] = neutral.row(face().annotation.landmarks[l]).transpose();
    const Stopwatch watch;
    const datasets::RegisteredMesh registered = datasets::RegisterMesh(face(), mesh);
    const double seconds_registering = watch.seconds();
    const rig::RegisteredTemplate on_head{registered.vertices, registered.template_from_target};
    const rig::ForeignHead rigged = rig_.On(lips == Lips::kCut ? rig_.Open(head, on_head).mesh : head, on_head);
    const double seconds = watch.seconds();

    const double mm = faces::MillimetresPerCm(face());
    TransferError own = ErrorsOf(truth, other, sides_, rigged.head.targets.offsets, mm);
    for (size_t v = 0; v < other.sources.size(); ++v) own.num_wrong += IsWrong(other.sources[v], rigged.sides[v]);
    TransferError plain = PlainErrors(registered, truth, other, head, mm);
    if (lips == Lips::kOpen) {
      AddByTarget(own, &ByTarget::own);
      AddByTarget(plain, &ByTarget::plain);
    }
    fmt::print("{:<28} {:>7} {:>8.3f} {:>8.3f} {:>6} {:<18} {:>8.3f} {:>8.3f} {:>6}  {:5.1f} {:5.1f}\n", name,
               head.vertices.rows(), MedianOf(own.mean), MedianOf(own.greatest), own.num_wrong, own.worst,
               MedianOf(plain.mean), MedianOf(plain.greatest), plain.num_wrong, seconds_registering,
               seconds - seconds_registering);
  }

  /// Each target: means over the heads of the mean error, and the greatest error of all heads.
  void PrintTargets() const {
    fmt::print("\n{:<22} {:>8} {:>8} {:>8} {:>8}\n", "target, mm", "mean", "plain", "greatest", "plain");
    for (const std::string_view word : rig::ArkitNames()) {
      const std::string name(word);
      const auto found = by_target_.find(name);
      if (found == by_target_.end()) continue;
      const auto& [own, plain] = found->second;
      fmt::print("{:<22} {:>8.3f} {:>8.3f} {:>8.2f} {:>8.2f}\n", name, own.sum / own.count, plain.sum / plain.count,
                 own.greatest, plain.greatest);
    }
  }

  /// Sides alone, on the mean head of another source.
  void MeasureSides(const faces::SourceOptions& source) {
    const faces::FaceModel other = faces::LoadFaceModel(source);
    const faces::FaceTemplate& head = other.face_template;
    const geometry::TriangleMesh surface{head.neutral, head.triangles};
    const rig::FaceSlits slits = rig::SlitsOf(rig::ExpressionTargets(other).contact());
    const std::vector<rig::FaceSide> truth = testing::SidesApart(surface, slits, rig::SidesOfTemplate(surface, slits));
    datasets::LandmarkedMesh mesh{
        .name = source.name, .landmark_file = source.name, .mesh = surface, .landmarks = {}, .shifted = {}};
    for (size_t l = 0; l < mesh.landmarks.size(); ++l)
      mesh.landmarks[l] = head.neutral.row(head.annotation.landmarks[l]).transpose();
    const datasets::RegisteredMesh registered = datasets::RegisterMesh(face(), mesh);
    const rig::ForeignHead rigged = rig_.On(surface, {registered.vertices, registered.template_from_target});
    const geometry::VertexTree tree(registered.vertices);
    const geometry::Points places = registered.template_from_target.Apply(head.neutral);
    int num_wrong = 0, num_plain = 0, num_sided = 0;
    for (size_t v = 0; v < truth.size(); ++v) {
      if (truth[v] == rig::FaceSide::kNone) continue;
      const int nearest = tree.Nearest(places.row(Eigen::Index(v))).vertex;
      ++num_sided;
      num_wrong += rigged.sides[v] == rig::OppositeSide(truth[v]) ? 1 : 0;
      num_plain += sides_[size_t(nearest)] == rig::OppositeSide(truth[v]) ? 1 : 0;
    }
    fmt::print("{}: {} of {} vertices at slits on the wrong side, by the nearest vertex {}\n", source.name, num_wrong,
               num_sided, num_plain);
  }

  /// The template's triangles and a strip from lip to lip.
  geometry::Triangles SealedTriangles() const {
    geometry::TriangleMesh mesh{face().neutral, face().triangles};
    testing::Seal(slits_[size_t(rig::FaceSlit::kMouth)], mesh);
    return mesh.triangles;
  }

  const faces::FaceTemplate& face() const { return subject_.model().face_template; }

 private:
  struct Sum {
    double sum = 0, greatest = 0;
    int count = 0;
  };
  struct ByTarget {
    Sum own, plain;
  };

  void AddByTarget(const TransferError& error, Sum ByTarget::*which) {
    for (size_t i = 0; i < error.names.size(); ++i) {
      Sum& sum = by_target_[error.names[i]].*which;
      sum.sum += error.mean[i];
      sum.greatest = std::max(sum.greatest, error.greatest[i]);
      ++sum.count;
    }
  }

  bool IsWrong(const std::pair<int, int>& source, rig::FaceSide side) const {
    const rig::FaceSide a = true_sides_[size_t(source.first)], b = true_sides_[size_t(source.second)];
    return a == b && a != rig::FaceSide::kNone && side == rig::OppositeSide(a);
  }

  TransferError PlainErrors(const datasets::RegisteredMesh& registered, const rig::MorphTargets& truth,
                            const testing::OtherTopology& other, const geometry::TriangleMesh& head, double mm) const {
    const rig::MorphTargets targets = subject_.expressions().On(registered.vertices);
    const geometry::VertexTree tree(registered.vertices);
    const geometry::Points places = registered.template_from_target.Apply(head.vertices);
    const Eigen::Matrix3f back =
        (registered.template_from_target.rotation.transpose() / registered.template_from_target.scale).cast<float>();
    Eigen::MatrixXf carried(3 * head.vertices.rows(), targets.offsets.cols());
    int num_wrong = 0;
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
      const int nearest = tree.Nearest(places.row(v)).vertex;
      num_wrong += IsWrong(other.sources[size_t(v)], sides_[size_t(nearest)]);
      carried.middleRows(3 * v, 3) = back * targets.offsets.middleRows(3 * Eigen::Index(nearest), 3);
    }
    TransferError error = ErrorsOf(truth, other, sides_, carried, mm);
    error.num_wrong = num_wrong;
    return error;
  }

  ExpressionSubject subject_;
  rig::ForeignRig rig_;
  rig::FaceSlits slits_;
  std::vector<rig::FaceSide> sides_, true_sides_;
  std::map<std::string, ByTarget> by_target_;
};

int Run(const std::vector<std::string>& words) {
  if (words.size() < 2) throw UsageError("rig_transfer SOURCE PATH [PERSONS [OTHER_SOURCE OTHER_PATH]]");
  TransferBench bench({.name = words[0], .path = words[1]});
  const int num_persons = words.size() > 2 ? std::stoi(words[2]) : 3;
  const geometry::Triangles& triangles = bench.face().triangles;
  const int num_vertices = bench.face().num_vertices();
  fmt::print("{:<28} {:>7} {:>8} {:>8} {:>6} {:<18} {:>8} {:>8} {:>6}  {:>5} {:>5}\n", "mm", "V", "mean", "greatest",
             "wrong", "worst target", "plain", "greatest", "wrong", "s reg", "s rig");
  for (int person = 0; person < num_persons; ++person) {
    Rng rng = Stream(1, "other topology", uint64_t(person));
    const geometry::TriangleMesh neutral{bench.face().neutral, triangles};
    const auto name = [&](const char* what) { return fmt::format("person {}, {}", person, what); };
    bench.Measure(name("shuffled, split"), person, testing::ShuffledTopology(triangles, num_vertices, rng));
    bench.Measure(name("subdivided"), person, testing::SubdividedTopology(triangles, num_vertices));
    bench.Measure(name("decimated 1/2"), person, testing::DecimatedTopology(neutral, 0.5, rng));
    bench.Measure(name("decimated 1/5"), person, testing::DecimatedTopology(neutral, 0.2, rng));
    const auto sealed = testing::SubdividedTopology(bench.SealedTriangles(), num_vertices);
    bench.Measure(name("sealed, subdivided"), person, sealed, Lips::kSealed);
    bench.Measure(name("sealed, subdivided, cut"), person, sealed, Lips::kCut);
  }
  bench.PrintTargets();
  if (words.size() > 4) bench.MeasureSides({.name = words[3], .path = words[4]});
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
