#include "faces/face_parts.h"

#include "core/error.h"
#include "geometry/curvature.h"
#include "geometry/topology.h"

#include <algorithm>
#include <limits>

namespace daumier::faces {
namespace {

/// A seed lies between landmarks, or between landmarks and the hairline vertex (kHairline).
constexpr int kHairline = -1;
struct PartSeeds {
  std::string name, mirror;
  std::vector<std::vector<int>> seeds;  ///< Each the mean of these landmarks.
};

/// Landmarks 0..16 run along the jaw from the face's right ear to its left, 17..26 along the brows, 36..47 around the
/// eyes, 48..67 around the mouth. The nose and the ears are regions of the annotation.
const std::vector<PartSeeds>& Parts() {
  static const std::vector<PartSeeds> parts = {
      {"nose", "nose", {}},
      {"chin", "chin", {{7}, {8}, {9}, {8, 57}}},
      {"mouth", "mouth", {{48}, {50}, {51}, {52}, {54}, {56}, {57}, {58}, {62}, {66}}},
      {"forehead", "forehead", {{kHairline}, {19, kHairline}, {24, kHairline}, {21, 22, kHairline}}},
      {"jaw_left", "jaw_right", {{10}, {11}, {12}, {13}}},
      {"jaw_right", "jaw_left", {{3}, {4}, {5}, {6}}},
      {"cheek_left", "cheek_right", {{46, 54}, {45, 13}, {35, 14}, {14, 45}, {15, 35}}},
      {"cheek_right", "cheek_left", {{41, 48}, {36, 3}, {31, 2}, {2, 36}, {1, 31}}},
      {"brow_left", "brow_right", {{22}, {23}, {24}, {25}, {26}}},
      {"brow_right", "brow_left", {{17}, {18}, {19}, {20}, {21}}},
      {"eye_left", "eye_right", {{42}, {43}, {44}, {45}, {46}, {47}}},
      {"eye_right", "eye_left", {{36}, {37}, {38}, {39}, {40}, {41}}},
      {"ear_left", "ear_right", {}},
      {"ear_right", "ear_left", {}}};
  return parts;
}

int IndexOf(const std::string& name) {
  const auto& names = FacePartNames();
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

struct Seed {
  int part;
  geometry::Vector3 position;
};

std::vector<Seed> SeedsOf(const FaceTemplate& face) {
  constexpr int kNone = -1;
  std::vector<Seed> seeds;
  for (const PartSeeds& part : Parts()) {
    for (const std::vector<int>& between : part.seeds) {
      Seed& seed = seeds.emplace_back(Seed{IndexOf(part.name), geometry::Vector3::Zero()});
      for (const int landmark : between) {
        const int vertex =
            landmark == kHairline ? face.annotation.hairline_vertex : face.annotation.landmarks.at(landmark);
        seed.position += face.neutral.row(vertex).transpose() / between.size();
      }
    }
  }
  for (const int v : RegionFor(face.annotation, "neck_border", "a division into parts"))
    seeds.push_back({kNone, face.neutral.row(v)});
  return seeds;
}

}  // namespace

const std::vector<std::string>& FacePartNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const PartSeeds& part : Parts()) result.push_back(part.name);
    return result;
  }();
  return names;
}

FaceParts MakeFaceParts(const FaceTemplate& face_template, int blend_rings) {
  const auto region = [&](const char* name) -> const std::vector<int>& {
    return RegionFor(face_template.annotation, name, "a division into parts");
  };
  const int num_vertices = face_template.num_vertices(), num_parts = static_cast<int>(Parts().size());
  FaceParts parts;
  parts.names = FacePartNames();
  for (const PartSeeds& part : Parts()) parts.mirror.push_back(IndexOf(part.mirror));

  Eigen::MatrixXd hard = Eigen::MatrixXd::Zero(num_vertices, num_parts);
  const std::vector<Seed> seeds = SeedsOf(face_template);
  for (const int v : region("face")) {
    const geometry::Vector3 point = face_template.neutral.row(v);
    const auto nearest = std::min_element(seeds.begin(), seeds.end(), [&](const Seed& a, const Seed& b) {
      return (a.position - point).squaredNorm() < (b.position - point).squaredNorm();
    });
    if (nearest->part >= 0) hard(v, nearest->part) = 1;
  }
  const auto assign = [&](const std::vector<int>& vertices, const auto& part_of) {
    for (const int v : vertices) {
      hard.row(v).setZero();
      hard(v, part_of(v)) = 1;
    }
  };
  const int ear_left = IndexOf("ear_left"), ear_right = IndexOf("ear_right"), nose = IndexOf("nose");
  assign(region("ears"), [&](int v) { return face_template.neutral(v, 0) > 0 ? ear_left : ear_right; });
  assign(region("nose"), [&](int) { return nose; });

  const auto neighbours = geometry::VertexNeighbours(face_template.triangles, num_vertices);
  const Eigen::VectorXd equal = Eigen::VectorXd::Ones(num_vertices);
  parts.weights.resize(num_vertices, num_parts);
  for (int p = 0; p < num_parts; ++p)
    parts.weights.col(p) = geometry::SmoothOverRings(hard.col(p), equal, neighbours, blend_rings);
  const std::vector<int>& mirror = face_template.annotation.mirror;
  if (mirror.empty()) return parts;
  // Vertices that are equally near to two seeds went to the first one.
  const Eigen::MatrixXd mirrored = parts.weights(mirror, parts.mirror);
  parts.weights = (parts.weights + mirrored) / 2;
  return parts;
}

}  // namespace daumier::faces
