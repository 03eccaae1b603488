#include "faces/controls/given_controls.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

class GivenControls : public ::testing::Test {
 protected:
  std::string Write(const std::string& name, const geometry::Points& vertices) const {
    geometry::WriteObj(folder_ / name, geometry::TriangleMesh{vertices, face_.triangles});
    return (folder_ / name).string();
  }

  const FaceTemplate face_ = testing::SyntheticFace();
  const testing::TempDir folder_;
};

TEST_F(GivenControls, TwoMeshesAreTheirDifference) {
  geometry::Points moved = face_.neutral;
  moved(5, 2) += 0.25;
  const std::string from = Write("from.obj", face_.neutral), to = Write("to.obj", moved);
  const auto controls = ReadGivenControls({"horn=" + from + "," + to}, face_, {});
  ASSERT_EQ(controls.size(), 1u);
  EXPECT_EQ(controls[0].name, "horn");
  EXPECT_NEAR(controls[0].displacement(5, 2), 0.25, 1e-6);
  EXPECT_LT(controls[0].displacement.cwiseAbs().sum(), 0.25 + 1e-3);
}

TEST_F(GivenControls, ATargetIsReadInTheNumbersAndUnitOfTheSource) {
  WriteFileAtomically(folder_ / "a.target", "# a morph target\n7 0 0.5 0\n9 1 0 0\n");
  SourceNumbering numbering{std::vector<int>(face_.num_vertices(), 0), 12, 10};
  numbering.vertices[3] = 7;
  const auto controls = ReadGivenControls({"a=" + (folder_ / "a.target").string()}, face_, numbering);
  EXPECT_NEAR(controls[0].displacement(3, 1), 5, 1e-12) << "decimetres to centimetres";
  EXPECT_NEAR(controls[0].displacement.cwiseAbs().sum(), 5, 1e-12) << "vertex 9 is none of the template's";
}

TEST_F(GivenControls, SaysWhatIsWrong) {
  const std::string mesh = Write("mesh.obj", face_.neutral);
  testing::ExpectError([&] { ReadGivenControls({"horn"}, face_, {}); }, "there is no '='");
  testing::ExpectError([&] { ReadGivenControls({"horn=" + mesh}, face_, {}); }, "NAME=FROM.obj,TO.obj");
  testing::ExpectError([&] { ReadGivenControls({"horn=" + mesh + "," + mesh}, face_, {}); }, "moves no vertex");
  testing::ExpectError([&] { ReadGivenControls({"a/b=" + mesh + "," + mesh}, face_, {}); }, "letters, digits");
  testing::ExpectError([&] { ReadGivenControls({"eye_slant=" + mesh + "," + mesh}, face_, {}); },
                       "of this name already");
  testing::ExpectError([&] { ReadGivenControls({"a=,"}, face_, {}); }, "it has no file");
  testing::ExpectError([&] { ReadGivenControls({"a=" + mesh + ","}, face_, {}); }, "two meshes are needed");
  const std::string decimetres = Write("decimetres.obj", 0.1 * face_.neutral);
  testing::ExpectError([&] { ReadGivenControls({"a=" + mesh + "," + decimetres}, face_, {}); },
                       "more than a quarter of the head");
  WriteFileAtomically(folder_ / "nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 2 3 4\n");
  testing::AllowWarnings();
  testing::ExpectError([&] { ReadGivenControls({"a=" + mesh + "," + (folder_ / "nan.obj").string()}, face_, {}); },
                       "vertex 0 is not finite");
  WriteFileAtomically(folder_ / "a.target", "0 1 1 1\n");
  testing::ExpectError([&] { ReadGivenControls({"a=" + (folder_ / "a.target").string()}, face_, {}); },
                       "are not known");
  WriteFileAtomically(folder_ / "small.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  testing::ExpectError([&] { ReadGivenControls({"a=" + mesh + "," + (folder_ / "small.obj").string()}, face_, {}); },
                       "has 3 vertices");
}

}  // namespace
}  // namespace daumier::faces
