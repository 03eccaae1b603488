#include "raster/texture.h"

#include "tests/raster/small_mesh.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::raster {
namespace {

using testing::ExpectError;

Texture<double> RandomTexture(int height, int width, int channels) {
  return {height, width, channels, RandomNumbers<double>(size_t(height) * width * channels, 5)};
}

std::vector<double> Values(const Texture<double>& texture, Wrap wrap, const std::vector<double>& uv) {
  std::vector<double> values(uv.size() / 2 * texture.num_channels);
  LookUpTexture(texture, wrap, int64_t(uv.size() / 2), uv.data(), nullptr, values.data());
  return values;
}

TEST(LookUpTexture, AtTheCentresOfTexelsIsTheTexel) {
  const Texture<double> texture = RandomTexture(4, 6, 2);
  for (const Wrap wrap : {Wrap::kClamp, Wrap::kRepeat}) {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 6; ++column) {
        const auto value = Values(texture, wrap, {(column + 0.5) / 6, 1 - (row + 0.5) / 4});
        EXPECT_NEAR(value[0], texture.texels[(row * 6 + column) * 2], 1e-12);
        EXPECT_NEAR(value[1], texture.texels[(row * 6 + column) * 2 + 1], 1e-12);
      }
    }
  }
}

TEST(LookUpTexture, BetweenTexelsIsTheirMeanAndBeyondTheBorderAsWrapSays) {
  const Texture<double> texture{1, 2, 1, {10, 20}};
  EXPECT_NEAR(Values(texture, Wrap::kClamp, {0.5, 0.5})[0], 15, 1e-12);
  EXPECT_NEAR(Values(texture, Wrap::kClamp, {0.05, 0.5})[0], 10, 1e-12);
  EXPECT_NEAR(Values(texture, Wrap::kClamp, {7, -3})[0], 20, 1e-12);
  EXPECT_NEAR(Values(texture, Wrap::kRepeat, {0, 0.5})[0], 15, 1e-12);
  EXPECT_NEAR(Values(texture, Wrap::kRepeat, {1.25, 0.5})[0], 10, 1e-12);
  EXPECT_NEAR(Values(texture, Wrap::kRepeat, {-0.25, 4.5})[0], 20, 1e-12);
}

TEST(LookUpTexture, IsZeroWhereNothingIsShown) {
  const std::vector<double> uv = {0.5, 0.5, 0.5, 0.5};
  const std::vector<int> shown = {-1, 3};
  std::vector<double> values(2, 9.0);
  LookUpTexture<double>({1, 1, 1, {4}}, Wrap::kClamp, 2, uv.data(), shown.data(), values.data());
  EXPECT_EQ(values, (std::vector<double>{0, 4}));
}

TEST(LookUpTexture, GradientsEqualCentralDifferences) {
  const Texture<double> texture = RandomTexture(5, 4, 3);
  const auto uv = RandomNumbers<double>(40, 1), weights = RandomNumbers<double>(60, 2);
  for (const Wrap wrap : {Wrap::kClamp, Wrap::kRepeat}) {
    std::vector<double> by_texels(60), by_uv(40);
    LookUpTextureBackward(texture, wrap, 20, uv.data(), nullptr, weights.data(), by_texels.data(), by_uv.data());
    EXPECT_LT(MaxDifference([&](const auto& x) { return Dot(weights, Values(texture, wrap, x)); }, uv, by_uv), 1e-7);
    const auto of_texels = [&](const std::vector<double>& x) { return Dot(weights, Values({5, 4, 3, x}, wrap, uv)); };
    EXPECT_LT(MaxDifference(of_texels, texture.texels, by_texels), 1e-7);
  }
}

TEST(MakeMipMap, HalvesByMeansUntilASideIsOdd) {
  const MipMap<double> levels = MakeMipMap<double>({2, 4, 1, {1, 3, 5, 7, 1, 3, 5, 7}});
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[1].texels, (std::vector<double>{2, 6}));
  EXPECT_EQ(levels[2].texels, (std::vector<double>{4}));
  EXPECT_EQ(MakeMipMap(RandomTexture(12, 8, 1)).size(), 3u);  // 12 x 8, 6 x 4, 3 x 2
}

TEST(ChooseLevels, IsTheLogarithmOfTexelsAPixel) {
  const MipMap<double> levels = MakeMipMap(RandomTexture(8, 16, 1));
  const std::vector<double> slopes = {2.0 / 16, 0, 0, 1.0 / 8, 0.01, 0, 0, 0.01, 0, 3.0 / 16, 0, 4.0 / 8, 9, 9, 9, 9};
  std::vector<double> at(4);
  ChooseLevels(levels, 4, slopes.data(), at.data());
  EXPECT_NEAR(at[0], 1, 1e-12);
  EXPECT_EQ(at[1], 0);
  EXPECT_NEAR(at[2], std::log2(5), 1e-12);
  EXPECT_EQ(at[3], double(levels.size() - 1));
}

std::vector<double> MipValues(const MipMap<double>& levels, const std::vector<double>& uv,
                              const std::vector<double>& at) {
  std::vector<double> values(at.size() * levels[0].num_channels);
  LookUpMipMap(levels, Wrap::kRepeat, int64_t(at.size()), uv.data(), at.data(), nullptr, values.data());
  return values;
}

TEST(LookUpMipMap, AtWholeLevelsIsTheLookUpThereAndBetweenThemLinear) {
  const MipMap<double> levels = MakeMipMap(RandomTexture(8, 8, 2));
  const std::vector<double> uv = {0.3, 0.7};
  for (size_t level = 0; level < levels.size(); ++level) {
    const auto expected = Values(levels[level], Wrap::kRepeat, uv), got = MipValues(levels, uv, {double(level)});
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(got[k], expected[k], 1e-12);
  }
  const auto near = Values(levels[1], Wrap::kRepeat, uv), far = Values(levels[2], Wrap::kRepeat, uv);
  EXPECT_NEAR(MipValues(levels, uv, {1.25})[0], 0.75 * near[0] + 0.25 * far[0], 1e-12);
}

TEST(LookUpMipMap, GradientsEqualCentralDifferences) {
  const Texture<double> texture = RandomTexture(8, 4, 2);
  const MipMap<double> levels = MakeMipMap(texture);
  const auto uv = RandomNumbers<double>(24, 1), weights = RandomNumbers<double>(24, 2);
  std::vector<double> at = RandomNumbers<double>(12, 3);
  for (double& level : at) level = 1.2 + 1.3 * level;
  MipMap<double> level_gradients = levels;
  for (auto& level : level_gradients) std::fill(level.texels.begin(), level.texels.end(), 0.0);
  std::vector<double> by_uv(24);
  LookUpMipMapBackward(levels, Wrap::kRepeat, 12, uv.data(), at.data(), nullptr, weights.data(), &level_gradients,
                       by_uv.data());
  MipMapBackward(level_gradients);
  EXPECT_LT(MaxDifference([&](const auto& x) { return Dot(weights, MipValues(levels, x, at)); }, uv, by_uv), 1e-7);
  const auto of_texels = [&](const std::vector<double>& x) {
    return Dot(weights, MipValues(MakeMipMap<double>({8, 4, 2, x}), uv, at));
  };
  EXPECT_LT(MaxDifference(of_texels, texture.texels, level_gradients[0].texels), 1e-7);
}

TEST(LookUpTexture, RefusesEmptyTexturesAndCoordinatesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ExpectError([] { Values({0, 2, 1, {}}, Wrap::kClamp, {0, 0}); }, "0 x 2");
  ExpectError([] { Values({1, 2, 1, {1}}, Wrap::kClamp, {0, 0}); }, "has 1 numbers");
  ExpectError([&] { Values({1, 1, 1, {1}}, Wrap::kRepeat, {0, nan}); }, "not finite");
}

}  // namespace
}  // namespace daumier::raster
