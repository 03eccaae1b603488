#include "rig/decimated_head.h"

#include "core/parallel.h"
#include "geometry/decimation.h"
#include "geometry/submesh.h"
#include "rig/texture_space.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace daumier::rig {
namespace {

constexpr float kMouthInside = 0.3f, kBackOfEye = 0.03f, kFrontOfEye = 24;
constexpr float kMoving = 3, kFullMove = 0.5f;  // cm
constexpr float kStretching = 16,
                kFullStretch = 1;  // Change of a difference of two displacements by the edge's length.

/// Up to `most` targets, those that move most (sum of squares).
std::vector<Eigen::Index> LargestTargets(const RiggedHead& head, Eigen::Index most) {
  std::vector<Eigen::Index> targets(size_t(head.targets.offsets.cols()));
  std::iota(targets.begin(), targets.end(), 0);
  if (std::ssize(targets) <= most) return targets;
  std::vector<float> sizes;
  for (const Eigen::Index t : targets) sizes.push_back(head.targets.offsets.col(t).squaredNorm());
  std::ranges::stable_sort(targets, std::ranges::greater(), [&](Eigen::Index t) { return sizes[size_t(t)]; });
  targets.resize(size_t(most));
  return targets;
}

bool IsInMouth(faces::HeadMaterial material) {
  using enum faces::HeadMaterial;
  return material == kMouth || material == kThroat || material == kTooth || material == kGum || material == kTongue;
}

/// 1 for skin that keeps its place and shape, more where it moves and stretches, as lids and lips do.
std::vector<float> ImportanceOfSkin(const RiggedHead& head) {
  const geometry::Triangles& triangles = head.mesh.triangles;
  std::vector<float> importance(size_t(triangles.rows()));
  OnAllCores(triangles.rows(), [&](int64_t f) {
    float move = 0, stretch = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      const auto length = float((head.mesh.vertices.row(a) - head.mesh.vertices.row(b)).norm());
      for (Eigen::Index t = 0; t < head.targets.offsets.cols(); ++t) {
        const Eigen::Vector3f of_a = head.targets.offsets.col(t).segment<3>(3 * a),
                              of_b = head.targets.offsets.col(t).segment<3>(3 * b);
        move = std::max(move, of_a.norm());
        stretch = std::max(stretch, (of_a - of_b).norm() / std::max(length, 1e-6f));
      }
    }
    importance[size_t(f)] =
        1 + kMoving * std::min(1.0f, move / kFullMove) + kStretching * std::min(1.0f, stretch / kFullStretch);
  });
  return importance;
}

/// Labels and importance of the triangles of JoinedMesh.
struct TriangleFacts {
  std::vector<int> labels;
  std::vector<float> importance;

  explicit TriangleFacts(const RiggedHead& head) {
    const bool has_own = !head.own_materials.empty();
    importance = ImportanceOfSkin(head);
    for (size_t f = 0; f < head.materials.size(); ++f) {
      labels.push_back(has_own ? head.own[f] : int(head.materials[f]));
      if (IsInMouth(head.materials[f])) importance[f] = kMouthInside;
    }
    for (const RiggedEye& eye : head.eyes) {
      for (size_t f = 0; f < eye.materials.size(); ++f) {
        labels.push_back(has_own ? eye.own[f] : int(eye.materials[f]));
        double z = 0;
        for (const int v : eye.mesh.triangles.row(Eigen::Index(f))) z += eye.mesh.vertices(v, 2);
        importance.push_back(z < 0 ? kBackOfEye : kFrontOfEye);
      }
    }
  }
};

/// The vertex that a target moves most, of those in use.
struct Peak {
  int vertex = -1;
  float length = 0;
};

Peak PeakOf(const RiggedHead& head, Eigen::Index target) {
  Peak peak;
  for (const int v : head.mesh.triangles.reshaped<Eigen::RowMajor>()) {
    const float length = head.targets.offsets.col(target).segment<3>(3 * v).norm();
    if (length > peak.length) peak = {v, length};
  }
  return peak;
}

/// Some rows of what a decimated surface has, as a mesh of the vertices that they use.
struct DecimatedPart {
  geometry::TriangleMesh mesh;
  std::vector<int> vertices;  ///< Of the joined mesh.
  std::vector<int> rows;      ///< Of the part's triangles before.
};

DecimatedPart DecimatedPartOf(const geometry::TriangleMesh& joined, const geometry::DecimatedSurface& surface,
                              int first_row, int num_rows) {
  const auto begin = std::ranges::lower_bound(surface.rows, first_row),
             end = std::ranges::lower_bound(surface.rows, first_row + num_rows);
  const Eigen::Index first = begin - surface.rows.begin(), count = end - begin;
  DecimatedPart part;
  geometry::TriangleMesh all{joined.vertices, surface.triangles.middleRows(first, count), {}, {}};
  all.uv_triangles.resize(0, 3);
  if (joined.has_uv()) {
    all.uv = joined.uv;
    all.uv_triangles = surface.uv_triangles.middleRows(first, count);
  }
  const std::vector<int> used(all.triangles.data(), all.triangles.data() + all.triangles.size());
  const geometry::VertexMap map = geometry::MapKept(used, int(joined.vertices.rows()));
  part.mesh = geometry::Submesh(all, map);
  part.vertices = map.old_from_new;
  for (auto row = begin; row != end; ++row) part.rows.push_back(*row - first_row);
  return part;
}

template <class T>
std::vector<T> OfRows(const std::vector<T>& values, const std::vector<int>& rows) {
  std::vector<T> selected;
  if (!values.empty())
    for (const int row : rows) selected.push_back(values[size_t(row)]);
  return selected;
}

/// The head with the parts of a decimated surface of its joined mesh.
RiggedHead HeadOfSurface(const RiggedHead& head, const geometry::TriangleMesh& joined,
                         const geometry::DecimatedSurface& surface) {
  RiggedHead result = head;
  int first_row = int(head.mesh.triangles.rows());
  DecimatedPart skin = DecimatedPartOf(joined, surface, 0, first_row);
  result.materials = OfRows(head.materials, skin.rows);
  result.own = OfRows(head.own, skin.rows);
  result.targets.offsets.resize(3 * std::ssize(skin.vertices), head.targets.offsets.cols());
  for (size_t v = 0; v < skin.vertices.size(); ++v)
    result.targets.offsets.middleRows<3>(3 * Eigen::Index(v)) =
        head.targets.offsets.middleRows<3>(3 * Eigen::Index(skin.vertices[v]));
  result.mesh = std::move(skin.mesh);
  result.neck_cap.clear();
  for (size_t row = 0; row < skin.rows.size(); ++row)
    if (std::ranges::binary_search(head.neck_cap, skin.rows[row])) result.neck_cap.push_back(int(row));
  for (RiggedEye& eye : result.eyes) {
    const int num_rows = int(eye.mesh.triangles.rows());
    DecimatedPart ball = DecimatedPartOf(joined, surface, first_row, num_rows);
    first_row += num_rows;
    eye.materials = OfRows(eye.materials, ball.rows);
    eye.own = OfRows(eye.own, ball.rows);
    eye.mesh = std::move(ball.mesh);
    eye.mesh.vertices.rowwise() -= eye.centre.transpose();
  }
  return result;
}

}  // namespace

int NumTriangles(const RiggedHead& head) {
  Eigen::Index count = head.mesh.triangles.rows();
  for (const RiggedEye& eye : head.eyes) count += eye.mesh.triangles.rows();
  return int(count);
}

DecimatedHead Decimated(const RiggedHead& head, int num_triangles, DecimatedPoses poses,
                        Eigen::Index most_posed_vertices) {
  DecimatedHead result;
  result.num_triangles_before = result.num_triangles = NumTriangles(head);
  if (result.num_triangles_before <= num_triangles) {
    result.head = head;
    return result;
  }
  const geometry::TriangleMesh joined = JoinedMesh(head);
  const bool all_poses = poses == DecimatedPoses::kAll;
  const std::vector<Eigen::Index> targets =
      all_poses ? LargestTargets(head, most_posed_vertices / joined.vertices.rows()) : std::vector<Eigen::Index>();
  Eigen::MatrixXf offsets =
      Eigen::MatrixXf::Zero(targets.empty() ? 0 : 3 * joined.vertices.rows(), std::ssize(targets));
  if (!targets.empty()) offsets.topRows(head.targets.offsets.rows()) = head.targets.offsets(Eigen::all, targets);
  TriangleFacts facts(head);
  geometry::DecimationInput input{joined, offsets, std::move(facts.labels)};
  if (all_poses) input.importance = std::move(facts.importance);
  std::vector<Peak> peaks;
  for (Eigen::Index t = 0; t < head.targets.offsets.cols(); ++t) {
    peaks.push_back(PeakOf(head, t));
    if (all_poses && peaks.back().vertex >= 0) input.kept.push_back(peaks.back().vertex);
  }
  const geometry::DecimatedSurface surface = geometry::Decimate(input, num_triangles);
  result.is_reached = surface.is_reached;
  result.num_triangles = int(surface.triangles.rows());
  result.head = HeadOfSurface(head, joined, surface);
  for (size_t t = 0; t < peaks.size(); ++t) {
    if (peaks[t].length == 0) continue;
    const double loss = 1 - double(PeakOf(result.head, Eigen::Index(t)).length) / double(peaks[t].length);
    if (loss <= result.greatest_peak_loss) continue;
    result.greatest_peak_loss = loss;
    result.worst_target = head.targets.names[t];
  }
  return result;
}

}  // namespace daumier::rig
