#include "rig/edited_match.h"

#include "core/error.h"
#include "geometry/alignment.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace daumier::rig {
namespace {

constexpr double kUvReach = 1e-4, kSameUv = 5e-6;
constexpr double kUnchangedCm = 5e-4, kNearHeight = 3;  // cm
constexpr double kMostTurn = 30;                        // Degrees.
constexpr double kMostRatio = 3.1;                      // Of a unit: half way between mm and cm.
constexpr int kLeastPlaced = 20;
struct FileUnit {
  const char* name;
  double cm;
};
constexpr std::array<FileUnit, 3> kFileUnits = {{{"millimetres", 0.1}, {"centimetres", 1}, {"metres", 100}}};

/// A vertex of the edited mesh and a place that it may be.
struct Pair {
  int vertex, place;
};

/// Corners of a head by their UV.
class UvGrid {
 public:
  void Add(const geometry::TriangleMesh& mesh, int first_place) {
    for (Eigen::Index i = 0; i < mesh.uv_triangles.size(); ++i) {
      const Eigen::Vector2d uv = mesh.uv.row(mesh.uv_triangles.data()[i]).transpose();
      std::vector<Corner>& cell = cells_[Key(Cell(uv.x()), Cell(uv.y()))];
      const Corner corner{uv, first_place + mesh.triangles.data()[i]};
      const auto is_it = [&](const Corner& other) { return other.place == corner.place && other.uv == corner.uv; };
      if (std::ranges::none_of(cell, is_it)) cell.push_back(corner);
    }
  }

  /// The places whose UV is nearest, within kUvReach; several with the same.
  std::vector<int> Nearest(const Eigen::Vector2d& uv) const {
    std::vector<std::pair<double, int>> found;
    for (int64_t x = Cell(uv.x()) - 1; x <= Cell(uv.x()) + 1; ++x) {
      for (int64_t y = Cell(uv.y()) - 1; y <= Cell(uv.y()) + 1; ++y) {
        const auto cell = cells_.find(Key(x, y));
        if (cell == cells_.end()) continue;
        for (const Corner& corner : cell->second)
          if (const double distance = (corner.uv - uv).norm(); distance <= kUvReach)
            found.emplace_back(distance, corner.place);
      }
    }
    std::vector<int> places;
    if (found.empty()) return places;
    const double limit = std::ranges::min_element(found)->first + kSameUv;
    for (const auto& [distance, place] : found)
      if (distance <= limit && std::ranges::find(places, place) == places.end()) places.push_back(place);
    return places;
  }

 private:
  struct Corner {
    Eigen::Vector2d uv;
    int place;
  };
  static int64_t Cell(double value) { return int64_t(std::floor(std::clamp(value, -1e4, 1e4) / kUvReach)); }
  static uint64_t Key(int64_t x, int64_t y) { return (uint64_t(x) << 32) ^ (uint64_t(y) & 0xffffffffu); }

  std::unordered_map<uint64_t, std::vector<Corner>> cells_;
};

/// From the edited mesh to the head.
struct EditedFrame {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  ///< Whole axes, times cm a unit.
  Eigen::RowVector3d shift = Eigen::RowVector3d::Zero();
  std::string axes, unit;

  Eigen::RowVector3d Apply(const Eigen::RowVector3d& point) const { return point * linear.transpose() + shift; }
};

/// The nearest of the 24 rotations between axes.
Eigen::Matrix3d WholeAxes(const Eigen::Matrix3d& rotation) {
  Eigen::Matrix3d best = Eigen::Matrix3d::Identity();
  double most = -std::numeric_limits<double>::infinity();
  std::array<int, 3> axes = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
      for (int r = 0; r < 3; ++r) turn(r, axes[size_t(r)]) = (signs >> r & 1) != 0 ? -1 : 1;
      const double fit = turn.determinant() > 0 ? turn.cwiseProduct(rotation).sum() : -4;
      if (fit <= most) continue;
      most = fit;
      best = turn;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return best;
}

std::string UpAxis(const Eigen::Matrix3d& head_from_edited) {
  Eigen::Index axis = 0;
  head_from_edited.row(1).cwiseAbs().maxCoeff(&axis);
  return fmt::format("{}{} up", head_from_edited(1, axis) < 0 ? "-" : "", "xyz"[axis]);
}

Eigen::RowVector3d Median(const geometry::Points& points) {
  Eigen::RowVector3d median;
  for (int c = 0; c < 3; ++c) {
    std::vector<double> values(size_t(points.rows()));
    for (Eigen::Index i = 0; i < points.rows(); ++i) values[size_t(i)] = points(i, c);
    std::ranges::nth_element(values, values.begin() + std::ssize(values) / 2);
    median[c] = values[values.size() / 2];
  }
  return median;
}

EditedFrame FrameOf(const geometry::Points& edited, const geometry::Points& places, const std::vector<Pair>& pairs,
                    double height_cm) {
  geometry::Points from(std::ssize(pairs), 3), to(std::ssize(pairs), 3);
  for (size_t i = 0; i < pairs.size(); ++i) {
    from.row(Eigen::Index(i)) = edited.row(pairs[i].vertex);
    to.row(Eigen::Index(i)) = places.row(pairs[i].place);
  }
  const geometry::Similarity fit = geometry::AlignRobustly(from, to);
  const Eigen::Matrix3d axes = WholeAxes(fit.rotation);
  const double degrees = Eigen::AngleAxisd(fit.rotation * axes.transpose()).angle() * 180 / std::numbers::pi;
  DAUMIER_CHECK(degrees <= kMostTurn,
                "the mesh is turned by {:.0f} degrees against the head. Undo the turn, and export it again", degrees);
  const auto ratio = [&](const FileUnit& unit) { return std::abs(std::log(fit.scale / unit.cm)); };
  const FileUnit& unit = *std::ranges::min_element(kFileUnits, {}, ratio);
  DAUMIER_CHECK(
      ratio(unit) < std::log(kMostRatio),
      "the head has 1 / {:.4g} of its size in cm in the mesh, which is no size in mm, cm or m. Scale it back, "
      "and export it again",
      fit.scale);
  EditedFrame frame;
  frame.linear = unit.cm * axes;
  frame.axes = UpAxis(axes);
  frame.unit = unit.name;
  const geometry::Points moved = from * frame.linear.transpose();
  const Eigen::RowVector3d median = Median(to - moved);
  frame.shift = median;
  double least = kNearHeight;
  for (const double y :
       {0.0, -height_cm}) {  // About its origin, or where a scene shows it: an edit may move all of it.
    const Eigen::RowVector3d exported(0, y, 0);
    if ((median - exported).norm() >= least) continue;
    least = (median - exported).norm();
    frame.shift = exported;
  }
  return frame;
}

/// All corners of the edited mesh as pairs of a vertex and the places of its UV.
struct UvCandidates {
  std::vector<Pair> certain;
  std::vector<std::pair<int, std::vector<int>>> doubtful;
  std::set<int> unmatched;
};

UvCandidates CandidatesOf(const RiggedHead& head, const geometry::PolygonMesh& edited) {
  UvGrid grid;
  grid.Add(head.mesh, 0);
  int first = int(head.mesh.vertices.rows());
  for (const RiggedEye& eye : head.eyes) {
    if (eye.mesh.has_uv()) grid.Add(eye.mesh, first);
    first += int(eye.mesh.vertices.rows());
  }
  UvCandidates candidates;
  std::set<std::pair<int, int>> seen;
  for (size_t c = 0; c < edited.corners.size(); ++c) {
    if (!seen.emplace(edited.corners[c], edited.uv_corners[c]).second) continue;
    std::vector<int> places = grid.Nearest(edited.uv.row(edited.uv_corners[c]).transpose());
    if (places.empty()) candidates.unmatched.insert(edited.corners[c]);
    if (places.size() == 1) candidates.certain.push_back({edited.corners[c], places[0]});
    if (places.size() > 1) candidates.doubtful.emplace_back(edited.corners[c], std::move(places));
  }
  return candidates;
}

/// The places of the vertices of a mesh without UV, if their number and triangles are the head's.
std::optional<std::vector<int>> OrderInFile(const RiggedHead& head, const HeadNumbering& numbering,
                                            const geometry::PolygonMesh& edited) {
  std::vector<int> with_eyes = numbering.of_file_vertices;
  std::vector<int> first_places = {int(head.mesh.vertices.rows())};
  for (const RiggedEye& eye : head.eyes) first_places.push_back(first_places.back() + int(eye.mesh.vertices.rows()));
  for (size_t e = numbering.of_eye_vertices.size(); e-- > 0;)  // The left one is first in files.
    for (const int v : numbering.of_eye_vertices[e]) with_eyes.push_back(first_places[e] + v);
  std::vector<int> welded(size_t(head.mesh.vertices.rows()));
  for (size_t v = 0; v < welded.size(); ++v) welded[v] = int(v);
  std::set<std::pair<int, int>> edges;
  const auto add = [&](const geometry::Triangles& triangles, int first) {
    for (const auto& corners : triangles.rowwise())
      for (int k = 0; k < 3; ++k) edges.insert(std::minmax(first + corners[k], first + corners[(k + 1) % 3]));
  };
  add(head.mesh.triangles, 0);
  for (size_t e = 0; e < head.eyes.size(); ++e) add(head.eyes[e].mesh.triangles, first_places[e]);
  for (const std::vector<int>& order : {numbering.of_file_vertices, with_eyes, welded}) {
    if (std::ssize(order) != edited.vertices.rows()) continue;
    size_t num_found = 0;
    for (int p = 0; p < edited.num_polygons(); ++p) {
      const int begin = edited.offsets[size_t(p)], end = edited.offsets[size_t(p) + 1];
      for (int c = begin; c < end; ++c) {
        const int next = c + 1 < end ? c + 1 : begin;
        const int from = order[size_t(edited.corners[size_t(c)])], to = order[size_t(edited.corners[size_t(next)])];
        num_found += edges.contains({std::min(from, to), std::max(from, to)}) ? 1 : 0;
      }
    }
    if (10 * num_found >= 9 * edited.corners.size()) return order;
  }
  return std::nullopt;
}

/// Vertices that polygons use.
int NumUsed(const geometry::PolygonMesh& mesh) {
  return int(std::set<int>(mesh.corners.begin(), mesh.corners.end()).size());
}

/// Whether a target moves each vertex of the head.
std::vector<bool> MovingVertices(const RiggedHead& head) {
  std::vector<bool> moves(size_t(head.mesh.vertices.rows()), head.targets.offsets.cols() == 0);
  for (Eigen::Index t = 0; t < head.targets.offsets.cols(); ++t)
    for (size_t v = 0; v < moves.size(); ++v)
      if (!head.targets.offsets.col(t).segment<3>(3 * Eigen::Index(v)).isZero(0)) moves[v] = true;
  return moves;
}

void CheckShare(const RiggedHead& head, const EditedMatch& match) {
  const std::vector<bool> moves = MovingVertices(head);
  int num_moving = 0, num_found = 0;
  for (size_t v = 0; v < moves.size(); ++v) {
    num_moving += moves[v] ? 1 : 0;
    num_found += moves[v] && match.is_matched[v] ? 1 : 0;
  }
  DAUMIER_CHECK(2 * num_found >= num_moving,
                "only {} of {} vertices that the head's targets move are in the mesh. Export the object Face, with its "
                "UV, without remeshing or decimation",
                num_found, num_moving);
}

/// The mean of the vertices at each place; where that is unchanged, or has none, as it was.
void PlaceVertices(const geometry::Points& places, const geometry::PolygonMesh& edited, const EditedFrame& frame,
                   const std::vector<Pair>& pairs, EditedMatch& match) {
  geometry::Points sums = geometry::Points::Zero(places.rows(), 3);
  std::vector<int> counts(size_t(places.rows()), 0);
  for (const auto& [vertex, place] : pairs) {
    sums.row(place) += frame.Apply(edited.vertices.row(vertex));
    ++counts[size_t(place)];
  }
  match.places = places;
  match.is_matched.assign(counts.size(), false);
  for (Eigen::Index p = 0; p < places.rows(); ++p) {
    const int count = counts[size_t(p)];
    if (count == 0) continue;
    match.is_matched[size_t(p)] = true;
    const Eigen::RowVector3d mean = sums.row(p) / count;
    if ((mean - places.row(p)).norm() > kUnchangedCm) match.places.row(p) = mean;
  }
  match.axes = frame.axes;
  match.unit = frame.unit;
}

}  // namespace

geometry::Points PlacesOf(const RiggedHead& head) {
  Eigen::Index count = head.mesh.vertices.rows();
  for (const RiggedEye& eye : head.eyes) count += eye.mesh.vertices.rows();
  geometry::Points places(count, 3);
  places.topRows(head.mesh.vertices.rows()) = head.mesh.vertices;
  Eigen::Index first = head.mesh.vertices.rows();
  for (const RiggedEye& eye : head.eyes) {
    places.middleRows(first, eye.mesh.vertices.rows()) = eye.mesh.vertices.rowwise() + eye.centre.transpose();
    first += eye.mesh.vertices.rows();
  }
  return places;
}

EditedMatch MatchEdited(const RiggedHead& head, const HeadNumbering& numbering, const geometry::PolygonMesh& edited) {
  const geometry::Points places = PlacesOf(head);
  EditedMatch match;
  match.num_vertices = NumUsed(edited);
  std::vector<Pair> pairs;
  UvCandidates candidates;
  if (edited.has_uv() && head.mesh.has_uv()) candidates = CandidatesOf(head, edited);
  if (std::ssize(candidates.certain) >= kLeastPlaced) {
    DAUMIER_CHECK(
        candidates.unmatched.empty(),
        "{} of {} vertices have no match in the head: no vertex of it has their UV. Export only objects of the "
        "head (Face, LeftEye, RightEye, Head_...), without Hair, with their UV unchanged",
        candidates.unmatched.size(), match.num_vertices);
    pairs = std::move(candidates.certain);
    const EditedFrame frame = FrameOf(edited.vertices, places, pairs, numbering.height_cm);
    for (const auto& [vertex, of_vertex] : candidates.doubtful) {
      const Eigen::RowVector3d point = frame.Apply(edited.vertices.row(vertex));
      const auto distance = [&](int place) { return (places.row(place) - point).squaredNorm(); };
      pairs.push_back({vertex, *std::ranges::min_element(of_vertex, {}, distance)});
    }
    PlaceVertices(places, edited, frame, pairs, match);
  } else {
    const auto order = OrderInFile(head, numbering, edited);
    DAUMIER_CHECK(
        order,
        "none of its {} vertices has a match in the head ({} vertices in its file): {}. Export the object Face "
        "with its UV, without remeshing or decimation, and without Hair, which has no UV",
        match.num_vertices, numbering.of_file_vertices.size(),
        edited.has_uv() ? "its UV are others" : "it has no UV, and another number or order of vertices");
    match.by = MatchedBy::kOrder;
    const std::set<int> used(edited.corners.begin(), edited.corners.end());
    for (const int vertex : used) pairs.push_back({vertex, (*order)[size_t(vertex)]});
    PlaceVertices(places, edited, FrameOf(edited.vertices, places, pairs, numbering.height_cm), pairs, match);
  }
  CheckShare(head, match);
  return match;
}

}  // namespace daumier::rig
