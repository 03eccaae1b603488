#include "raster/batch.h"

#include "core/error.h"
#include "raster/colour_picture.h"
#include "tests/raster/small_mesh.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

TEST(ForEachImage, PicturesAndGradientsDoNotDependOnTheNumberOfThreads) {
  constexpr int kNumImages = 12, kHeight = 30, kWidth = 33;
  const auto render = [&](int num_threads) {
    ThreadPool pool(num_threads - 1);
    std::vector<ColourPicture<float>> memory(kNumImages);
    std::vector<std::vector<float>> results(kNumImages);
    ForEachImage(
        kNumImages,
        [&](int i) {
          const Camera camera = {.focal = 150.0 + i, .centre_x = 16, .centre_y = 14, .distance = 9};
          const PositionedMesh<float> mesh = BumpyBall<float>(9, 0.7, camera, 0.1 * i);
          const auto colours = RandomNumbers<float>(mesh.positions.size() / 4 * 3, 1 + i);
          std::vector<float> picture(kHeight * kWidth * 4), by_position(mesh.positions.size()),
              by_colour(colours.size());
          memory[i].Forward(mesh.topology, mesh.positions.data(), colours.data(), kHeight, kWidth, {}, picture.data());
          memory[i].Backward(mesh.topology, picture.data(), by_position.data(), by_colour.data());
          results[i] = picture;
          results[i].insert(results[i].end(), by_position.begin(), by_position.end());
          results[i].insert(results[i].end(), by_colour.begin(), by_colour.end());
        },
        pool);
    return results;
  };
  const auto expected = render(1);
  EXPECT_EQ(render(2), expected);
  EXPECT_EQ(render(8), expected);
}

TEST(ForEachImage, ThrowsTheFirstError) {
  ThreadPool pool(3);
  testing::ExpectError(
      [&] {
        ForEachImage(
            20, [](int i) { DAUMIER_CHECK(i != 7 && i != 12, "image {} is broken", i); }, pool);
      },
      "image 7");
}

}  // namespace
}  // namespace daumier::raster
