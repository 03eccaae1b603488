#include "datasets/build/portrait_maker.h"

#include "faces/face_model.h"
#include "geometry/coordinates.h"
#include "render/image.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace daumier::datasets {
namespace {

constexpr int kNumMade = 16;

PictureOptions OfOneStyle(double render::StyleOptions::*style) {
  using render::StyleOptions;
  PictureOptions options;
  for (double StyleOptions::*other :
       {&StyleOptions::smooth, &StyleOptions::toon, &StyleOptions::flat, &StyleOptions::ink, &StyleOptions::painterly,
        &StyleOptions::pencil, &StyleOptions::watercolour, &StyleOptions::halftone, &StyleOptions::clay})
    options.styles.*other = 0;
  options.styles.*style = 1;
  return options;
}

/// Flat portraits of the synthetic face, half of them turned far: the truth does not depend on the style.
struct MadePortraits {
  faces::FaceModel model = testing::SyntheticModel();
  PictureOptions options = OfOneStyle(&render::StyleOptions::flat);
  PortraitMaker maker{model.face_template, options};
  std::vector<geometry::Points> shown;
  std::vector<PortraitRecord> records;

  MadePortraits() {
    options.pose.frontal = 0.5;
    for (int i = 0; i < kNumMade; ++i) {
      Rng rng = Stream(5, "made portraits", uint64_t(i));
      Eigen::VectorXf weights(model.expression_shapes.cols());
      for (float& weight : weights) weight = rng.Uniform() < 0.7 ? 0 : float(rng.Uniform());
      const Eigen::VectorXf offset = faces::ExpressionOffset(model, weights);
      shown.push_back(model.face_template.neutral + geometry::PointsFrom({offset.data(), size_t(offset.size())}));
      records.push_back(maker.Make(shown.back(), rng));
    }
  }
  MadePortraits(const MadePortraits&) = delete;
};

const MadePortraits& Made() {
  static const MadePortraits made;
  return made;
}

TEST(PortraitMaker, LandmarksAreTheProjectedVertices) {
  const auto& corners = Made().model.face_template.annotation.landmarks;
  for (const PortraitRecord& record : Made().records) {
    const Eigen::Matrix3d rotation = PoseRotation(record.pose);
    for (size_t l = 0; l < 68; ++l) {
      const Eigen::Vector3d p = record.vertices.row(corners[l]);
      const Eigen::Vector3d q = rotation * p + Eigen::Vector3d(record.pose[3], record.pose[4], record.pose[5]);
      ASSERT_NEAR(record.landmarks[2 * l], 112 + 1015 * q.x() / (100 - q.z()), 1e-3) << l;
      ASSERT_NEAR(record.landmarks[2 * l + 1], 112 - 1015 * q.y() / (100 - q.z()), 1e-3) << l;
    }
  }
}

TEST(PortraitMaker, VerticesAreTheFaceAboutItsCentreAndStatesItsGaps) {
  const faces::FaceTemplate& face_template = Made().model.face_template;
  const geometry::Vector3 centre =
      face_template.neutral(face_template.annotation.landmarks, Eigen::all).colwise().mean();
  EXPECT_TRUE(Made().maker.centre().isApprox(centre));
  const faces::FaceOpenings openings = faces::FindOpenings(face_template);
  const double mm = faces::MillimetresPerCm(face_template);
  for (size_t i = 0; i < kNumMade; ++i) {
    const geometry::Points& face = Made().shown[i];
    const PortraitRecord& record = Made().records[i];
    EXPECT_LT((record.vertices.rowwise() + centre.transpose() - face).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(record.states[0], mm * faces::MeanGap(openings.lids[0], face), 1e-4);
    EXPECT_NEAR(record.states[1], mm * faces::MeanGap(openings.lids[1], face), 1e-4);
    EXPECT_NEAR(record.states[2], mm * faces::MeanGap(openings.lips, face), 1e-4);
  }
}

TEST(PortraitMaker, MasksAgreeWithLandmarks) {
  int num_lids = 0, num_around_eyes = 0, num_lips = 0, num_around_lips = 0;
  for (const PortraitRecord& record : Made().records) {
    const render::Image mask = render::DecodeImage(record.mask, "mask");
    ASSERT_EQ(mask.height, 224);
    ASSERT_EQ(mask.channels, 1);
    const auto is_near = [&](float x, float y, PictureClass wanted) {
      for (int row = int(y) - 2; row <= int(y) + 2; ++row)
        for (int column = int(x) - 2; column <= int(x) + 2; ++column)
          if (row >= 0 && column >= 0 && row < mask.height && column < mask.width &&
              mask.at(row, column) == uint8_t(wanted))
            return true;
      return false;
    };
    for (const int eye : {36, 42}) {
      const bool is_open = record.states[eye == 36 ? 0 : 1] > 4;
      float x = 0, y = 0;
      bool all_seen = true;
      for (size_t l = size_t(eye); l < size_t(eye) + 6; ++l) {
        x += record.landmarks[2 * l] / 6, y += record.landmarks[2 * l + 1] / 6;
        all_seen = all_seen && record.visibility[l];
      }
      if (!is_open || !all_seen) continue;
      ++num_lids;
      num_around_eyes += is_near(x, y, PictureClass::kEyes);
    }
    for (size_t l = 48; l < 60; ++l) {
      if (!record.visibility[l]) continue;
      ++num_lips;
      num_around_lips += is_near(record.landmarks[2 * l], record.landmarks[2 * l + 1], PictureClass::kLips);
    }
  }
  EXPECT_GT(num_lids, 5);
  EXPECT_GE(num_around_eyes, 0.9 * num_lids);
  EXPECT_GT(num_lips, 60);
  EXPECT_GE(num_around_lips, 0.8 * num_lips);
}

TEST(PortraitMaker, LandmarksThatAreTurnedAwayAreHidden) {
  int num_turned = 0;
  for (const PortraitRecord& record : Made().records) {
    const float yaw = record.pose[1];
    if (std::abs(yaw) < 0.6f) continue;
    ++num_turned;
    // A face that turns to its own left shows its right ear, and hides the left end of its jaw.
    EXPECT_EQ(record.visibility[yaw > 0 ? 16 : 0], 0) << "yaw " << yaw;
  }
  EXPECT_GT(num_turned, 0);
}

TEST(PortraitMaker, EqualRandomNumbersGiveEqualPortraitsAlsoWithBuffers) {
  const geometry::Points& face = Made().shown[0];
  render::FloatImage buffers;
  Rng first(3), second(3), third(4);
  const PortraitRecord a = Made().maker.Make(face, first), b = Made().maker.MakeWithBuffers(face, second, &buffers),
                       c = Made().maker.Make(face, third);
  EXPECT_EQ(a.picture, b.picture);
  EXPECT_EQ(a.mask, b.mask);
  EXPECT_EQ(a.landmarks, b.landmarks);
  EXPECT_EQ(a.light, b.light);
  EXPECT_EQ(first.state(), second.state());
  EXPECT_NE(a.picture, c.picture);
  EXPECT_NE(a.pose, c.pose);
}

TEST(PortraitMaker, BuffersHaveThePosedPointsAndNothingInTheBackground) {
  const int tip = Made().model.face_template.annotation.landmarks[30];
  PictureOptions options = OfOneStyle(&render::StyleOptions::flat);
  options.pose.yaw = options.pose.pitch = 15;
  options.looks.hats = options.looks.glasses = 0;
  const PortraitMaker maker(Made().model.face_template, options);
  int num_empty = 0;
  for (uint64_t seed = 1; seed <= 2; ++seed) {
    Rng rng(seed);
    render::FloatImage buffers;
    const PortraitRecord record = maker.MakeWithBuffers(Made().shown[0], rng, &buffers);
    ASSERT_EQ(buffers.height, 224);
    ASSERT_EQ(buffers.width, 224);
    ASSERT_EQ(buffers.channels.size(), 7u);
    const auto at = [&](const char* name, size_t pixel) { return buffers.channels.at(name)[pixel]; };
    for (size_t pixel = 0; pixel < 224 * 224; ++pixel) {
      if (std::isfinite(at("Z", pixel))) continue;
      ++num_empty;
      for (const char* name : {"N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z"}) ASSERT_EQ(at(name, pixel), 0) << name;
    }
    EXPECT_EQ(record.visibility[30], 1);
    const auto pixel = size_t(record.landmarks[61]) * 224 + size_t(record.landmarks[60]);
    const Eigen::Vector3d q = PoseRotation(record.pose) * record.vertices.row(tip).transpose() +
                              Eigen::Vector3d(record.pose[3], record.pose[4], record.pose[5]);
    EXPECT_LT((Eigen::Vector3d(at("P.X", pixel), at("P.Y", pixel), at("P.Z", pixel)) - q).norm(), 0.5) << seed;
  }
  EXPECT_GT(num_empty, 1000);
}

TEST(PortraitMaker, StylesHaveTheirNamesInColourAndInGrey) {
  const std::vector<std::string> names = PortraitMaker::StyleNames();
  ASSERT_EQ(names.size(), 2u * render::kNumPictureStyles);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const PortraitRecord& record : Made().records)
    EXPECT_TRUE(names[size_t(record.style)] == "flat" || names[size_t(record.style)] == "flat_grey");
  PictureOptions options = OfOneStyle(&render::StyleOptions::flat);
  options.styles.grey = 1;
  options.effects.share = 0;
  options.format = "png";
  const PortraitMaker maker(Made().model.face_template, options);
  Rng rng(1);
  const PortraitRecord record = maker.Make(Made().shown[0], rng);
  EXPECT_EQ(names[size_t(record.style)], "flat_grey");
  const render::Image picture = render::DecodeImage(record.picture, "picture");
  ASSERT_EQ(picture.channels, 3);
  for (size_t p = 0; p < picture.pixels.size(); p += 3) {
    ASSERT_EQ(picture.pixels[p], picture.pixels[p + 1]);
    ASSERT_EQ(picture.pixels[p], picture.pixels[p + 2]);
  }
}

TEST(PortraitMaker, PicturesHaveTheFormatOfTheOptionsAndMasksArePng) {
  const PortraitRecord& jpeg = Made().records[0];
  EXPECT_TRUE(jpeg.picture.starts_with("\xff\xd8"));
  EXPECT_TRUE(jpeg.mask.starts_with("\x89PNG"));
  PictureOptions options = OfOneStyle(&render::StyleOptions::flat);
  options.format = "png";
  const PortraitMaker maker(Made().model.face_template, options);
  Rng rng(1);
  EXPECT_TRUE(maker.Make(Made().shown[0], rng).picture.starts_with("\x89PNG"));
}

TEST(PortraitMaker, HeadsOfClayWithoutHairAreBald) {
  for (const PortraitRecord& record : Made().records) EXPECT_FALSE(record.is_bald) << "flat heads are never";
  for (const double share : {0.0, 1.0}) {
    PictureOptions options = OfOneStyle(&render::StyleOptions::clay);
    options.bald = share;
    options.looks.bald = 0;
    const PortraitMaker maker(Made().model.face_template, options);
    Rng rng(2);
    const PortraitRecord record = maker.Make(Made().shown[0], rng);
    EXPECT_EQ(record.is_bald, share == 1);
    const std::vector<uint8_t> pixels = render::DecodeImage(record.mask, "mask").pixels;
    EXPECT_EQ(std::ranges::count(pixels, uint8_t(PictureClass::kHair)) == 0, share == 1);
  }
}

}  // namespace
}  // namespace daumier::datasets
