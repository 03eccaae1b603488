#include "faces/appearance/albedo_basis.h"

#include "faces/appearance/albedo_modes.h"
#include "faces/appearance/skin_fields.h"
#include "faces/appearance/skin_tone.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::faces {
namespace {

Eigen::VectorXf UnitCoefficients(int k, float value) {
  Eigen::VectorXf a = Eigen::VectorXf::Zero(kNumAlbedoModes);
  a[k] = value;
  return a;
}

TEST(AlbedoBasis, HasEightyNamedModesThatAreFieldsTimesSteps) {
  const FaceTemplate face = testing::SyntheticFace();
  const AlbedoBasis basis = MakeAlbedoBasis(face);
  ASSERT_EQ(basis.modes.cols(), kNumAlbedoModes);
  ASSERT_EQ(basis.modes.rows(), 3 * face.num_vertices());
  EXPECT_EQ(std::set<std::string>(basis.names.begin(), basis.names.end()).size(), size_t(kNumAlbedoModes));
  EXPECT_EQ(NamedAlbedoModes().size(), size_t(kNumNamedAlbedoModes));
  int num_empty = 0;
  for (int k = 0; k < kNumAlbedoModes; ++k) {
    EXPECT_EQ(AlbedoMode(basis.names[size_t(k)]), k);
    for (int v = 0; v < face.num_vertices(); v += 7)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(basis.modes(3 * v + c, k), basis.fields(v, basis.field_of[size_t(k)]) * basis.steps(c, k));
    num_empty += basis.modes.col(k).cwiseAbs().maxCoeff() == 0;
    EXPECT_LT(basis.modes.col(k).cwiseAbs().maxCoeff(), 0.25) << basis.names[size_t(k)];
  }
  EXPECT_LE(num_empty, 1) << "this face is too coarse for the rims of brows";
  EXPECT_GE(basis.mean.minCoeff(), 0);
  EXPECT_LE(basis.mean.maxCoeff(), 1);
  EXPECT_EQ(MakeAlbedoBasis(face).modes, basis.modes) << "deterministic";
  testing::ExpectError([] { AlbedoMode("green"); }, "green");
}

TEST(AlbedoBasis, NamedModesAreSymmetric) {
  const FaceTemplate face = testing::SyntheticFace();
  const AlbedoBasis basis = MakeAlbedoBasis(face);
  for (int k = 0; k < kNumNamedAlbedoModes; ++k) {
    for (int v = 0; v < face.num_vertices(); ++v) {
      const int m = face.annotation.mirror[size_t(v)];
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(basis.modes(3 * v + c, k), basis.modes(3 * m + c, k), 1e-5) << basis.names[size_t(k)];
    }
  }
}

TEST(AlbedoBasis, ColoursAreLinearUntilTheyAreClamped) {
  const FaceTemplate face = testing::SyntheticFace();
  AlbedoBasis basis = MakeAlbedoBasis(face);
  Rng rng(3);
  Eigen::VectorXf a(kNumAlbedoModes);
  for (float& value : a) value = float(rng.Normal());
  const Eigen::MatrixXf colours = AlbedoOf(basis, a);
  EXPECT_GE(colours.minCoeff(), 0);
  EXPECT_LE(colours.maxCoeff(), 1);
  const Eigen::VectorXf offset = basis.modes * a;
  for (int v = 0; v < face.num_vertices(); ++v)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(colours(v, c), std::clamp(basis.mean(v, c) + offset[3 * v + c], 0.0f, 1.0f), 1e-5);
  basis.fields.resize(0, 0);  // As a basis from elsewhere.
  EXPECT_LT((AlbedoOf(basis, a) - colours).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(AlbedoOf(basis, UnitCoefficients(0, 30)).maxCoeff(), 0) << "clamped";
  testing::ExpectError([&] { AlbedoOf(basis, Eigen::VectorXf::Zero(3)); }, "3 albedo coefficients, expected 80");
}

TEST(SkinFields, OfLipsAndBrowsLieWhereTheLandmarksAre) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto& landmarks = face.annotation.landmarks;
  const Eigen::VectorXd lips = LipIndicator(face);
  for (size_t l = 48; l < 68; ++l) EXPECT_EQ(lips[landmarks[l]], 1) << l;
  for (const size_t l : {8, 30, 33, 36, 2, 14}) EXPECT_EQ(lips[landmarks[l]], 0) << l;
  const Eigen::VectorXd brows = SkinField(face, "brows");
  EXPECT_GT(brows[landmarks[19]], 0.9);
  EXPECT_EQ(brows[landmarks[30]], 0);
  for (const char* name : {"skin", "lips", "upper_lip", "cheeks", "beard", "scalp", "freckles", "ears", "neck"}) {
    const Eigen::VectorXd field = SkinField(face, name);
    EXPECT_GE(field.minCoeff(), 0) << name;
    EXPECT_LE(field.maxCoeff(), 1) << name;
  }
  EXPECT_GT(SkinField(face, "scalp")[face.num_vertices() - 1], 0.99) << "the crown";
  EXPECT_EQ(SkinField(face, "scalp")[landmarks[30]], 0);
  testing::ExpectError([&] { SkinField(face, "elbow"); }, "elbow");
}

TEST(SkinTone, NeverRisesWithLightnessAndAllSixExist) {
  std::set<int> tones;
  double before = 1000;
  int tone_before = 0;
  for (float melanin = -2; melanin <= 3; melanin += 0.05f) {
    Eigen::VectorXf a = Eigen::VectorXf::Zero(kNumAlbedoModes);
    a[0] = melanin;
    const double lightness = Lightness(SkinColour(melanin, 0, 0));
    const int tone = SkinToneOf(a);
    EXPECT_LE(lightness, before);
    EXPECT_GE(tone, tone_before);
    before = lightness, tone_before = tone;
    tones.insert(tone);
  }
  EXPECT_EQ(tones.size(), size_t(kNumSkinTones));
  for (int tone = 0; tone < kNumSkinTones; ++tone) {
    Eigen::VectorXf a = Eigen::VectorXf::Zero(3);
    a[0] = MelaninOfTone(tone);
    EXPECT_EQ(SkinToneOf(a), tone);
    EXPECT_LT(std::abs(a[0]), 2.5) << "within the prior";
  }
  EXPECT_NEAR(Lightness({1, 1, 1}), 100, 1e-6);
  EXPECT_EQ(Lightness({0, 0, 0}), 0);
  EXPECT_NEAR(Lightness({0.466f, 0.466f, 0.466f}), 50, 0.1);
  testing::ExpectError([] { MelaninOfTone(6); }, "skin tone 6");
  testing::ExpectError([] { SkinToneOf(Eigen::VectorXf::Zero(2)); }, "expected 3");
}

}  // namespace
}  // namespace daumier::faces
