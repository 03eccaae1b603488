// The renderer as a library of its own: finds the pose of a box by gradient descent on a picture of it.
//   cmake --install build/release --component raster --prefix PREFIX
//   cmake -S docs/examples -B build/fit_pose -DCMAKE_PREFIX_PATH=PREFIX && cmake --build build/fit_pose
//   build/fit_pose/fit_pose
#include <daumier/raster/camera.h>
#include <daumier/raster/colour_picture.h>
#include <daumier/raster/rigid_pose.h>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace daumier::raster;

namespace {

// A box of 6 x 8 x 10 cm, a colour a corner.
const std::vector<double> box = {-3, -4, -5, 3, -4, -5, 3, 4, -5, -3, 4, -5, -3, -4, 5, 3, -4, 5, 3, 4, 5, -3, 4, 5};
const std::vector<double> colours = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 1, 0, 1, 0, 1, 1, 1, 1, 1, .3, .3, .3};
const std::vector<int> corners = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                  2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 0, 4, 7, 0, 7, 3};
const MeshTopology topology = MakeTopology(corners, 8);
const Camera camera = {.focal = 500, .centre_x = 48, .centre_y = 48, .distance = 100, .height = 96, .width = 96};

/// The picture of a pose; and, given the gradient of a loss by the picture, that by the pose.
struct BoxRenderer {
  ColourPicture<double> memory;
  std::vector<double> posed = std::vector<double>(24), positions = std::vector<double>(32);

  std::vector<double> Picture(const Pose<double>& pose) {
    std::vector<double> picture(96 * 96 * 4);
    ApplyPose(pose, 8, box.data(), posed.data());
    Project(camera, 8, posed.data(), positions.data());
    memory.Forward(topology, positions.data(), colours.data(), 96, 96, {}, picture.data());
    return picture;
  }

  Pose<double> Gradient(const Pose<double>& pose, const std::vector<double>& by_picture) {
    std::vector<double> by_positions(32), by_colours(24), by_posed(24, 0.0);
    memory.Backward(topology, by_picture.data(), by_positions.data(), by_colours.data());
    ProjectBackward(camera, 8, by_positions.data(), by_posed.data());
    Pose<double> by_pose = {};
    ApplyPoseBackward<double>(pose, 8, box.data(), by_posed.data(), by_pose, nullptr);
    return by_pose;
  }
};

}  // namespace

int main() {
  BoxRenderer renderer;
  const Pose<double> truth = {0.3, -0.4, 0.2, 0.8, -0.5, 3};
  const std::vector<double> target = renderer.Picture(truth);
  Pose<double> pose = {0.1, -0.1, 0, 0, 0, 0}, mean = {}, square = {};
  for (int step = 1; step <= 300; ++step) {
    const std::vector<double> picture = renderer.Picture(pose);
    std::vector<double> by_picture(picture.size());
    double loss = 0;
    for (size_t i = 0; i < picture.size(); ++i) {
      const double difference = picture[i] - target[i];
      loss += difference * difference;
      by_picture[i] = 2 * difference;
    }
    const Pose<double> gradient = renderer.Gradient(pose, by_picture);
    const double rate = step < 200 ? 1 : 0.1;
    for (int k = 0; k < 6; ++k) {  // Adam
      mean[k] = 0.9 * mean[k] + 0.1 * gradient[k];
      square[k] = 0.99 * square[k] + 0.01 * gradient[k] * gradient[k];
      const double size = (k < 3 ? 0.01 : 0.05) * rate;
      pose[k] -=
          size * mean[k] / (1 - std::pow(0.9, step)) / (std::sqrt(square[k] / (1 - std::pow(0.99, step))) + 1e-12);
    }
    if (step % 50 == 0 || step == 1) std::printf("step %3d  loss %10.4f\n", step, loss);
  }
  double worst = 0;
  for (int k = 0; k < 6; ++k) {
    std::printf("%s %8.4f, true %8.4f\n", k < 3 ? "angle (rad)   " : "position (cm) ", pose[k], truth[k]);
    if (k < 3) worst = std::max(worst, std::abs(pose[k] - truth[k]));
  }
  return worst < 0.01 ? 0 : 1;
}
