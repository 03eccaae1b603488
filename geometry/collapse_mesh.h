#pragma once
#include "geometry/mesh.h"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace daumier::geometry {

/// Vertex `from` becomes vertex `to`: the triangles at their common edge vanish.
struct EdgeCollapse {
  int from, to;
  std::vector<int> removed;                 ///< Triangles.
  std::vector<std::pair<int, int>> wedges;  ///< Wedges of `from` and what replaces them at `to`.
};

/// An edge of a surface that must stay where it is, from its one end to its other one, in one triangle.
struct FeatureEdge {
  int from, to, opposite;
  int triangle;
};

/// The connections of a surface whose vertices are collapsed onto neighbours (half-edge collapse), so that the vertices of the
/// result are among those of the input.
///
/// A corner has a vertex, which is its place, and a wedge, which is what else belongs to it (UV). Features are borders of
/// the surface, edges between triangles of different labels, and edges at whose ends the two triangles have different wedges
/// (seams of UV). Vertices without a feature may collapse onto any neighbour; those between two features of one
/// kind along these; ends, forks and corners of features, vertices at edges of three triangles or of two that are wound against
/// each other, and those at which two fans of triangles meet stay.
class CollapseMesh {
 public:
  /// wedges: F x 3, parallel to `triangles`, each used at one vertex alone; labels: F or none.
  /// @throws Error if a size differs, a corner is no vertex, or a triangle has one twice.
  CollapseMesh(Triangles triangles, Triangles wedges, std::vector<int> labels, int num_vertices);

  int num_triangles() const { return num_triangles_; }
  bool IsAlive(int triangle) const { return is_alive_[size_t(triangle)]; }
  /// Of triangles that are alive: present corners.
  const Triangles& triangles() const { return triangles_; }
  const Triangles& wedges() const { return wedges_; }
  std::span<const int> TrianglesAt(int vertex) const { return at_[size_t(vertex)]; }

  /// Neighbours onto which features let a vertex collapse, in the order of its triangles.
  std::vector<int> Targets(int vertex) const;
  std::vector<int> Neighbours(int vertex) const;
  std::vector<FeatureEdge> FeatureEdges() const;

  /// The collapse, if it keeps every feature and the kind of surface (its holes, parts and genus): the common neighbours
  /// of both vertices are those in the removed triangles [Dey et al. 1999], no two triangles become one, no feature
  /// vanishes with a triangle, and each wedge of `from` has one at `to`.
  std::optional<EdgeCollapse> Plan(int from, int to) const;
  void Apply(const EdgeCollapse& collapse);

 private:
  struct Spoke {
    int to;
    int num_out = 0, num_in = 0;  ///< Triangles with the edge from the vertex, and towards it.
    int wedge = -1, wedge_to = -1, label = 0;
    bool is_seam = false, is_label_border = false;
    bool IsBad() const { return num_out > 1 || num_in > 1; }
    int Kind() const { return (num_out + num_in == 1 ? 1 : 0) + (is_label_border ? 2 : 0) + (is_seam ? 4 : 0); }
  };
  std::vector<Spoke> SpokesAt(int vertex) const;
  bool MayCollapse(const std::vector<Spoke>& spokes, int vertex, int to) const;
  bool IsOneFan(int vertex) const;
  int CornerOf(int triangle, int vertex) const;
  int LabelOf(int triangle) const { return labels_.empty() ? 0 : labels_[size_t(triangle)]; }

  Triangles triangles_, wedges_;
  std::vector<int> labels_;
  std::vector<std::vector<int>> at_;
  std::vector<bool> is_alive_, is_pinned_;
  int num_triangles_;
};

}  // namespace daumier::geometry
