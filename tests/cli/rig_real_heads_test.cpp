// `daumier rig` of heads that other people made. What is right is known of slits alone: of FaceWarehouse's topology by the
// borders of its holes.
// Without data: RigOfForeignHeads (this folder) and ForeignHeads.TakeNoPlaceForTheOtherSideOfASlit (tests/rig), of heads with known truth.
#include "core/files.h"
#include "core/json.h"
#include "faces/import/mesh_folder.h"
#include "geometry/topology.h"
#include "geometry/triangulate.h"
#include "gltf/head_reader.h"
#include "rig/arkit_names.h"
#include "tests/cli/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;

/// The vertices of the borders of a slit, without its corners.
struct SlitBorders {
  std::vector<int> upper, lower;
};

class RigOfRealHeads : public ::testing::Test {
 protected:
  void Rig(const fs::path& file) {
    mesh_ = faces::ReadMesh(file);
    result_ = Daumier({"rig", file.string(), "--out", (folder_ / "head.glb").string(), "--json"});
    ASSERT_EQ(result_.exit_code, 0) << result_.err;
    head_ = gltf::ReadHead(folder_ / "head.glb");
    ASSERT_EQ(std::ssize(head_.of_file_vertices), mesh_.vertices.rows()) << "vertices keep their order";
  }

  /// How far a target moves a vertex of the mesh up, cm.
  double Rise(const char* target, int vertex) const {
    const int v = head_.of_file_vertices[size_t(vertex)];
    return head_.head.targets.offsets(3 * v + 1, rig::FindArkitName(target).value());
  }

  /// How much farther apart a target moves the borders at each upper vertex, cm: from its neighbour below.
  std::vector<double> Openings(const char* target, const SlitBorders& borders) const {
    std::vector<double> openings;
    for (const int u : borders.upper) {
      const auto distance = [&](int l) { return std::abs(mesh_.vertices(u, 0) - mesh_.vertices(l, 0)); };
      const int below = *std::ranges::min_element(borders.lower, {}, distance);
      openings.push_back(Rise(target, u) - Rise(target, below));
    }
    return openings;
  }

  /// Borders move apart (sign 1) or together (-1) everywhere: a vertex that moves with the other side does not.
  void ExpectNoWrongVertex(const char* target, double sign, double least_cm, const SlitBorders& borders) const {
    ASSERT_GT(borders.upper.size(), 5u);
    ASSERT_GT(borders.lower.size(), 5u);
    std::vector<double> openings = Openings(target, borders);
    for (double& opening : openings) opening *= sign;
    std::vector<double> sorted = openings;
    std::ranges::sort(sorted);
    const double median = sorted[sorted.size() / 2];
    EXPECT_GT(median, least_cm) << target;
    EXPECT_EQ(std::ranges::count_if(openings, [&](double opening) { return opening < 0.25 * median; }), 0)
        << target << ": the least is " << sorted.front() << " cm, the median " << median;
  }

  const TempDir folder_;
  geometry::PolygonMesh mesh_;
  ProcessResult result_;
  gltf::HeadInFile head_;
};

/// The halves of a hole's border, without a sixth of its width at each corner.
SlitBorders HalvesOf(const std::vector<int>& loop, const geometry::Points& vertices) {
  const auto x = [&](int v) { return vertices(v, 0); };
  const auto right = std::ranges::min_element(loop, {}, x), left = std::ranges::max_element(loop, {}, x);
  const double low = x(*right), high = x(*left), corner = (high - low) / 6;
  SlitBorders halves;
  for (auto v = loop.begin(); v != loop.end(); ++v) {
    if (x(*v) < low + corner || x(*v) > high - corner) continue;
    const bool is_between = (v > std::min(right, left)) && (v < std::max(right, left));
    (is_between ? halves.upper : halves.lower).push_back(*v);
  }
  const auto height = [&](const std::vector<int>& half) { return vertices(half, 1).mean(); };
  if (height(halves.upper) < height(halves.lower)) std::swap(halves.upper, halves.lower);
  return halves;
}

TEST_F(RigOfRealHeads, OfFaceWarehousesTopologyMixesNeitherLipsNorLids) {
  const auto data = SharedData();
  if (!data) GTEST_SKIP() << "there is no head of FaceWarehouse's topology; set DAUMIER_SHARED_DATA";
  ASSERT_NO_FATAL_FAILURE(Rig(*data / "facewarehouse_topology/warehouse_0.obj"));
  const geometry::TriangleMesh mesh = geometry::TriangulateMesh(mesh_);
  int num_eyes = 0, num_mouths = 0;
  for (const std::vector<int>& loop : geometry::BoundaryLoops(mesh.triangles, int(mesh.vertices.rows()))) {
    if (loop.size() != 34 && loop.size() != 68) continue;
    const SlitBorders borders = HalvesOf(loop, mesh.vertices);
    if (loop.size() == 68) {
      ++num_mouths;
      ExpectNoWrongVertex("jawOpen", 1, 1, borders);
    } else {
      ++num_eyes;
      const bool is_left = mesh.vertices(loop.front(), 0) > 0;  // The head faces +z.
      ExpectNoWrongVertex(is_left ? "eyeBlinkLeft" : "eyeBlinkRight", -1, 0.3, borders);
    }
  }
  EXPECT_EQ(num_mouths, 1);
  EXPECT_EQ(num_eyes, 2);
}

}  // namespace
}  // namespace daumier::testing
