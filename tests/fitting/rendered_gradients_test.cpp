// Gradients of the renderer on a face against central differences of an 8 x 8 supersampled render of it: a silhouette loss
// and a photometric loss, by pose, identity modes and expressions. Here, because this room sees faces and renderer.
#include "raster/camera.h"
#include "raster/colour_picture.h"
#include "raster/rigid_pose.h"
#include "raster/spherical_harmonics.h"
#include "raster/vertex_normals.h"
#include "tests/support/ict_head.h"
#include "tests/support/paths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace daumier::fitting {
namespace {

using namespace raster;
using Numbers = std::vector<double>;

constexpr int kSide = 224, kFine = 8, kPoseNumbers = 6;
const std::vector<std::string> kModes = {"identity000", "identity001", "identity002", "identity003",
                                         "identity004", "identity005", "identity006", "identity007",
                                         "jawOpen",     "eyeBlink_L",  "mouthSmile_L"};

struct HeadScene {
  MeshTopology topology;
  int64_t num_vertices = 0;
  Numbers neutral, colours;
  std::vector<Numbers> modes;

  /// parameters: pose, then a weight a mode.
  Numbers Positions(const Numbers& parameters) const {
    Numbers vertices = neutral, positions(4 * num_vertices);
    for (size_t m = 0; m < modes.size(); ++m) {
      for (size_t i = 0; i < vertices.size(); ++i) vertices[i] += parameters[kPoseNumbers + m] * modes[m][i];
    }
    Pose<double> pose;
    std::copy_n(parameters.begin(), kPoseNumbers, pose.begin());
    ApplyPose(pose, num_vertices, vertices.data(), vertices.data());
    Project(Camera{}, num_vertices, vertices.data(), positions.data());
    return positions;
  }

  /// RGB and coverage, the mean of kFine x kFine samples a pixel.
  Numbers Supersampled(Numbers positions) const {
    for (int64_t v = 0; v < num_vertices; ++v) positions[4 * v] *= kFine, positions[4 * v + 1] *= kFine;
    constexpr int kFineSide = kSide * kFine;
    Numbers fine(size_t(kFineSide) * kFineSide * 4), picture(kSide * kSide * 4);
    ColourPicture<double> renderer;
    // No silhouette is in front of something farther away than this: nothing is antialiased.
    renderer.Forward(topology, positions.data(), colours.data(), kFineSide, kFineSide,
                     {.antialias = {.depth_margin = -1e30}}, fine.data());
    EXPECT_TRUE(renderer.crossings().empty());
    for (int row = 0; row < kFineSide; ++row) {
      for (int column = 0; column < kFineSide; ++column) {
        for (int k = 0; k < 4; ++k) {
          picture[4 * ((row / kFine) * kSide + column / kFine) + k] +=
              fine[4 * (size_t(row) * kFineSide + column) + k] / (kFine * kFine);
        }
      }
    }
    return picture;
  }
};

HeadScene LoadHeadScene(const std::filesystem::path& archive) {
  const testing::IctHead head = testing::LoadIctHead(archive, kModes);
  geometry::Points points = head.neutral.vertices;
  Eigen::RowVector3d middle = (points.colwise().minCoeff() + points.colwise().maxCoeff()) / 2;
  middle[2] = 5;
  points.rowwise() -= middle;
  HeadScene scene;
  scene.num_vertices = points.rows();
  scene.topology =
      MakeTopology({head.neutral.triangles.data(), size_t(head.neutral.triangles.size())}, int(points.rows()));
  scene.neutral.assign(points.data(), points.data() + points.size());
  for (const std::string& name : kModes) {
    const geometry::Points& shape = head.shapes.at(name);
    scene.modes.emplace_back(shape.data(), shape.data() + shape.size());
  }
  NormalMemory<double> memory;
  Numbers normals(scene.neutral.size()), shades(scene.num_vertices);
  VertexNormals(scene.topology, scene.neutral.data(), memory, normals.data());
  Shade({0.2, -0.2, 0.3, 0.15, 0.05, 0.02, 0.03, 0.04, -0.03}, scene.num_vertices, normals.data(), shades.data());
  scene.colours.resize(scene.neutral.size());
  for (size_t i = 0; i < scene.colours.size(); ++i) {
    const double *const p = &scene.neutral[i / 3 * 3], pattern = std::sin(1.3 * p[1] + double(i % 3));
    scene.colours[i] = (0.6 + 0.2 * pattern * std::cos(0.9 * p[0])) * shades[i / 3];
  }
  return scene;
}

TEST(RenderedGradients, OfSilhouetteAndPhotometricLossEqualThoseOfASupersampledRender) {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::exists(*shared / "ict-facekit.tar.xz")) {
    GTEST_SKIP() << "ict-facekit.tar.xz is not there; set DAUMIER_SHARED_DATA";
  }
  const HeadScene scene = LoadHeadScene(*shared / "ict-facekit.tar.xz");
  Numbers at(kPoseNumbers + kModes.size());
  for (const auto& [index, number] : {std::pair(0, 0.1), {2, 0.05}, {3, 0.3}, {4, -0.2}, {5, -25.0}})
    at[index] = number;
  Numbers target = at;
  target[0] += 0.03, target[1] += 0.04, target[3] += 0.15, target[4] -= 0.1;
  for (int i = 0; i < 8; ++i) target[kPoseNumbers + i] = i % 2 == 1 ? 0.6 : -0.5;
  target[14] = 0.25, target[15] = 0.4, target[16] = 0.3;

  const Numbers positions = scene.Positions(at), shown = scene.Supersampled(positions),
                wanted = scene.Supersampled(scene.Positions(target));
  std::array<Numbers, 2> weights;  // Of the silhouette, of the colours.
  for (int loss = 0; loss < 2; ++loss) {
    weights[loss].resize(shown.size());
    for (size_t i = 0; i < shown.size(); ++i) weights[loss][i] = (i % 4 == 3) == (loss == 0) ? shown[i] - wanted[i] : 0;
  }
  ColourPicture<double> renderer;
  Numbers picture(shown.size());
  renderer.Forward(scene.topology, positions.data(), scene.colours.data(), kSide, kSide, {}, picture.data());
  std::array<Numbers, 2> by_positions;
  for (int loss = 0; loss < 2; ++loss) {
    by_positions[loss].resize(positions.size());
    Numbers by_colours(scene.colours.size());
    renderer.Backward(scene.topology, weights[loss].data(), by_positions[loss].data(), by_colours.data());
  }
  std::array<double, 2> products = {}, squares = {}, true_squares = {}, errors = {};
  for (size_t d = 0; d < at.size(); ++d) {
    const auto moved = [&](double by) {
      Numbers parameters = at;
      parameters[d] += by;
      return scene.Positions(parameters);
    };
    const Numbers above = moved(1e-5), below = moved(-1e-5);
    double fastest = 0;  // Pixels for a unit of the parameter.
    for (size_t i = 0; i < above.size(); i += 4) {
      const double dx = above[i] / above[i + 3] - below[i] / below[i + 3];
      const double dy = above[i + 1] / above[i + 3] - below[i + 1] / below[i + 3];
      fastest = std::max(fastest, std::hypot(dx, dy) / 2e-5);
    }
    const double step = 0.5 / fastest;
    const Numbers after = scene.Supersampled(moved(step)), before = scene.Supersampled(moved(-step));
    for (int loss = 0; loss < 2; ++loss) {
      double expected = 0, got = 0;
      for (size_t i = 0; i < after.size(); ++i) expected += weights[loss][i] * (after[i] - before[i]);
      for (size_t i = 0; i < above.size(); ++i) {
        if (i % 4 != 2) got += by_positions[loss][i] * (above[i] - below[i]) / 2e-5 * 2 * step;
      }
      products[loss] += got * expected, squares[loss] += got * got, true_squares[loss] += expected * expected;
      errors[loss] += (got - expected) * (got - expected);
    }
  }
  const double most_error[2] = {0.05, 0.09};
  for (int loss = 0; loss < 2; ++loss) {
    const double cosine = products[loss] / std::sqrt(squares[loss] * true_squares[loss]);
    const double error = std::sqrt(errors[loss] / true_squares[loss]);
    RecordProperty(loss == 0 ? "silhouette" : "photometric", fmt::format("cosine {:.5f} error {:.4f}", cosine, error));
    EXPECT_GE(cosine, 0.999) << loss;
    EXPECT_LE(error, most_error[loss]) << loss;
  }
}

}  // namespace
}  // namespace daumier::fitting
