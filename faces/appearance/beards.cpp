#include "faces/appearance/beards.h"

#include "faces/appearance/scalp.h"
#include "faces/appearance/skin_fields.h"
#include "faces/controls/soft_region.h"
#include "geometry/curvature.h"
#include "geometry/topology.h"

#include <cmath>
#include <map>

namespace daumier::faces {
namespace {

constexpr SoupKind kBeardKind{PictureClass::kHair, PicturePart::kBeard};
constexpr double kLeastBeardWeight = 0.2;

Eigen::VectorXd BothSides(const SoftRegion& region, const FaceTemplate& face) {
  return 1 - (1 - WeightsOf(region, face).array()) * (1 - WeightsOf(Mirrored(region), face).array());
}

Eigen::VectorXd Either(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.cwiseMax(b);
}

Eigen::VectorXd BeardWeights(const FaceTemplate& face, BeardStyle style) {
  const auto moustache = [&] {
    return BothSides(
        {{{{54}, {0.025, 0.002, 0}}, {{35, 53}, {0.02, -0.012, 0}}, {{33, 51}, {0, -0.004, 0}}}, {0.042, 0.040, 0.15}},
        face);
  };
  const auto chin = [&](double wide) {
    return BothSides({{{{8}, {0, 0.0, -0.05}}, {{8}, {0, 0.05, 0}}, {{8, 57}, {0.02, 0, 0}}}, {wide, 0.09, 0.25}},
                     face);
  };
  const auto jaw = [&](double wide) {
    return BothSides(
        {{{{16}, {0, -0.02, 0}}, {{15}}, {{14}}, {{13}}, {{12}}, {{11}}, {{10}}, {{9}}, {{8}}}, {wide, wide, 0.22}},
        face);
  };
  const auto corners = [&] {
    return BothSides({{{{54}, {0.05, -0.01, 0}}, {{55, 10}, {0.02, 0, 0}}}, {0.045, 0.05, 0.2}}, face);
  };
  switch (style) {
    case BeardStyle::kMoustache:
      return moustache();
    case BeardStyle::kGoatee:
      return Either(Either(moustache(), chin(0.10)), corners());
    case BeardStyle::kFull:
    case BeardStyle::kLong:
      return Either(Either(moustache(), chin(0.14)), Either(jaw(0.115), corners()));
    case BeardStyle::kChinStrap:
      return Either(jaw(0.055), chin(0.07));
    default:
      return Eigen::VectorXd::Zero(face.num_vertices());
  }
}

}  // namespace

BeardShells::BeardShells(const FaceTemplate& face) {
  const int num_vertices = face.num_vertices();
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(face.triangles, num_vertices);
  const Eigen::VectorXd lips =
      geometry::SmoothOverRings(LipIndicator(face), Eigen::VectorXd::Ones(num_vertices), neighbours, 1);
  const Eigen::VectorXd hanging = WeightsOf({{{{8}, {0, 0.01, 0}}}, {0.17, 0.13, 0.25}}, face);
  const double length = 0.05 * EyeSpan(face);
  for (size_t s = 1; s < shells_.size(); ++s) {
    const Eigen::VectorXd weights =
        BeardWeights(face, static_cast<BeardStyle>(s)).array() * (1 - lips.array()).square();
    Shell& shell = shells_[s];
    std::vector<int> row(size_t(num_vertices), -1);
    std::map<std::array<int, 2>, int> edges;
    for (const auto& t : face.triangles.rowwise()) {
      if (weights[t[0]] < kLeastBeardWeight && weights[t[1]] < kLeastBeardWeight && weights[t[2]] < kLeastBeardWeight)
        continue;
      Eigen::Vector3i triangle;
      for (int k = 0; k < 3; ++k) {
        int& r = row[size_t(t[k])];
        if (r < 0) {
          r = static_cast<int>(shell.vertices.size());
          shell.vertices.push_back(t[k]);
          shell.weights.push_back(weights[t[k]]);
          shell.chin.push_back(hanging[t[k]]);
          const auto& l = face.annotation.landmarks;
          shell.bulk.push_back(
              0.35 + 0.65 * SmoothBetween(face.neutral(l[16], 1), face.neutral(l[12], 1), face.neutral(t[k], 1)));
          const double x = std::abs(face.neutral(t[k], 0)) / length, y = face.neutral(t[k], 1) / length;
          shell.waves.push_back(0.6 * std::sin(2.6 * x + 0.5 * y) + 0.4 * std::sin(4.3 * x - 1.9 * y + 1));
        }
        triangle[k] = r;
      }
      shell.triangles.push_back(triangle);
      for (int k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges)
      if (edges.count({edge[1], edge[0]}) == 0) shell.border.push_back(edge);
  }
}

void BeardShells::AddBeard(const geometry::Points& face, const geometry::Points& normals, const Looks& looks,
                           double size, HeadSoup& soup) const {
  if (looks.beard == BeardStyle::kNone) return;
  const Shell& shell = shells_[static_cast<size_t>(looks.beard)];
  const bool is_long = looks.beard == BeardStyle::kLong;
  double thickness = size * looks.beard_length;
  switch (looks.beard) {
    case BeardStyle::kChinStrap:
      thickness *= 0.45;
      break;
    case BeardStyle::kMoustache:
    case BeardStyle::kGoatee:
      thickness *= 0.75;
      break;
    default:
      thickness *= 1.0;
  }
  const int first = soup.size(), count = static_cast<int>(shell.vertices.size());
  for (int i = 0; i < count; ++i) {
    const int v = shell.vertices[size_t(i)];
    const double w = 2 * shell.weights[size_t(i)] - 1, wave = shell.waves[size_t(i)];
    const double over = w > 0 ? thickness * shell.bulk[size_t(i)] * std::sqrt(w) * (0.9 + 0.22 * wave) : 0.5 * size * w;
    const geometry::Vector3 point = face.row(v), normal = normals.row(v);
    geometry::Vector3 moved = point + over * normal;
    if (w > 0) {
      const double hang =
          (is_long ? 6.5 : 0.9) * size * looks.beard_length * SmoothBetween(0.25, 1.0, shell.chin[size_t(i)] * w);
      moved += hang * geometry::Vector3(0, -1, 0.3);
    }
    const auto light = static_cast<float>(0.95 + 0.14 * wave);
    soup.AddVertex(moved, light * looks.beard_colour);
  }
  for (int i = 0; i < count; ++i) {
    const int v = shell.vertices[size_t(i)];
    soup.AddVertex(face.row(v).transpose() - 0.45 * size * normals.row(v).transpose(), 0.6f * looks.beard_colour);
  }
  for (const Eigen::Vector3i& t : shell.triangles) {
    soup.AddTriangle(first + t[0], first + t[1], first + t[2], kBeardKind);
    soup.AddTriangle(first + count + t[0], first + count + t[2], first + count + t[1], kBeardKind);
  }
  for (const auto& [a, b] : shell.border)
    soup.AddQuad(first + b, first + a, first + count + a, first + count + b, kBeardKind);
}

}  // namespace daumier::faces
