#include "geometry/collapse_mesh.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::geometry {

CollapseMesh::CollapseMesh(Triangles triangles, Triangles wedges, std::vector<int> labels, int num_vertices)
    : triangles_(std::move(triangles)),
      wedges_(std::move(wedges)),
      labels_(std::move(labels)),
      at_(size_t(num_vertices)),
      is_alive_(size_t(triangles_.rows()), true),
      is_pinned_(size_t(num_vertices), false),
      num_triangles_(int(triangles_.rows())) {
  DAUMIER_CHECK(wedges_.rows() == triangles_.rows(), "{} triangles have {} rows of wedges", triangles_.rows(),
                wedges_.rows());
  DAUMIER_CHECK(labels_.empty() || std::ssize(labels_) == triangles_.rows(), "{} triangles have {} labels",
                triangles_.rows(), labels_.size());
  for (int f = 0; f < triangles_.rows(); ++f) {
    const auto t = triangles_.row(f);
    DAUMIER_CHECK(t.minCoeff() >= 0 && t.maxCoeff() < num_vertices, "triangle {} names a vertex that is not there", f);
    DAUMIER_CHECK(t[0] != t[1] && t[1] != t[2] && t[2] != t[0], "triangle {} has a vertex twice", f);
    for (const int v : t) at_[size_t(v)].push_back(f);
  }
  for (int v = 0; v < num_vertices; ++v) is_pinned_[size_t(v)] = !IsOneFan(v);
}

int CollapseMesh::CornerOf(int triangle, int vertex) const {
  for (int k = 0; k < 2; ++k)
    if (triangles_(triangle, k) == vertex) return k;
  return 2;
}

std::vector<CollapseMesh::Spoke> CollapseMesh::SpokesAt(int vertex) const {
  std::vector<Spoke> spokes;
  spokes.reserve(at_[size_t(vertex)].size() + 2);
  const auto add = [&](int f, int corner, int corner_to, bool is_out) {
    const int to = triangles_(f, corner_to), wedge = wedges_(f, corner), wedge_to = wedges_(f, corner_to);
    auto found = std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& spoke) { return spoke.to == to; });
    if (found == spokes.end()) {
      found = spokes.insert(spokes.end(), Spoke{.to = to, .wedge = wedge, .wedge_to = wedge_to, .label = LabelOf(f)});
    } else {
      found->is_seam |= found->wedge != wedge || found->wedge_to != wedge_to;
      found->is_label_border |= found->label != LabelOf(f);
    }
    ++(is_out ? found->num_out : found->num_in);
  };
  for (const int f : at_[size_t(vertex)]) {
    const int k = CornerOf(f, vertex);
    add(f, k, (k + 1) % 3, true);
    add(f, k, (k + 2) % 3, false);
  }
  return spokes;
}

bool CollapseMesh::IsOneFan(int vertex) const {
  const std::vector<int>& fan = at_[size_t(vertex)];
  if (fan.size() < 2) return true;
  std::vector<bool> is_reached(fan.size(), false);
  std::vector<size_t> open = {0};
  is_reached[0] = true;
  size_t num_reached = 0;
  while (!open.empty()) {
    const size_t i = open.back();
    open.pop_back();
    ++num_reached;
    for (size_t j = 0; j < fan.size(); ++j) {
      if (is_reached[j]) continue;
      for (const int w : triangles_.row(fan[i])) {
        if (w == vertex || triangles_(fan[j], CornerOf(fan[j], w)) != w) continue;
        is_reached[j] = true;
        open.push_back(j);
        break;
      }
    }
  }
  return num_reached == fan.size();
}

bool CollapseMesh::MayCollapse(const std::vector<Spoke>& spokes, int vertex, int to) const {
  if (is_pinned_[size_t(vertex)]) return false;
  int num_features = 0, kind = 0, kind_to = 0;
  for (const Spoke& spoke : spokes) {
    if (spoke.IsBad()) return false;
    if (spoke.to == to) kind_to = spoke.Kind();
    if (spoke.Kind() == 0) continue;
    if (num_features++ > 0 && spoke.Kind() != kind) return false;
    kind = spoke.Kind();
  }
  return num_features == 0 || (num_features == 2 && kind_to != 0);
}

std::vector<int> CollapseMesh::Targets(int vertex) const {
  const std::vector<Spoke> spokes = SpokesAt(vertex);
  std::vector<int> targets;
  for (const Spoke& spoke : spokes)
    if (MayCollapse(spokes, vertex, spoke.to)) targets.push_back(spoke.to);
  return targets;
}

std::vector<int> CollapseMesh::Neighbours(int vertex) const {
  std::vector<int> neighbours;
  for (const Spoke& spoke : SpokesAt(vertex)) neighbours.push_back(spoke.to);
  return neighbours;
}

std::vector<FeatureEdge> CollapseMesh::FeatureEdges() const {
  std::vector<FeatureEdge> edges;
  for (int v = 0; v < std::ssize(at_); ++v) {
    if (at_[size_t(v)].empty()) continue;
    const std::vector<Spoke> spokes = SpokesAt(v);
    for (const int f : at_[size_t(v)]) {
      const int k = CornerOf(f, v), to = triangles_(f, (k + 1) % 3);
      const auto spoke = std::ranges::find(spokes, to, &Spoke::to);
      if (spoke->Kind() != 0 || spoke->IsBad()) edges.push_back({v, to, triangles_(f, (k + 2) % 3), f});
    }
  }
  return edges;
}

std::optional<EdgeCollapse> CollapseMesh::Plan(int from, int to) const {
  const std::vector<Spoke> spokes = SpokesAt(from), spokes_to = SpokesAt(to);
  if (!MayCollapse(spokes, from, to)) return std::nullopt;
  const auto kind = [](const std::vector<Spoke>& of, int w) { return std::ranges::find(of, w, &Spoke::to)->Kind(); };
  EdgeCollapse collapse{from, to, {}, {}};
  for (const int f : at_[size_t(from)]) {
    const int k = CornerOf(f, from), k_to = CornerOf(f, to);
    if (triangles_(f, k_to) != to) continue;
    const int opposite = triangles_(f, 3 - k - k_to);
    if (kind(spokes, opposite) != 0 && kind(spokes_to, opposite) != 0) return std::nullopt;
    collapse.removed.push_back(f);
    const std::pair wedge(wedges_(f, k), wedges_(f, k_to));
    const auto known = std::ranges::find(collapse.wedges, wedge.first, &std::pair<int, int>::first);
    if (known == collapse.wedges.end()) {
      collapse.wedges.push_back(wedge);
    } else if (known->second != wedge.second) {
      return std::nullopt;
    }
  }
  const auto is_common = [&](const Spoke& spoke) {
    return std::ranges::find(spokes_to, spoke.to, &Spoke::to) != spokes_to.end();
  };
  if (std::ranges::count_if(spokes, is_common) != std::ssize(collapse.removed)) return std::nullopt;
  for (const int f : at_[size_t(from)]) {
    const int k = CornerOf(f, from), a = triangles_(f, (k + 1) % 3), b = triangles_(f, (k + 2) % 3);
    if (a == to || b == to) continue;
    if (std::ranges::find(collapse.wedges, wedges_(f, k), &std::pair<int, int>::first) == collapse.wedges.end())
      return std::nullopt;
    for (const int g : at_[size_t(to)])
      if (triangles_(g, CornerOf(g, a)) == a && triangles_(g, CornerOf(g, b)) == b) return std::nullopt;
  }
  return collapse;
}

void CollapseMesh::Apply(const EdgeCollapse& collapse) {
  for (const int f : collapse.removed) {
    is_alive_[size_t(f)] = false;
    --num_triangles_;
    for (const int v : triangles_.row(f)) std::erase(at_[size_t(v)], f);
  }
  for (const int f : at_[size_t(collapse.from)]) {
    const int k = CornerOf(f, collapse.from);
    triangles_(f, k) = collapse.to;
    wedges_(f, k) = std::ranges::find(collapse.wedges, wedges_(f, k), &std::pair<int, int>::first)->second;
    at_[size_t(collapse.to)].push_back(f);
  }
  at_[size_t(collapse.from)].clear();
}

}  // namespace daumier::geometry
