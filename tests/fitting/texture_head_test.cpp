#include "fitting/texture_head.h"

#include "faces/eyeball.h"
#include "tests/fitting/small_atlas.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace daumier::fitting {
namespace {

constexpr int kHeadSize = 128, kPixels = 224;

/// A sheet for a face, whose atlas is the sheet seen from the front, and two eyeballs behind it.
class PaintedSheet : public ::testing::Test {
 protected:
  PaintedSheet() {
    head_.vertices = sheet_.vertices;
    head_.eye_centres = {geometry::Vector3(-2, 2, -3), geometry::Vector3(2, 2, -3)};
    head_.light = PortraitLight{};
    rig::TextureSpace& space = sheet_.space;
    const auto add_rows = [](auto& rows, const auto& more) {
      rows.conservativeResize(rows.rows() + more.rows(), Eigen::NoChange);
      rows.bottomRows(more.rows()) = more;
    };
    for (size_t side = 0; side < 2; ++side) {
      const auto& eyeball = faces::EyeballTopology().triangles;
      geometry::Triangles triangles(Eigen::Index(eyeball.size()), 3);
      for (size_t t = 0; t < eyeball.size(); ++t) triangles.row(Eigen::Index(t)) = eyeball[t].transpose();
      const geometry::Triangles uv_triangles = triangles.array() + int(space.uv.rows());
      triangles.array() += int(head_.vertices.rows());
      geometry::TextureCoordinates uv = 0.08 * faces::EyeballUv();
      uv.col(0).array() += 0.9 - 0.9 * double(side);
      add_rows(space.triangles, triangles), add_rows(space.uv_triangles, uv_triangles), add_rows(space.uv, uv);
      add_rows(head_.vertices,
               faces::EyeballPoints(
                   {.centre = head_.eye_centres[side], .radii = {1, 1, 1}, .iris_radius = 0.4, .bulge = 0}));
      space.charts.insert(space.charts.end(), eyeball.size(),
                          side == 0 ? rig::TextureChart::kRightEye : rig::TextureChart::kLeftEye);
    }
    guide_.mirror = sheet_.mirror;
    guide_.mirror.resize(size_t(head_.vertices.rows()), -1);
    guide_.scalp = Eigen::VectorXf::Zero(head_.vertices.rows());
    guide_.hair_painted = guide_.beard = guide_.chin = guide_.ears = guide_.scalp;
  }

  /// Red falls to the right and green downwards, of any size.
  static render::Image Ramps(int scale = 1) {
    render::Image picture(scale * kPixels, scale * kPixels, 3, 90);
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column)
        picture.at(row, column, 0) = uint8_t(250 - column / scale),
                                picture.at(row, column, 1) = uint8_t(250 - row / scale);
    return picture;
  }
  static render::Image Mask(PictureClass of, int scale = 1) {
    return render::Image(scale * kPixels, scale * kPixels, 1, uint8_t(of));
  }
  HeadTexture Paint(const render::Image& picture, const render::Image& mask, const TextureOptions& options) const {
    return PaintHead(sheet_.space, guide_, head_, picture, mask, options);
  }
  /// The texel of a place of the sheet.
  Eigen::Vector3f At(const render::Image& texture, double x, double y) const {
    const int row = int((1 - sheet_.UvOf(y)) * kHeadSize), column = int(sheet_.UvOf(x) * kHeadSize);
    return {float(texture.at(row, column, 0)), float(texture.at(row, column, 1)), float(texture.at(row, column, 2))};
  }

  Sheet sheet_ = Sheet::Make(12, 6);
  TextureGuide guide_;
  ShownHead head_;
};

TEST_F(PaintedSheet, ShowsThePicture) {
  const HeadTexture texture = Paint(Ramps(), Mask(PictureClass::kSkin), {.size = kHeadSize, .delight = false});
  EXPECT_EQ(texture.picture.height, kHeadSize);
  for (const double x : {-4.0, 0.5, 3.0}) {
    for (const double y : {-3.0, 4.0}) {
      EXPECT_NEAR(At(texture.picture, x, y)[0], 250 - (112 + 10.15 * x), 2) << x;
      EXPECT_NEAR(At(texture.picture, x, y)[1], 250 - (112 - 10.15 * y), 2) << y;
      EXPECT_EQ(At(texture.sources, x, y), Eigen::Vector3f(0, 255, 0));
    }
  }
  EXPECT_GT(texture.seen, 0.99);
  EXPECT_NEAR(texture.seen + texture.mirrored + texture.filled, 1, 1e-6);
}

TEST_F(PaintedSheet, IsTheSameOfALargerPicture) {
  const TextureOptions options = {.size = kHeadSize, .delight = false};
  const HeadTexture small = Paint(Ramps(), Mask(PictureClass::kSkin), options);
  head_.camera.linear *= 4;
  const HeadTexture large = Paint(Ramps(4), Mask(PictureClass::kSkin, 4), options);
  for (const double x : {-4.0, 0.5, 3.0}) EXPECT_NEAR((At(small.picture, x, 1) - At(large.picture, x, 1)).norm(), 0, 2);
}

TEST_F(PaintedSheet, HasSkinWhereThePictureShowsAnEye) {
  render::Image picture(kPixels, kPixels, 3, 180), mask = Mask(PictureClass::kSkin);
  const auto draw_eye = [&](int middle) {
    for (int row = 80; row < 104; ++row) {
      for (int column = middle - 15; column < middle + 15; ++column) {
        mask.at(row, column) = uint8_t(PictureClass::kEyes);
        for (int k = 0; k < 3; ++k) picture.at(row, column, k) = 20;
      }
    }
  };
  draw_eye(92), draw_eye(132);
  const HeadTexture texture = Paint(picture, mask, {.size = kHeadSize, .delight = false});
  for (const double x : {-1.9, 1.9}) {
    EXPECT_NEAR(At(texture.picture, x, 1.9)[0], 180, 4) << "the lid";
    EXPECT_EQ(At(texture.sources, x, 1.9), Eigen::Vector3f(255, 0, 0));
  }
}

TEST_F(PaintedSheet, IsAlbedoWhereTheLightIsKnown) {
  head_.light = PortraitLight{0.05F, 0, -0.05F, 0.1F};
  head_.pose[1] = 0.3;
  float shade = 0;
  const Eigen::Vector3f normal = RotationOf(head_.pose).col(2).cast<float>();
  raster::Shade(*head_.light, 1, normal.data(), &shade);
  const render::Image picture(kPixels, kPixels, 3, uint8_t(std::lround(150 * shade)));
  const HeadTexture given = Paint(picture, Mask(PictureClass::kSkin),
                                  {.size = kHeadSize, .fit_light = false, .light_share = 1}),
                    fitted = Paint(picture, Mask(PictureClass::kSkin), {.size = kHeadSize, .light_share = 1});
  EXPECT_NEAR(At(given.picture, 1, -2)[0], 150, 1.5);
  EXPECT_EQ(given.light, head_.light);
  EXPECT_NEAR(At(fitted.picture, 1, -2)[0], 150 * shade / 0.85, 2);
  head_.light.reset();
  testing::ExpectError([&] { Paint(picture, Mask(PictureClass::kSkin), {.size = kHeadSize}); }, "no light");
}

TEST_F(PaintedSheet, TakesHairWhereItIsPaintedAlone) {
  render::Image picture(kPixels, kPixels, 3, 200), mask = Mask(PictureClass::kSkin);
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < kPixels; ++column) {
      mask.at(row, column) = uint8_t(PictureClass::kHair);
      for (int k = 0; k < 3; ++k) picture.at(row, column, k) = 30;
    }
  }
  const TextureOptions options = {.size = kHeadSize, .delight = false};
  EXPECT_NEAR(At(Paint(picture, mask, options).picture, 0, 4)[0], 200, 3) << "an occluder";
  guide_.hair_painted.setOnes();
  EXPECT_NEAR(At(Paint(picture, mask, options).picture, 0, 4)[0], 30, 3);
}

TEST_F(PaintedSheet, TakesHairOfACheekForABeardIfTheChinHasHairToo) {
  render::Image picture(kPixels, kPixels, 3, 200), mask = Mask(PictureClass::kSkin);
  const auto draw = [&](int left, int right) {
    for (int row = 112; row < kPixels; ++row) {
      for (int column = left; column < right; ++column) {
        mask.at(row, column) = uint8_t(PictureClass::kHair);
        for (int k = 0; k < 3; ++k) picture.at(row, column, k) = 30;
      }
    }
  };
  guide_.beard.setOnes();
  for (Eigen::Index v = 0; v < sheet_.vertices.rows(); ++v)
    if (std::abs(sheet_.vertices(v, 0)) < 1.5 && sheet_.vertices(v, 1) < 0) guide_.chin[v] = 1;
  const TextureOptions options = {.size = kHeadSize, .delight = false};
  draw(0, 70);
  EXPECT_GT(At(Paint(picture, mask, options).picture, -5, -3)[0], 150) << "hair that hangs before a cheek";
  draw(70, kPixels);
  EXPECT_NEAR(At(Paint(picture, mask, options).picture, -5, -3)[0], 30, 3);
}

TEST_F(PaintedSheet, TakesNoBackgroundForAnEar) {
  render::Image picture(kPixels, kPixels, 3, 120);
  for (int row = 0; row < 100; ++row)
    for (int column = 0; column < 80; ++column)
      for (int k = 0; k < 3; ++k) picture.at(row, column, k) = 235;
  const TextureOptions options = {.size = kHeadSize, .delight = false};
  EXPECT_NEAR(At(Paint(picture, Mask(PictureClass::kSkin), options).picture, -5, 4)[0], 235, 6);
  guide_.ears.setOnes();
  EXPECT_LT(At(Paint(picture, Mask(PictureClass::kSkin), options).picture, -5, 4)[0], 150);
}

TEST_F(PaintedSheet, PaintsEyesAndGutters) {
  const HeadTexture texture = Paint(Ramps(), Mask(PictureClass::kSkin), {.size = kHeadSize, .delight = false});
  const auto eye = [&](double u, double v) {
    return int(texture.picture.at(int((1 - v) * kHeadSize), int(u * kHeadSize), 0));
  };
  EXPECT_LT(eye(0.94, 0.04), 130) << "a plain iris, since the mask shows no eye";
  EXPECT_GT(eye(0.94, 0.012), 220) << "white behind";
  // The texel that holds the sheet's border has its middle outside of it.
  const int row = kHeadSize / 2, border = int(sheet_.UvOf(-6) * kHeadSize);
  EXPECT_NEAR(texture.picture.at(row, border, 0), texture.picture.at(row, border + 1, 0), 3);
  EXPECT_EQ(texture.picture.at(2, 2, 0), 255) << "nothing is near";
}

TEST_F(PaintedSheet, IsTheSameFromSeveralThreads) {
  const HeadPainter painter(sheet_.space, guide_, {.size = kHeadSize});
  const render::Image picture = Ramps(), mask = Mask(PictureClass::kSkin);
  const HeadTexture expected = painter.Paint(head_, picture, mask);
  std::vector<HeadTexture> painted(3);
  std::vector<std::thread> threads;
  for (HeadTexture& texture : painted) threads.emplace_back([&] { texture = painter.Paint(head_, picture, mask); });
  for (std::thread& thread : threads) thread.join();
  for (const HeadTexture& texture : painted) EXPECT_EQ(texture.picture, expected.picture);
}

TEST_F(PaintedSheet, RefusesSizesThatDisagree) {
  testing::ExpectError([&] { Paint(Ramps(), Mask(PictureClass::kSkin, 2), {.size = kHeadSize}); }, "224 x 224");
  ShownHead fewer = head_;
  fewer.vertices.conservativeResize(5, 3);
  testing::ExpectError(
      [&] { PaintHead(sheet_.space, guide_, fewer, Ramps(), Mask(PictureClass::kSkin), {.size = kHeadSize}); },
      "a head of 5 vertices");
  guide_.scalp.conservativeResize(3);
  testing::ExpectError([&] { HeadPainter(sheet_.space, guide_); }, "with a guide");
}

TEST(TextureGuide, HasMirrorScalpAndBeardOfTheTemplate) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  std::vector<int> joined(size_t(face.num_vertices()));
  for (int v = 0; v < face.num_vertices(); ++v) joined[size_t(v)] = v + 3;  // Numbered from 3.
  const TextureGuide guide = MakeTextureGuide(face, joined, face.num_vertices() + 5);
  for (int v = 0; v < face.num_vertices(); ++v)
    EXPECT_EQ(guide.mirror[size_t(v + 3)], face.annotation.mirror[size_t(v)] + 3);
  EXPECT_EQ(guide.mirror[0], -1);
  EXPECT_EQ(guide.scalp[0], 0);
  Eigen::Index crown = 0;
  face.neutral.col(1).maxCoeff(&crown);
  EXPECT_GT(guide.scalp[crown + 3], 0.9F);
  EXPECT_EQ(guide.scalp[face.annotation.landmarks[30] + 3], 0) << "the nose";
  EXPECT_LT(guide.hair_painted[face.annotation.landmarks[30] + 3], 0.1F);
  testing::ExpectError([&] { MakeTextureGuide(face, {1, 2}, 9); }, "2 vertices");
}

}  // namespace
}  // namespace daumier::fitting
