#include "datasets/gallery/registration_pictures.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "render/image.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(RegistrationPictures, ShowMeshRegisteredFaceAndDistance) {
  const testing::TempDir folder;
  const faces::FaceTemplate face = testing::SyntheticFace();
  MeshInputs inputs{{folder / "head.obj"}, folder / "landmarks.txt", {}};
  geometry::WriteObj(inputs.meshes[0], {2 * face.neutral, face.triangles});
  std::string landmarks;
  for (const int v : face.annotation.landmarks) landmarks += std::to_string(v) + "\n";
  WriteFileAtomically(inputs.landmarks, landmarks);
  RegisterOptions options;
  options.registration.num_rounds = 1;
  BuildRegisteredFaces(face, inputs, options, folder / "out");
  const faces::FaceDatabase database(folder / "out");

  WriteRegistrationPictures(database, inputs, folder.path());
  const render::Image picture = render::ReadImage(folder / "head.jpg");
  EXPECT_GT(picture.width, 3 * 360);
  EXPECT_GT(picture.height, 2 * 360);
  WriteRegisteredMeshes(database, folder.path());
  EXPECT_EQ(geometry::ReadObj(folder / "head.obj").vertices, database.points(0));

  inputs.meshes[0] = folder / "other.obj";
  geometry::WriteObj(inputs.meshes[0], {face.neutral, face.triangles});
  testing::ExpectError([&] { WriteRegistrationPictures(database, inputs, folder.path()); },
                       "the database has a mesh head, which is none of the 1 inputs");
  testing::BuildSyntheticFaces(folder / "faces", 1);
  testing::ExpectError([&] { WriteRegisteredMeshes(faces::FaceDatabase(folder / "faces"), folder.path()); },
                       "holds no registered meshes");
}

}  // namespace
}  // namespace daumier::datasets
