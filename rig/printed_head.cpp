#include "rig/printed_head.h"

#include "core/error.h"
#include "geometry/closed_surface.h"
#include "geometry/normals.h"
#include "geometry/orientation.h"
#include "geometry/topology.h"
#include "geometry/weld.h"
#include "rig/print_base.h"
#include "rig/texture_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace daumier::rig {
namespace {

constexpr double kLeastThicknessMm = 0.2, kUnderLowest = 0.2, kMmPerCm = 10;  // cm
constexpr double kApartMm = 0.002;

/// Head frame (y up, the face to +z) to print frame (z up): looking to -y, or up.
Eigen::Matrix3d PrintFromHead(bool faces_up) {
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return faces_up ? Eigen::Matrix3d::Identity() : upright;
}

/// With its attachments, without the cap of its neck.
geometry::TriangleMesh PosedMesh(const RiggedHead& head, const PrintPose& pose) {
  geometry::TriangleMesh mesh = JoinedMesh(head);
  for (const auto& [name, weight] : pose) {
    const auto found = std::ranges::find(head.targets.names, name);
    DAUMIER_CHECK(found != head.targets.names.end(), "the head has no target '{}' (its names: {})", name,
                  fmt::join(head.targets.names, ", "));
    const Eigen::VectorXd offset =
        (weight * head.targets.offsets.col(found - head.targets.names.begin())).cast<double>();
    Eigen::Map<Eigen::VectorXd>(mesh.vertices.data(), offset.size()) += offset;
  }
  std::vector<int> rows;
  for (int f = 0; f < mesh.triangles.rows(); ++f)
    if (!std::ranges::binary_search(head.neck_cap, f)) rows.push_back(f);
  std::vector<geometry::TriangleMesh> parts = {{mesh.vertices, mesh.triangles(rows, Eigen::all)}};
  for (const HeadAttachment& attachment : head.attachments) parts.push_back(attachment.mesh);
  return geometry::Joined(parts);
}

/// At most two triangles an edge, wound alike.
geometry::TriangleMesh ManifoldOf(const geometry::TriangleMesh& mesh, std::vector<std::string>& warnings) {
  const geometry::TriangleMesh welded = geometry::WeldedSurface(mesh, geometry::WeldTolerance(mesh.vertices));
  geometry::ManifoldSurface manifold = geometry::CutToManifold(welded);
  if (manifold.num_bad_edges == 0) return std::move(manifold.mesh);
  manifold = geometry::CutToManifold({welded.vertices, geometry::OrientOutwards(welded).triangles});
  if (manifold.num_bad_edges > 0)
    warnings.push_back(fmt::format(
        "{} edges have more than two triangles, or two that are wound against each other: the print is cut there and "
        "closed again. Join double faces in a modelling program (Blender: Merge by Distance, Select Non Manifold)",
        manifold.num_bad_edges));
  return std::move(manifold.mesh);
}

struct Shell {
  geometry::TriangleMesh mesh;
  std::vector<int> opening;  ///< Of the neck, not closed yet.
};

/// Closes all holes but the largest one that looks down, or back.
Shell ClosedBut(geometry::TriangleMesh part, bool is_main, PrintedHead& result) {
  Shell shell{std::move(part), {}};
  const auto loops = geometry::BoundaryLoops(shell.mesh.triangles, int(shell.mesh.vertices.rows()));
  std::optional<size_t> opening;
  if (is_main) {
    opening = OpeningTowards(shell.mesh, loops, -geometry::Vector3::UnitY());
    if (!opening) {
      opening = OpeningTowards(shell.mesh, loops, -geometry::Vector3::UnitZ());
      result.faces_up = opening.has_value();
    }
  }
  for (size_t i = 0; i < loops.size(); ++i) {
    if (opening == i) {
      shell.opening = loops[i];
      continue;
    }
    geometry::FillHole(loops[i], shell.mesh);
    ++result.num_holes;
  }
  return shell;
}

void Transform(const Eigen::Matrix3d& linear, geometry::TriangleMesh& mesh) {
  mesh.vertices = (mesh.vertices * linear.transpose()).eval();
}

/// Wound outwards; nothing if it has no thickness. In mm.
std::optional<geometry::TriangleMesh> Solid(geometry::TriangleMesh shell) {
  const double volume = geometry::EnclosedVolume(shell), area = geometry::TriangleAreas(shell).sum();
  if (2 * std::abs(volume) < kLeastThicknessMm * area) return std::nullopt;
  if (volume < 0) shell.triangles.col(1).swap(shell.triangles.col(2));
  return shell;
}

/// Moves vertices of equal coordinates apart, each towards its neighbours: a file has no vertices, and where fans meet at one place
/// its edges would have four triangles.
void SeparatePlaces(geometry::TriangleMesh& mesh) {
  const geometry::Adjacency neighbours = geometry::VertexNeighbours(mesh.triangles, int(mesh.vertices.rows()));
  std::set<std::array<float, 3>> taken;
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    const geometry::Vector3 place = mesh.vertices.row(v);
    geometry::Vector3 inwards = geometry::Vector3::Zero();
    for (const int n : neighbours[v]) inwards += mesh.vertices.row(n).transpose() - place;
    inwards = inwards.norm() > 0 ? inwards.normalized() : geometry::Vector3::UnitX();
    for (int step = 0;; ++step) {
      mesh.vertices.row(v) = (place + step * kApartMm * inwards).transpose();
      const Eigen::RowVector3f rounded = mesh.vertices.row(v).cast<float>();
      if (taken.insert({rounded[0], rounded[1], rounded[2]}).second) break;
    }
  }
}

}  // namespace

PrintedHead MakePrintedHead(const RiggedHead& head, const PrintPose& pose) {
  PrintedHead result;
  std::vector<geometry::TriangleMesh> parts =
      geometry::ConnectedParts(ManifoldOf(PosedMesh(head, pose), result.warnings));
  DAUMIER_CHECK(!parts.empty(), "the head has no triangles");
  const auto area = [](const geometry::TriangleMesh& part) { return geometry::TriangleAreas(part).sum(); };
  std::swap(parts.front(), *std::ranges::max_element(parts, {}, area));
  std::vector<Shell> shells;
  for (geometry::TriangleMesh& part : parts) shells.push_back(ClosedBut(std::move(part), shells.empty(), result));

  // In the frame of AddFlatBase, whose base looks to -y: a mask's back.
  Eigen::Matrix3d base_from_head = Eigen::Matrix3d::Identity();
  if (result.faces_up) base_from_head << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (Shell& shell : shells) {
    Transform(base_from_head, shell.mesh);
    lowest = std::min(lowest, shell.mesh.vertices.col(1).minCoeff());
  }
  const PrintBase base = AddFlatBase(shells.front().opening, lowest - kUnderLowest, shells.front().mesh);
  if (base == PrintBase::kCut)
    result.warnings.push_back(
        "no neck was found that could be extended to a flat base: the lowest hundredth is cut off instead");

  std::vector<geometry::TriangleMesh> solids;
  for (Shell& shell : shells) {
    Transform(kMmPerCm * PrintFromHead(result.faces_up) * base_from_head.transpose(), shell.mesh);
    if (auto solid = Solid(std::move(shell.mesh))) {
      solids.push_back(std::move(*solid));
    } else {
      ++result.num_thin;
    }
  }
  DAUMIER_CHECK(!solids.empty(), "the head is a sheet without thickness: nothing of it can be printed");
  result.num_shells = int(solids.size());
  result.mesh = geometry::Joined(solids);
  result.volume_cm3 = geometry::EnclosedVolume(result.mesh) / 1000;
  const Eigen::RowVector3d low = solids.front().vertices.colwise().minCoeff(),
                           high = solids.front().vertices.colwise().maxCoeff();
  result.mesh.vertices.rowwise() -= Eigen::RowVector3d(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), low[2]);
  SeparatePlaces(result.mesh);
  if (result.num_holes > 0)
    result.warnings.push_back(fmt::format("{} holes are closed in the print", result.num_holes));
  if (result.num_thin > 0)
    result.warnings.push_back(
        fmt::format("{} parts thinner than 0.2 mm are left out of the print (lashes, cards of hair)", result.num_thin));
  return result;
}

}  // namespace daumier::rig
