#include "studio/shown_faces.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

using testing::ExpectError;
using testing::TempDir;

faces::FaceTemplate NoTemplateOfMeshes() {
  ADD_FAILURE() << "a database has its own template";
  return {};
}

TEST(ShownFaces, ADatabaseShowsAllOfItsFaces) {
  const TempDir folder;
  testing::BuildSyntheticFaces(folder / "faces", 2);
  const faces::FaceDatabase database(folder / "faces");
  const ShownFaces faces(folder / "faces", NoTemplateOfMeshes);
  ASSERT_EQ(faces.size(), database.num_faces());
  EXPECT_EQ(faces.id(3), "face-00003");
  EXPECT_EQ(faces.Find("face-00003"), 3);
  EXPECT_FALSE(faces.Find("face-3").has_value());
  EXPECT_EQ(faces.Describe(1), database.Describe(1));
  EXPECT_EQ(faces.Group(0), faces.Group(7));
  EXPECT_NE(faces.Group(0), faces.Group(8)) << "the second person";
  EXPECT_EQ(faces.Vertices(5), database.points(5));
  EXPECT_EQ(faces.checksum(), DataHash(folder / "faces"));
  EXPECT_EQ(faces.sources(), database.manifest().sources);
}

TEST(ShownFaces, MeshesOfTheTemplateComeByName) {
  const TempDir folder;
  const faces::FaceTemplate face_template = testing::SyntheticModel().face_template;
  const auto write = [&](const std::string& name, double factor) {
    geometry::WriteObj(folder / name, faces::SurfaceMesh(face_template, factor * face_template.neutral));
  };
  write("b.obj", 1.5);
  write("a.obj", 1);
  WriteFileAtomically(folder / "notes.txt", "no mesh");
  const ShownFaces faces(folder.path(), [&] { return face_template; });
  ASSERT_EQ(faces.size(), 2);
  EXPECT_EQ(faces.id(0), "a");
  EXPECT_EQ(faces.Describe(1), "b");
  EXPECT_NE(faces.Group(0), faces.Group(1));
  EXPECT_TRUE(faces.Vertices(1).isApprox(1.5 * face_template.neutral, 1e-9));
  EXPECT_EQ(faces.checksum(), ShownFaces(folder.path(), [&] { return face_template; }).checksum());
  write("b.obj", 1.6);
  EXPECT_NE(faces.checksum(), ShownFaces(folder.path(), [&] { return face_template; }).checksum());
}

TEST(ShownFaces, OtherFoldersAreRefused) {
  const TempDir folder;
  const faces::FaceTemplate face_template = testing::SyntheticModel().face_template;
  const auto open = [&] { ShownFaces(folder.path(), [&] { return face_template; }); };
  ExpectError(open, "neither a face nor a mesh");
  WriteFileAtomically(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ExpectError(open, "a.obj: 3 vertices, expected");
}

}  // namespace
}  // namespace daumier::studio
