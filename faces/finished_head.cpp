#include "faces/finished_head.h"

#include "core/error.h"
#include "faces/mouth_bag.h"
#include "faces/neck_cut.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <set>

namespace daumier::faces {
namespace {

geometry::Triangles ToTriangles(const std::vector<Eigen::Vector3i>& list) {
  geometry::Triangles triangles(Eigen::Index(list.size()), 3);
  for (size_t t = 0; t < list.size(); ++t) triangles.row(Eigen::Index(t)) = list[t].transpose();
  return triangles;
}

geometry::Triangles Stacked(const geometry::Triangles& a, const geometry::Triangles& b) {
  geometry::Triangles both(a.rows() + b.rows(), 3);
  both << a, b;
  return both;
}

/// Six times the volume of a closed surface; negative if it is inside out.
double SixVolumes(const geometry::Points& vertices, const geometry::Triangles& triangles) {
  double sum = 0;
  for (const auto& t : triangles.rowwise()) {
    const geometry::Vector3 a = vertices.row(t[0]), b = vertices.row(t[1]), c = vertices.row(t[2]);
    sum += a.dot(b.cross(c));
  }
  return sum;
}

/// The holes of a face by the triangles that close them.
struct SortedHoles {
  std::vector<std::vector<int>> eyes, mouths, others;
};

/// Eyes from the right one on; others the longest first.
SortedHoles SortHoles(const geometry::TriangleMesh& neutral, const geometry::Triangles& closing, int num_eye_closing) {
  const auto begin = closing.data(), middle = begin + 3 * num_eye_closing, end = begin + closing.size();
  const std::set<int> of_eyes(begin, middle), of_mouth(middle, end);
  SortedHoles holes;
  const auto lies_in = [](const std::vector<int>& loop, const std::set<int>& vertices) {
    return std::all_of(loop.begin(), loop.end(), [&](int v) { return vertices.count(v) > 0; });
  };
  for (std::vector<int>& loop : geometry::BoundaryLoops(neutral.triangles, static_cast<int>(neutral.vertices.rows()))) {
    auto& kind = lies_in(loop, of_eyes) && loop.size() >= 4 ? holes.eyes
                 : lies_in(loop, of_mouth)                  ? holes.mouths
                                                            : holes.others;
    kind.push_back(std::move(loop));
  }
  // Copied first: Eigen 3.4.0 sums an indexed column of a row-major matrix wrongly.
  const auto middle_x = [&](const std::vector<int>& loop) { return Eigen::VectorXd(neutral.vertices(loop, 0)).mean(); };
  std::sort(holes.eyes.begin(), holes.eyes.end(),
            [&](const auto& a, const auto& b) { return middle_x(a) < middle_x(b); });
  // One mouth has a bag.
  while (holes.mouths.size() > 1) {
    holes.others.push_back(std::move(holes.mouths.back()));
    holes.mouths.pop_back();
  }
  return holes;
}

}  // namespace

FinishedHead::FinishedHead(const FaceTemplate& face_template)
    : FinishedHead(SurfaceMesh(face_template, face_template.neutral), face_template.closing_triangles,
                   face_template.num_eye_closing_triangles) {}

FinishedHead::FinishedHead(const geometry::TriangleMesh& neutral, const geometry::Triangles& closing_triangles,
                           int num_eye_closing_triangles)
    : num_face_vertices_(static_cast<int>(neutral.vertices.rows())) {
  DAUMIER_CHECK(0 <= num_eye_closing_triangles && num_eye_closing_triangles <= closing_triangles.rows(),
                "{} of {} closing triangles are said to be of the eyes", num_eye_closing_triangles,
                closing_triangles.rows());
  DAUMIER_CHECK(closing_triangles.size() == 0 ||
                    (closing_triangles.minCoeff() >= 0 && closing_triangles.maxCoeff() < num_face_vertices_),
                "a closing triangle names a vertex that is none of the {} of the face", num_face_vertices_);
  SortedHoles holes = SortHoles(neutral, closing_triangles, num_eye_closing_triangles);
  geometry::LevelCut cut{{}, neutral.triangles, neutral.uv, neutral.uv_triangles};
  if (!holes.others.empty()) {
    std::vector<int> inner(closing_triangles.data(), closing_triangles.data() + closing_triangles.size());
    for (size_t i = 1; i < holes.others.size(); ++i)
      inner.insert(inner.end(), holes.others[i].begin(), holes.others[i].end());
    cut = CutBorder(neutral, holes.others.front(), inner);
  }
  edge_points_ = cut.points;
  num_vertices_ = num_face_vertices_ + static_cast<int>(edge_points_.size());

  std::vector<Eigen::Vector3i> caps, parts;
  const auto add = [](const std::vector<Eigen::Vector3i>& triangles, std::vector<Eigen::Vector3i>& to) {
    to.insert(to.end(), triangles.begin(), triangles.end());
  };
  std::set<std::set<int>> inner_holes;
  for (const auto* kind : {&holes.eyes, &holes.mouths})
    for (const auto& loop : *kind) inner_holes.insert(std::set<int>(loop.begin(), loop.end()));
  for (std::vector<int>& loop : geometry::BoundaryLoops(cut.triangles, num_vertices_)) {
    if (inner_holes.count(std::set<int>(loop.begin(), loop.end()))) continue;
    // The loop of the cut first: it is that of the edge points.
    const bool is_cut = loop.front() >= num_face_vertices_;
    caps_.insert(is_cut ? caps_.begin() : caps_.end(), TakeClosure(std::move(loop), kCapRings));
    if (is_cut) neutral_cut_ = LoopPoints(geometry::WithEdgePoints(neutral.vertices, edge_points_), caps_.front().loop);
  }
  for (const HoleClosure& cap : caps_) add(cap.Triangles(), caps);
  for (std::vector<int>& loop : holes.eyes) {
    EyeballFit fit(neutral, loop);
    HoleClosure rim = TakeClosure(std::move(loop), 0);
    add(rim.Triangles(), parts);
    part_materials_.resize(parts.size(), HeadMaterial::kLidRim);
    const EyeballMesh& ball = EyeballTopology();
    for (const Eigen::Vector3i& triangle : ball.triangles) parts.push_back(triangle.array() + num_vertices_);
    part_materials_.insert(part_materials_.end(), ball.materials.begin(), ball.materials.end());
    eyes_.push_back({std::move(rim), std::move(fit), num_vertices_});
    num_vertices_ += NumEyeballVertices();
  }
  for (std::vector<int>& loop : holes.mouths) {
    const auto by_x = [&](int a, int b) { return neutral.vertices(a, 0) < neutral.vertices(b, 0); };
    const auto [right, left] = std::minmax_element(loop.begin(), loop.end(), by_x);
    right_mouth_corner_ = *right;
    left_mouth_corner_ = *left;
    const std::vector<HeadMaterial> materials = MouthBagMaterials(static_cast<int>(loop.size()));
    mouth_ = TakeClosure(std::move(loop), kMouthRings);
    add(mouth_->Triangles(), parts);
    part_materials_.insert(part_materials_.end(), materials.begin(), materials.end());
    num_mouth_triangles_ = static_cast<int>(materials.size());
  }
  num_cap_triangles_ = static_cast<int>(caps.size());
  skin_ = Stacked(cut.triangles, ToTriangles(caps));
  parts_ = ToTriangles(parts);
  if (cut.uv.rows() > 0) AddUv(cut);
  faces_outwards_ = SixVolumes(Vertices(neutral.vertices), Stacked(skin_, parts_)) > 0;
}

HoleClosure FinishedHead::TakeClosure(std::vector<int> loop, int num_rings) {
  HoleClosure closure{std::move(loop), num_vertices_, num_rings};
  num_vertices_ += closure.num_vertices();
  return closure;
}

void FinishedHead::AddUv(const geometry::LevelCut& cut) {
  // The row of each vertex; of a vertex on a seam one of several.
  std::vector<int> row_of(size_t(num_vertices_), 0);
  for (Eigen::Index i = 0; i < cut.triangles.size(); ++i)
    row_of[size_t(cut.triangles.data()[i])] = cut.uv_triangles.data()[i];
  const auto hang_on_loop = [&](const HoleClosure& closure) {
    for (int v = closure.first_vertex; v <= closure.apex(); ++v)
      row_of[size_t(v)] = row_of[size_t(closure.LoopVertexOf(v))];
  };
  for (const HoleClosure& cap : caps_) hang_on_loop(cap);
  if (mouth_) hang_on_loop(*mouth_);
  const geometry::TextureCoordinates of_eye = EyeballUv();
  uv_.resize(cut.uv.rows() + of_eye.rows(), 2);
  uv_ << cut.uv, of_eye;
  for (const Eye& eye : eyes_) {
    hang_on_loop(eye.rim);
    for (int i = 0; i < NumEyeballVertices(); ++i)
      row_of[size_t(eye.first_vertex + i)] = static_cast<int>(cut.uv.rows()) + i;
  }
  const auto rows_of = [&](const geometry::Triangles& triangles) {
    return geometry::Triangles(triangles.unaryExpr([&](int v) { return row_of[size_t(v)]; }));
  };
  uv_triangles_ = Stacked(Stacked(cut.uv_triangles, rows_of(skin_.bottomRows(num_cap_triangles_))), rows_of(parts_));
}

std::vector<Eyeball> FinishedHead::Eyeballs(const geometry::Points& face) const {
  std::vector<Eyeball> eyeballs;
  for (const Eye& eye : eyes_) eyeballs.push_back(eye.fit.Fit(face));
  return eyeballs;
}

std::vector<HoleClosure> FinishedHead::rims() const {
  std::vector<HoleClosure> rims;
  for (const Eye& eye : eyes_) rims.push_back(eye.rim);
  return rims;
}

geometry::Points FinishedHead::Vertices(const geometry::Points& face) const {
  DAUMIER_CHECK(face.rows() == num_face_vertices_, "the face has {} vertices, its topology {}", face.rows(),
                num_face_vertices_);
  return Vertices(face, Eyeballs(face));
}

geometry::Points FinishedHead::Vertices(const geometry::Points& face, const std::vector<Eyeball>& eyeballs) const {
  DAUMIER_CHECK(face.rows() == num_face_vertices_, "the face has {} vertices, its topology {}", face.rows(),
                num_face_vertices_);
  DAUMIER_CHECK(eyeballs.size() == eyes_.size(), "{} eyeballs are given for {} eyes", eyeballs.size(), eyes_.size());
  geometry::Points vertices(num_vertices_, 3);
  const auto with_edge_points = geometry::WithEdgePoints(face, edge_points_);
  vertices.topRows(with_edge_points.rows()) = with_edge_points;
  if (neutral_cut_.rows() > 0) {
    const std::vector<int>& cut = caps_.front().loop;
    vertices(cut, Eigen::all) = SmoothlyMoved(neutral_cut_, LoopPoints(vertices, cut));
  }
  for (const HoleClosure& cap : caps_)
    vertices.middleRows(cap.first_vertex, cap.num_vertices()) = CapPoints(LoopPoints(vertices, cap.loop));
  for (size_t i = 0; i < eyes_.size(); ++i) {
    vertices.row(eyes_[i].rim.apex()) = eyeballs[i].centre.transpose();
    vertices.middleRows(eyes_[i].first_vertex, NumEyeballVertices()) = EyeballPoints(eyeballs[i]);
  }
  if (mouth_) {
    const double width = (face.row(left_mouth_corner_) - face.row(right_mouth_corner_)).norm();
    vertices.middleRows(mouth_->first_vertex, mouth_->num_vertices()) =
        MouthBagPoints(LoopPoints(face, mouth_->loop), width);
  }
  return vertices;
}

Eigen::VectorXd FinishedHead::Values(const Eigen::VectorXd& values) const {
  DAUMIER_CHECK(values.size() == num_face_vertices_, "{} values were given for the {} vertices of a face",
                values.size(), num_face_vertices_);
  Eigen::VectorXd all = Eigen::VectorXd::Constant(num_vertices_, std::numeric_limits<double>::quiet_NaN());
  all.head(num_face_vertices_) = values;
  Eigen::Index row = num_face_vertices_;
  for (const geometry::EdgePoint& point : edge_points_)
    all[row++] = (1 - point.share) * values[point.kept] + point.share * values[point.removed];
  return all;
}

geometry::TriangleMesh FinishedHead::Mesh(const geometry::Points& face) const {
  return {Vertices(face), Stacked(skin_, parts_), uv_, uv_triangles_};
}

}  // namespace daumier::faces
