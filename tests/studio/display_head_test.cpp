#include "studio/display_head.h"

#include "render/camera.h"
#include "reports/face_surface.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>

namespace daumier::studio {
namespace {

template <class T>
std::vector<T> NumbersOf(const std::string& bytes) {
  std::vector<T> numbers(bytes.size() / sizeof(T));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
  return numbers;
}

class DisplayHeadTest : public ::testing::Test {
 protected:
  const faces::FaceTemplate face_ = testing::SyntheticFace();
  const DisplayHead head_{face_};
  const faces::FinishedHead finished_{face_};
  const rig::HeadInterior interior_{face_};
};

TEST_F(DisplayHeadTest, HasTheSizesOfTheFinishedHeadWithTeethAndTongue) {
  const Json& description = head_.description();
  EXPECT_EQ(description["num_vertices"], finished_.num_vertices() + rig::HeadInterior::NumVertices());
  EXPECT_EQ(description["num_face_vertices"], face_.num_vertices());
  EXPECT_EQ(description["num_triangles"],
            finished_.skin().rows() + finished_.parts().rows() + Eigen::Index(rig::HeadInterior::Materials().size()));
  EXPECT_EQ(head_.triangles().size(), 12 * description["num_triangles"].get<size_t>());
  EXPECT_EQ(head_.Vertices(face_.neutral).size(), 12 * description["num_vertices"].get<size_t>());
}

TEST_F(DisplayHeadTest, GroupsAreRunsOfTrianglesOfOneMaterial) {
  size_t next = 0;
  std::map<std::string, size_t> counts;
  for (const Json& group : head_.description()["groups"]) {
    EXPECT_EQ(group["first"], next);
    next += group["count"].get<size_t>();
    counts[group["material"]] += group["count"].get<size_t>();
    ASSERT_EQ(group["colour"].size(), 3u);
    for (const Json& channel : group["colour"]) EXPECT_TRUE(channel >= 0 && channel <= 255);
    EXPECT_GE(group["gloss"], 0);
  }
  EXPECT_EQ(next, head_.description()["num_triangles"]);
  EXPECT_EQ(counts.size(), head_.description()["groups"].size()) << "a material once";
  EXPECT_EQ(counts["skin"], size_t(finished_.skin().rows()));
  for (const auto& [material, name] : faces::kHeadMaterials) {
    if (material == faces::HeadMaterial::kSkin) continue;
    EXPECT_EQ(counts[name], size_t(std::ranges::count(finished_.part_materials(), material) +
                                   std::ranges::count(rig::HeadInterior::Materials(), material)))
        << name;
  }
}

TEST_F(DisplayHeadTest, ColoursAreThoseOfReports) {
  for (const Json& group : head_.description()["groups"])
    for (const auto& [material, name] : faces::kHeadMaterials) {
      if (group["material"] != name) continue;
      EXPECT_EQ(group["colour"], Json(reports::LookOf(material).colour)) << name;
    }
}

TEST_F(DisplayHeadTest, TrianglesAreThoseOfTheFinishedHeadAndTheMouth) {
  const std::vector<uint32_t> corners = NumbersOf<uint32_t>(head_.triangles());
  const auto corners_of = [](const auto& triangle) {
    return std::array<uint32_t, 3>{uint32_t(triangle[0]), uint32_t(triangle[1]), uint32_t(triangle[2])};
  };
  std::multiset<std::array<uint32_t, 3>> expected, found;
  std::vector<geometry::Triangles> surfaces = {finished_.skin(), finished_.parts()};
  for (const rig::ChartPiece& piece : rig::HeadInterior::Charts(finished_.num_vertices()))
    surfaces.push_back(piece.triangles);
  for (const geometry::Triangles& part : surfaces)
    for (Eigen::Index t = 0; t < part.rows(); ++t) expected.insert(corners_of(part.row(t)));
  for (size_t i = 0; i < corners.size(); i += 3) found.insert(corners_of(&corners[i]));
  EXPECT_EQ(found, expected);
}

TEST_F(DisplayHeadTest, VerticesBeginWithThoseOfTheFace) {
  const geometry::Points face = 1.1 * face_.neutral;
  const std::vector<float> numbers = NumbersOf<float>(head_.Vertices(face));
  geometry::Points all(finished_.num_vertices() + rig::HeadInterior::NumVertices(), 3);
  all << finished_.Vertices(face), interior_.Vertices(face);
  ASSERT_EQ(numbers.size(), size_t(all.size()));
  for (Eigen::Index v = 0; v < all.rows(); ++v)
    for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(numbers[size_t(3 * v + axis)], float(all(v, axis))) << v;
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(numbers[size_t(axis)], float(face(0, axis)));
  testing::ExpectError([&] { head_.Vertices(face.topRows(5)); }, "the face has 5 vertices");
  testing::ExpectError([&] { head_.Vertices({}); }, "the face has 0 vertices");
}

TEST_F(DisplayHeadTest, TheFrameHoldsTheHead) {
  const geometry::Points all = finished_.Vertices(face_.neutral);
  const Json& description = head_.description();
  const Eigen::Vector3d centre(description["centre"][0], description["centre"][1], description["centre"][2]);
  const double half_height = description["half_height"];
  EXPECT_LE((all.rowwise() - centre.transpose()).cwiseAbs().maxCoeff(), half_height);
  EXPECT_EQ(half_height, render::FrameOf(all).half_height);
}

TEST_F(DisplayHeadTest, APictureShowsTheSameHead) {
  const geometry::Points face = 1.1 * face_.neutral;
  const render::RenderInput picture = head_.Picture(face);
  const std::vector<float> numbers = NumbersOf<float>(head_.Vertices(face));
  ASSERT_EQ(size_t(picture.surface.vertices.size()), numbers.size());
  EXPECT_EQ(float(picture.surface.vertices(picture.surface.vertices.rows() - 1, 2)), numbers.back());
  EXPECT_EQ(picture.surface.triangles.rows() + picture.closing_triangles.rows(), head_.description()["num_triangles"]);
  EXPECT_EQ(picture.closing_colours.size(), size_t(picture.closing_triangles.rows()));
  EXPECT_LT(picture.closing_triangles.maxCoeff(), picture.surface.vertices.rows());
}

TEST_F(DisplayHeadTest, BareFacesAreFoundByTheirTriangles) {
  geometry::TriangleMesh mesh{face_.neutral, face_.triangles};
  EXPECT_TRUE(head_.IsBareFace(mesh));
  mesh.triangles.row(0).swap(mesh.triangles.row(1));
  EXPECT_FALSE(head_.IsBareFace(mesh)) << "another order is another topology";
  EXPECT_FALSE(head_.IsBareFace({face_.neutral.topRows(9), {}}));
  EXPECT_FALSE(head_.IsBareFace({finished_.Vertices(face_.neutral), finished_.skin()})) << "finished already";
}

TEST_F(DisplayHeadTest, IsReadFromSeveralThreads) {
  testing::ExpectTheSameFromThreads(2, [&] { return head_.Vertices(face_.neutral); });
}

}  // namespace
}  // namespace daumier::studio
