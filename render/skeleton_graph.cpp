#include "render/skeleton_graph.h"

#include "core/error.h"
#include "render/ink.h"
#include "render/opencv_bridge.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

/// Length of a spur and of a bridge, in widths of the line, and what is added for the ragged edge of pixels.
constexpr double kSpurWidths = 1.0, kBridgeWidths = 1.0, kRaggedPixels = 1.5;

struct Pixel {
  int row, column;
  bool operator==(const Pixel&) const = default;
};

class GraphBuilder {
 public:
  GraphBuilder(const Image& skeleton, const Image& ink) : skeleton_(skeleton) {
    cv::Mat inverted, padded;
    cv::bitwise_not(MatView(ink), inverted);
    cv::copyMakeBorder(inverted, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::distanceTransform(padded, distance_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    node_of_.assign(skeleton.pixels.size(), -1);
    is_done_.assign(skeleton.pixels.size(), 0);
  }

  SkeletonGraph Build() {
    ForEachPixel([&](Pixel pixel) {
      const size_t degree = NeighboursOf(pixel).size();
      if (NodeOf(pixel) < 0 && degree != 2) AddNode(degree < 2 ? std::vector{pixel} : JunctionAt(pixel));
      if (degree == 0) graph_.edges.push_back({{NodeOf(pixel), NodeOf(pixel)}, {CentreOf(pixel)}});
    });
    ForEachPixel([&](Pixel pixel) {
      const int node = NodeOf(pixel);
      if (node < 0) return;
      for (const Pixel& next : NeighboursOf(pixel)) {
        if (NodeOf(next) < 0 && !IsDone(next)) AddEdge(node, pixel, next);
        // Two nodes side by side: the edge is added once, from the first of them.
        if (NodeOf(next) > node) AddShortEdge(node, NodeOf(next));
      }
    });
    // What is left are closed lines.
    ForEachPixel([&](Pixel pixel) {
      if (NodeOf(pixel) >= 0 || IsDone(pixel)) return;
      AddNode({pixel});
      AddEdge(NodeOf(pixel), pixel, NeighboursOf(pixel)[0]);
    });
    return std::move(graph_);
  }

 private:
  bool IsLine(int row, int column) const {
    return row >= 0 && row < skeleton_.height && column >= 0 && column < skeleton_.width &&
           skeleton_.at(row, column) == kInk;
  }
  size_t Index(Pixel pixel) const { return size_t(pixel.row) * skeleton_.width + pixel.column; }
  int NodeOf(Pixel pixel) const { return node_of_[Index(pixel)]; }
  bool IsDone(Pixel pixel) const { return is_done_[Index(pixel)] != 0; }

  template <class Visit>
  void ForEachPixel(Visit visit) const {
    for (int row = 0; row < skeleton_.height; ++row) {
      for (int column = 0; column < skeleton_.width; ++column) {
        if (IsLine(row, column)) visit(Pixel{row, column});
      }
    }
  }

  std::vector<Pixel> NeighboursOf(Pixel pixel) const {
    std::vector<Pixel> neighbours;
    for (int row = pixel.row - 1; row <= pixel.row + 1; ++row) {
      for (int column = pixel.column - 1; column <= pixel.column + 1; ++column) {
        if (Pixel{row, column} != pixel && IsLine(row, column)) neighbours.push_back({row, column});
      }
    }
    return neighbours;
  }

  std::vector<Pixel> JunctionAt(Pixel first) const {
    std::vector<Pixel> junction = {first};
    for (size_t i = 0; i < junction.size(); ++i) {
      for (const Pixel& next : NeighboursOf(junction[i])) {
        const bool is_new = std::find(junction.begin(), junction.end(), next) == junction.end();
        if (is_new && NeighboursOf(next).size() > 2) junction.push_back(next);
      }
    }
    return junction;
  }

  static Vector2d CentreOf(Pixel pixel) { return {pixel.column + 0.5, pixel.row + 0.5}; }

  void AddNode(const std::vector<Pixel>& pixels) {
    SkeletonNode node{Vector2d::Zero(), 0.0};
    for (const Pixel& pixel : pixels) {
      node.position += CentreOf(pixel) / static_cast<double>(pixels.size());
      // Half a pixel lies between the centre of the nearest pixel of paper and its edge.
      node.radius = std::max(node.radius, distance_.at<float>(pixel.row + 1, pixel.column + 1) - 0.5);
      node_of_[Index(pixel)] = static_cast<int>(graph_.nodes.size());
    }
    graph_.nodes.push_back(node);
  }

  /// Follows the line that leaves a node through `next`.
  void AddEdge(int from_node, Pixel from, Pixel next) {
    SkeletonEdge edge{{from_node, -1}, {graph_.nodes[from_node].position}};
    while (NodeOf(next) < 0) {
      is_done_[Index(next)] = 1;
      edge.points.push_back(CentreOf(next));
      const auto neighbours = NeighboursOf(next);
      const Pixel onward = neighbours[0] == from ? neighbours[1] : neighbours[0];
      from = next;
      next = onward;
    }
    edge.nodes[1] = NodeOf(next);
    edge.points.push_back(graph_.nodes[edge.nodes[1]].position);
    graph_.edges.push_back(std::move(edge));
  }

  void AddShortEdge(int from, int to) {
    const bool exists = std::any_of(graph_.edges.begin(), graph_.edges.end(), [&](const SkeletonEdge& edge) {
      return edge.points.size() == 2 && edge.nodes == std::array{from, to};
    });
    if (exists) return;
    graph_.edges.push_back({{from, to}, {graph_.nodes[from].position, graph_.nodes[to].position}});
  }

  const Image& skeleton_;
  cv::Mat distance_;
  std::vector<int> node_of_;
  std::vector<uint8_t> is_done_;
  SkeletonGraph graph_;
};

/// Removes the shortest spur, if there is one.
bool RemoveShortestSpur(SkeletonGraph& graph, double max_protrusion) {
  const auto degrees = graph.Degrees();
  size_t shortest = graph.edges.size();
  double shortest_length = 0.0;
  for (size_t e = 0; e < graph.edges.size(); ++e) {
    const auto& edge = graph.edges[e];
    for (int side = 0; side < 2; ++side) {
      if (degrees[edge.nodes[side]] != 1 || degrees[edge.nodes[1 - side]] < 3) continue;
      const double junction_radius = graph.nodes[edge.nodes[1 - side]].radius;
      const double limit = kSpurWidths * 2.0 * junction_radius + kRaggedPixels;
      const double length = edge.Length();
      const double protrusion = length + graph.nodes[edge.nodes[side]].radius - junction_radius;
      if (length <= limit && protrusion <= max_protrusion * junction_radius + kRaggedPixels &&
          (shortest == graph.edges.size() || length < shortest_length)) {
        shortest = e;
        shortest_length = length;
      }
    }
  }
  if (shortest == graph.edges.size()) return false;
  graph.edges.erase(graph.edges.begin() + static_cast<int64_t>(shortest));
  return true;
}

/// Makes one junction of every two that a bridge joins, the shortest bridges first. Longer chains stay: in hatching,
/// they would draw everything together.
void MergeBridges(SkeletonGraph& graph) {
  const auto degrees = graph.Degrees();
  struct Bridge {
    double length;
    std::array<int, 2> nodes;
  };
  std::vector<Bridge> bridges;
  for (const auto& edge : graph.edges) {
    const auto [from, to] = edge.nodes;
    if (from == to || degrees[from] < 3 || degrees[to] < 3) continue;
    const double length = edge.Length();
    if (length <= kBridgeWidths * (graph.nodes[from].radius + graph.nodes[to].radius)) {
      bridges.push_back({length, edge.nodes});
    }
  }
  std::sort(bridges.begin(), bridges.end(), [](const Bridge& a, const Bridge& b) { return a.length < b.length; });

  std::vector<int> merged_into(graph.nodes.size());
  std::iota(merged_into.begin(), merged_into.end(), 0);
  std::vector<bool> is_merged(graph.nodes.size(), false);
  for (const auto& [length, nodes] : bridges) {
    const auto [kept, gone] = nodes;
    if (is_merged[kept] || is_merged[gone]) continue;
    is_merged[kept] = is_merged[gone] = true;
    merged_into[gone] = kept;
    SkeletonNode& node = graph.nodes[kept];
    const double radius = std::max(node.radius, graph.nodes[gone].radius);
    node.position = 0.5 * (node.position + graph.nodes[gone].position);
    node.radius = radius + 0.5 * length;
  }
  for (auto& edge : graph.edges) {
    for (int& node : edge.nodes) node = merged_into[node];
    edge.points.front() = graph.nodes[edge.nodes[0]].position;
    edge.points.back() = graph.nodes[edge.nodes[1]].position;
  }
}

}  // namespace

double SkeletonEdge::Length() const {
  double length = 0.0;
  for (size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

std::vector<int> SkeletonGraph::Degrees() const {
  std::vector<int> degrees(nodes.size(), 0);
  for (const auto& edge : edges) {
    for (const int node : edge.nodes) ++degrees[node];
  }
  return degrees;
}

SkeletonGraph GraphOfSkeleton(const Image& skeleton, const Image& ink) {
  DAUMIER_CHECK(
      skeleton.height == ink.height && skeleton.width == ink.width && skeleton.channels == 1 && ink.channels == 1,
      "a skeleton of {} x {} x {} does not belong to ink of {} x {} x {}", skeleton.height, skeleton.width,
      skeleton.channels, ink.height, ink.width, ink.channels);
  return GraphBuilder(skeleton, ink).Build();
}

SkeletonGraph WithoutThinningArtefacts(SkeletonGraph graph, double max_protrusion) {
  while (RemoveShortestSpur(graph, max_protrusion)) {
  }
  MergeBridges(graph);
  std::erase_if(graph.edges, [&](const SkeletonEdge& edge) {
    return edge.nodes[0] == edge.nodes[1] && edge.points.size() > 1 &&
           edge.Length() <= 4.0 * graph.nodes[edge.nodes[0]].radius;
  });
  return graph;
}

}  // namespace daumier::render
