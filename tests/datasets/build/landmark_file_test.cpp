#include "datasets/build/landmark_file.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

using testing::ExpectError;

/// `count` times what `entry` says of 0, 1, 2 ...
template <class Entry>
std::string Lines(int count, Entry&& entry) {
  std::string text;
  for (int i = 0; i < count; ++i) text += entry(i) + "\n";
  return text;
}

class LandmarkFileTest : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  static geometry::Points Vertices() {
    return geometry::Points::NullaryExpr(100, 3, [](Eigen::Index v, Eigen::Index axis) { return 10.0 * v + axis; });
  }

  const testing::TempDir folder_;
};

TEST_F(LandmarkFileTest, VerticesOfOneTopology) {
  const std::string words = "# a remark\n" + Lines(68, [](int l) { return std::to_string(l == 5 ? -1 : 99 - l); });
  std::string json = "[";
  for (int l = 0; l < 68; ++l) json += (l ? "," : "") + std::to_string(l == 5 ? -1 : 99 - l);
  for (const auto& path : {Write("a.txt", words), Write("a.json", json + "]")}) {
    const MeshLandmarks landmarks = LandmarkFile(path).On(Vertices());
    EXPECT_FALSE(landmarks[5]);
    EXPECT_EQ(landmarks[0].value(), geometry::Vector3(990, 991, 992));
    EXPECT_EQ(landmarks[67].value(), geometry::Vector3(320, 321, 322));
  }
}

TEST_F(LandmarkFileTest, PlacesOfOneMesh) {
  const std::string words =
      Lines(68, [](int l) { return l == 9 ? std::string("nan nan nan") : std::to_string(l) + " 0.5\t-2e1 \r"; });
  std::string json = "[[null, null, null]";
  for (int l = 1; l < 68; ++l) json += ", [" + std::to_string(l) + ", 0.5, -20]";
  const MeshLandmarks landmarks = LandmarkFile(Write("a.txt", words)).On({});
  EXPECT_FALSE(landmarks[9]);
  EXPECT_EQ(landmarks[67].value(), geometry::Vector3(67, 0.5, -20));
  const MeshLandmarks same = LandmarkFile(Write("a.json", json + "]")).On({});
  EXPECT_FALSE(same[0]);
  EXPECT_EQ(same[67], landmarks[67]);
}

TEST_F(LandmarkFileTest, AVertexMapNamesTheVerticesOfACutMesh) {
  const auto landmarks = Write("l.txt", Lines(68, [](int l) { return std::to_string(1000 + l); }));
  // The mesh keeps the odd ones of 1000 .. 1199.
  const auto map = Write("m.txt", "# names\n" + Lines(100, [](int v) { return std::to_string(1001 + 2 * v); }));
  const MeshLandmarks found = LandmarkFile(landmarks, map).On(Vertices());
  EXPECT_FALSE(found[0]);
  EXPECT_EQ(found[1].value(), geometry::Vector3(0, 1, 2));
  EXPECT_EQ(found[67].value(), geometry::Vector3(330, 331, 332));
}

TEST_F(LandmarkFileTest, APatientsFrameIsTurnedWhereThatLiesOnTheMesh) {
  const auto path =
      Write("a.fcsv", "# CoordinateSystem = LPS\n" + Lines(68, [](int l) {
                        return fmt::format("{},{},{},{},0,0,0,1,1,1,0,F-{},,", l, -10 * l, -10 * l - 1, 10 * l + 2, l);
                      }));
  EXPECT_EQ(LandmarkFile(path).On(Vertices())[5].value(), geometry::Vector3(50, 51, 52));
  const geometry::Points turned = Vertices() * Eigen::Vector3d(-1, -1, 1).asDiagonal();
  EXPECT_EQ(LandmarkFile(path).On(turned)[5].value(), geometry::Vector3(-50, -51, 52));
}

TEST_F(LandmarkFileTest, NumbersFromOneAndZeroForAbsent) {
  const auto path = Write("a.txt", Lines(68, [](int l) { return std::to_string(l + 1); }));
  const ShiftedNumbers shifted = LandmarkFile(path).ShiftedOn(Vertices());
  EXPECT_EQ(shifted.one_less.value()[0].value(), geometry::Vector3(0, 1, 2));
  EXPECT_EQ(shifted.one_more.value()[0], LandmarkFile(path).On(Vertices())[1]);
  const auto zeros = Write("b.txt", Lines(68, [](int l) { return std::to_string(l < 17 ? 0 : l); }));
  EXPECT_FALSE(LandmarkFile(zeros).ShiftedOn(Vertices()).one_less);
  EXPECT_TRUE(LandmarkFile(zeros).On(Vertices())[3]);
  const MeshLandmarks landmarks = LandmarkFile(zeros, {}, faces::ZeroPoints::kAbsent).On(Vertices());
  EXPECT_FALSE(landmarks[3]);
  EXPECT_TRUE(landmarks[17]);
}

TEST_F(LandmarkFileTest, RefusesWhatIsNot68Landmarks) {
  const auto with = [&](const std::string& text) { LandmarkFile(Write("a.txt", text)).On(Vertices()); };
  ExpectError([&] { with("1 2 3"); }, "a.txt: 1 points; expected 68 points in iBUG order");
  ExpectError([&] { with(Lines(68, [](int) { return std::string("nose"); })); }, "'nose' is not a number");
  ExpectError([&] { with(Lines(68, [](int) { return std::string("1.5"); })); }, "1.5 is no vertex");
  ExpectError([&] { with(Lines(68, [](int) { return std::string("100"); })); }, "is vertex 100, but the mesh has 100");
  ExpectError([&] { with(Lines(68, [](int l) { return std::to_string(l + 33); })); }, "1-based? Subtract 1 from each");
  ExpectError([&] { with(Lines(68, [](int) { return std::string("1.5 2"); })); }, "a.txt: holds x and y of a picture");
  ExpectError([&] { with(Lines(68, [](int) { return std::string("99999999999999999999"); })); }, "too large");
  ExpectError([&] { with(Lines(68, [](int) { return std::string("-2"); })); }, "Was 1 subtracted twice");
  ExpectError([&] { with("[1, 2"); }, "not JSON");
  ExpectError([&] { LandmarkFile(folder_ / "absent.txt"); }, "absent.txt");
}

}  // namespace
}  // namespace daumier::datasets
